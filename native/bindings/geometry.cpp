// The door to native/geometry.
#include <nanobind/stl/tuple.h>

#include "arrays.hpp"
#include "geometry/doors.hpp"
#include "geometry/convexity.hpp"

namespace nb = nanobind;

NB_MODULE(_native_geometry, m) {
    m.doc() = "Native geometry with exact predicates; only jktools.geometry imports it.";
    jk::open_ledges(m);
    jk::open_sight(m);
    jk::open_drop(m);
    jk::open_soundness(m);
    jk::open_visibility(m);
    m.def(
        "sector_convexity",
        [](jk::Array<double> positions, jk::Array<std::int32_t> surface_start, jk::Array<std::int32_t> surface_vertex,
           jk::Array<std::int32_t> sector_first, jk::Array<std::int32_t> sector_count,
           jk::Array<std::int32_t> sector_start, jk::Array<std::int32_t> sector_vertex) {
            jk::Convexity found;
            {
                nb::gil_scoped_release release;
                found = jk::sector_convexity({jk::view(positions), jk::view(surface_start), jk::view(surface_vertex),
                                              jk::view(sector_first), jk::view(sector_count), jk::view(sector_start),
                                              jk::view(sector_vertex)});
            }
            return std::make_tuple(jk::hand_over(std::move(found.behind)), jk::hand_over(std::move(found.surface)),
                                   jk::hand_over(std::move(found.vertex)), jk::hand_over(std::move(found.distance)));
        },
        nb::arg("positions"), nb::arg("surface_start"), nb::arg("surface_vertex"), nb::arg("sector_first"),
        nb::arg("sector_count"), nb::arg("sector_start"), nb::arg("sector_vertex"),
        "Test each sector's vertices against its surfaces, exactly.\n\n"
        "positions is (3n,) float64, JKU; the rest are int32 as in SectorPolygons. Returns (behind, surface, vertex,\n"
        "distance), one entry a sector: the number of (surface, vertex) pairs with the vertex strictly behind the\n"
        "surface, the worst pair (-1, -1 when convex) and its distance in JKU. Raises ValueError naming the index\n"
        "that is out of bounds or the position that is not finite.");
    m.def(
        "points_outside",
        [](jk::Array<double> positions, jk::Array<std::int32_t> surface_start, jk::Array<std::int32_t> surface_vertex,
           jk::Array<std::int32_t> sector_first, jk::Array<std::int32_t> sector_count, jk::Array<double> points,
           jk::Array<std::int32_t> sectors) {
            jk::Outside found;
            {
                nb::gil_scoped_release release;
                const std::vector<std::int32_t> no_vertices(sector_first.size() + 1, 0);
                found = jk::points_outside({jk::view(positions), jk::view(surface_start), jk::view(surface_vertex),
                                            jk::view(sector_first), jk::view(sector_count), no_vertices, {}},
                                           jk::view(points), jk::view(sectors));
            }
            return std::make_tuple(jk::hand_over(std::move(found.surface)), jk::hand_over(std::move(found.distance)));
        },
        nb::arg("positions"), nb::arg("surface_start"), nb::arg("surface_vertex"), nb::arg("sector_first"),
        nb::arg("sector_count"), nb::arg("points"), nb::arg("sectors"),
        "Test points against the surfaces of their sectors, exactly.\n\n"
        "positions (3n,) and points (3m,) are float64, JKU; sectors (m,) int32. Returns (surface, distance), one entry\n"
        "a point: the surface that it is farthest behind and by how much in JKU, or -1 and 0. Raises ValueError naming\n"
        "the index that is out of bounds or the point that is not finite.");
}
