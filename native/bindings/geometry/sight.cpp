// The door to sight.
#include "geometry/sight.hpp"

#include <nanobind/stl/tuple.h>

#include "../arrays.hpp"
#include "doors.hpp"
#include "tiers.hpp"

namespace jk {
namespace {

void make(Viewer* viewer, Array<double> positions, Array<Index> surface_start, Array<Index> surface_vertex,
          Array<Index> leads_to, Array<Index> sector_first, Array<Index> sector_count) {
    nb::gil_scoped_release release;
    new (viewer) Viewer(make_mesh(view(positions), view(surface_start), view(surface_vertex), view(leads_to),
                                  view(sector_first), view(sector_count)));
}

auto sight(const Viewer& viewer, Array<double> origins, Array<Index> sectors, Array<double> targets,
           const char* accuracy, unsigned threads) {
    const Tier tier = tier_of(accuracy);
    Sight found(0);
    {
        nb::gil_scoped_release release;
        found = viewer.sight({view(origins), view(sectors), view(targets)}, tier, threads);
    }
    return std::make_tuple(hand_over(std::move(found.visible)), hand_over(std::move(found.crossed)),
                           hand_over(std::move(found.blocker)));
}

auto sees(const Viewer& viewer, Array<double> origins, Array<Index> sectors, Array<double> targets, Array<Index> aims,
          Array<std::uint8_t> visible, unsigned threads) {
    std::vector<std::uint8_t> found;
    {
        nb::gil_scoped_release release;
        const VisibleRows known{view(visible), (viewer.mesh().sectors() + 7) / 8};
        found = viewer.sees({view(origins), view(sectors), view(targets), view(aims)}, known, threads);
    }
    return hand_over(std::move(found));
}

auto locate(const Viewer& viewer, Array<double> points, const char* accuracy, unsigned threads) {
    const Tier tier = tier_of(accuracy);
    Location found;
    {
        nb::gil_scoped_release release;
        found = viewer.locate(view(points), tier, threads);
    }
    return std::make_tuple(hand_over(std::move(found.sector)), hand_over(std::move(found.inside)),
                           hand_over(std::move(found.touching)));
}

auto explain(const Viewer& viewer, Array<double> origin, Index sector, Array<double> target) {
    std::vector<Step> path;
    const Verdict verdict = viewer.explain(view(origin), sector, view(target), path);
    std::vector<Index> sectors, surfaces;
    std::vector<double> leave;
    for (const Step& step : path) {
        sectors.push_back(step.sector);
        surfaces.push_back(step.surface);
        leave.push_back(step.leave);
    }
    return std::make_tuple(verdict.visible, hand_over(std::move(sectors)), hand_over(std::move(surfaces)),
                           hand_over(std::move(leave)));
}

auto doubts(const Viewer& viewer, Array<double> origins, Array<Index> sectors, Array<double> targets) {
    nb::gil_scoped_release release;
    const Doubts found = viewer.doubts({view(origins), view(sectors), view(targets)});
    return std::make_tuple(found.sectors, found.queries);
}

}  // namespace

void open_sight(nb::module_& m) {
    nb::class_<Viewer>(m, "Viewer", "A level's sectors made ready for sight queries; immutable.")
        .def("__init__", &make, nb::arg("positions"), nb::arg("surface_start"), nb::arg("surface_vertex"),
             nb::arg("leads_to"), nb::arg("sector_first"), nb::arg("sector_count"),
             "Copy and check the mesh: positions (3n,) float64, JKU; the rest int32.\n\n"
             "leads_to is the sector behind each surface, -1 where sight does not pass. Raises ValueError naming the\n"
             "index that is out of bounds.")
        .def("sight", &sight, nb::arg("origins"), nb::arg("sectors"), nb::arg("targets"), nb::arg("accuracy"),
             nb::arg("threads"),
             "Answer (visible, crossed, blocker), uint8 and int32, one entry a query.\n\n"
             "origins and targets are (3n,) float64, JKU; sectors (n,) int32. Raises ValueError naming the row that is\n"
             "out of bounds.")
        .def("sees", &sees, nb::arg("origins"), nb::arg("sectors"), nb::arg("targets"), nb::arg("target_sectors"),
             nb::arg("visible"), nb::arg("threads"),
             "Answer whether each target is seen in its sector, uint8, one entry a query.\n\n"
             "target_sectors is (n,) int32, -1 for a target in none; visible the rows of bits of visible_sectors, flat\n"
             "uint8, or empty. Raises ValueError naming the row that is out of bounds.")
        .def("locate", &locate, nb::arg("points"), nb::arg("accuracy"), nb::arg("threads"),
             "Answer (sector, inside, touching), int32, one entry a point of (3n,) float64, JKU.\n\n"
             "sector is the first that holds the point inside, else the first on whose boundary it lies, else -1;\n"
             "inside and touching count the sectors of either kind. Raises ValueError naming the point.")
        .def("explain", &explain, nb::arg("origin"), nb::arg("sector"), nb::arg("target"),
             "Answer (visible, sectors, surfaces, leave) of the way that decides one query.\n\n"
             "Entry i is a sector, the surface through which it is left (-1: the segment ends there) and how far along\n"
             "the segment, 0 to 1.")
        .def("doubts", &doubts, nb::arg("origins"), nb::arg("sectors"), nb::arg("targets"),
             "Count (sectors, queries) that the walk of `balanced` left to the complete search.")
        .def_prop_ro("memory", &Viewer::memory, "Bytes of native memory held.");
}

}  // namespace jk
