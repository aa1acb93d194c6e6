// The door to drop.
#include <nanobind/stl/tuple.h>

#include "../arrays.hpp"
#include "doors.hpp"
#include "geometry/ground.hpp"
#include "tiers.hpp"

namespace jk {
namespace {

void make(Faller* faller, const Viewer& viewer, Array<Index> passes_to, Array<std::uint8_t> under_water) {
    nb::gil_scoped_release release;
    new (faller) Faller(viewer.mesh(), viewer.fans(), view(passes_to), view(under_water));
}

auto drop(const Faller& faller, Array<double> points, Array<Index> sectors, Array<double> limits, const char* accuracy,
          unsigned threads) {
    const Tier tier = tier_of(accuracy);
    Drops found;
    {
        nb::gil_scoped_release release;
        found = faller.drop(view(points), view(sectors), view(limits), tier, threads);
    }
    return std::make_tuple(hand_over(std::move(found.ending)), hand_over(std::move(found.met)),
                           hand_over(std::move(found.sector)), hand_over(std::move(found.distance)));
}

}  // namespace

void open_drop(nb::module_& m) {
    nb::class_<Faller>(m, "Faller", "A level's sectors made ready for falls straight down; immutable.")
        .def("__init__", &make, nb::arg("viewer"), nb::arg("passes_to"), nb::arg("under_water"),
             nb::keep_alive<1, 2>(),
             "Take a viewer's mesh: passes_to (surfaces,) int32, under_water (sectors,) uint8.\n\n"
             "passes_to is the sector that a body falls into through each surface, -1 where it is carried, -2 where it\n"
             "is stopped and not carried, -3 for a surface that it does not meet. Raises ValueError naming the index\n"
             "that is out of bounds.")
        .def("drop", &drop, nb::arg("points"), nb::arg("sectors"), nb::arg("limits"), nb::arg("accuracy"),
             nb::arg("threads"),
             "Answer (ending, met, sector, distance), uint8, int32, int32 and float64, one entry a fall: see Landing.\n\n"
             "points are (3n,) float64, JKU; sectors (n,) int32; limits (n,) float64, JKU. Raises ValueError naming the\n"
             "row that is out of bounds.")
        .def_prop_ro("memory", &Faller::memory, "Bytes of native memory held, without the viewer's.");
}

}  // namespace jk
