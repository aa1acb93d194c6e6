// The door to ledges.
#include "geometry/ledges.hpp"

#include <nanobind/stl/tuple.h>

#include "../arrays.hpp"
#include "doors.hpp"

namespace jk {
namespace {

void make(Strides* strides, Array<double> positions, Array<Index> surface_start, Array<Index> surface_vertex,
          Array<Index> passes_to, Array<std::uint8_t> under_water, Array<Index> sector_first,
          Array<Index> sector_count) {
    nb::gil_scoped_release release;
    const std::vector<Index> unseen(view(passes_to).size(), kBlocks);
    new (strides) Strides(make_mesh(view(positions), view(surface_start), view(surface_vertex), unseen,
                                    view(sector_first), view(sector_count)),
                          view(passes_to), view(under_water));
}

auto ledges(const Strides& strides, Array<Index> surface, Array<Index> corner, double hover, double radius, double rise,
            int rises, int samples, unsigned threads) {
    Ledges found;
    {
        nb::gil_scoped_release release;
        found = find_ledges(strides, view(surface), view(corner), {hover, radius, rise, rises}, samples, threads);
    }
    return std::make_tuple(hand_over(std::move(found.edge)), hand_over(std::move(found.start)),
                           hand_over(std::move(found.end)), hand_over(std::move(found.over)),
                           hand_over(std::move(found.met)), hand_over(std::move(found.sector)),
                           hand_over(std::move(found.drop0)), hand_over(std::move(found.drop1)),
                           hand_over(std::move(found.rise)), hand_over(std::move(found.past)),
                           hand_over(std::move(found.far_off)));
}

auto floors(const Strides& strides) {
    std::vector<std::uint8_t> carries(strides.mesh().surfaces());
    for (std::size_t i = 0; i < carries.size(); ++i) carries[i] = strides.carries(static_cast<Index>(i));
    return hand_over(std::move(carries));
}

}  // namespace

void open_ledges(nb::module_& m) {
    nb::class_<Strides>(m, "Strides", "A level's sectors as walking bodies meet them; immutable.")
        .def("__init__", &make, nb::arg("positions"), nb::arg("surface_start"), nb::arg("surface_vertex"),
             nb::arg("passes_to"), nb::arg("under_water"), nb::arg("sector_first"), nb::arg("sector_count"),
             "Copy and check the mesh: positions (3n,) float64, JKU; under_water uint8; the rest int32.\n\n"
             "passes_to is the sector behind each surface, -1 for one that carries where it faces up, -2 for another\n"
             "that stops bodies, -3 for one that they do not meet. Raises ValueError naming the index that is out of\n"
             "bounds.")
        .def("floors", &floors, "Answer uint8, one entry a surface: whether bodies stand on it.")
        .def("ledges", &ledges, nb::arg("surface"), nb::arg("corner"), nb::arg("hover"), nb::arg("radius"),
             nb::arg("rise"), nb::arg("rises"), nb::arg("samples"), nb::arg("threads"),
             "Answer (edge, start, end, over, met, sector, drop0, drop1, rise, past, far_off), one entry an interval.\n\n"
             "What lies beyond edge corner[i] of floor surface[i], int32. native/geometry/ledges.hpp says what each\n"
             "holds; int32, float64, and uint8 for over. Raises ValueError naming the row that is out of bounds.");
}

}  // namespace jk
