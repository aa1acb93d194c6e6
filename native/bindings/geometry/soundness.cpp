// The door to what is sound about a mesh: closure, edges, overlaps.
#include <nanobind/stl/tuple.h>

#include "../arrays.hpp"
#include "doors.hpp"
#include "geometry/closure.hpp"
#include "geometry/overlap.hpp"
#include "geometry/sight.hpp"

namespace jk {
namespace {

auto closure(const Viewer& viewer) {
    Closure found;
    {
        nb::gil_scoped_release release;
        found = sector_closure(viewer.mesh(), viewer.fans());
    }
    return std::make_tuple(hand_over(std::move(found.open)), hand_over(std::move(found.surface)),
                           hand_over(std::move(found.corner)), hand_over(std::move(found.length)),
                           hand_over(std::move(found.volume)), hand_over(std::move(found.certain)));
}

auto edges(const Viewer& viewer) {
    Edges found;
    {
        nb::gil_scoped_release release;
        found = surface_edges(viewer.mesh(), viewer.fans());
    }
    return std::make_tuple(hand_over(std::move(found.corner)), hand_over(std::move(found.length)),
                           hand_over(std::move(found.degenerate)));
}

auto overlaps(const Viewer& viewer) {
    Overlaps found;
    {
        nb::gil_scoped_release release;
        found = sector_overlaps(viewer.mesh(), viewer.fans());
    }
    return std::make_tuple(hand_over(std::move(found.first)), hand_over(std::move(found.second)),
                           hand_over(std::move(found.depth)));
}

}  // namespace

void open_soundness(nb::module_& m) {
    m.def("sector_closure", &closure, nb::arg("viewer"),
          "Match each sector's directed edges by exact position.\n\n"
          "Returns (open, surface, corner, length, volume, certain), one entry a sector: see Closure.");
    m.def("surface_edges", &edges, nb::arg("viewer"),
          "Find each surface's shortest edge and its triangles without area.\n\n"
          "Returns (corner, length, degenerate), one entry a surface: see Edges.");
    m.def("sector_overlaps", &overlaps, nb::arg("viewer"),
          "Find the pairs of sectors that overlap.\n\n"
          "Returns (first, second, depth), sorted, one entry a pair, depth in JKU: see Overlaps.");
}

}  // namespace jk
