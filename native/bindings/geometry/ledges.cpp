// The door to ledges.
#include "geometry/exact_ledges.hpp"

#include <nanobind/stl/tuple.h>

#include "../arrays.hpp"
#include "doors.hpp"

namespace jk {
namespace {

auto columns(Ledges&& found) {
    return std::make_tuple(
        hand_over(std::move(found.edge)), hand_over(std::move(found.start)), hand_over(std::move(found.end)),
        hand_over(std::move(found.over)), hand_over(std::move(found.met)), hand_over(std::move(found.face)),
        hand_over(std::move(found.sector)), hand_over(std::move(found.drop0)), hand_over(std::move(found.drop1)),
        hand_over(std::move(found.rise)), hand_over(std::move(found.past0)), hand_over(std::move(found.past1)),
        hand_over(std::move(found.far0)), hand_over(std::move(found.far1)));
}

void make(Strides* strides, Array<double> positions, Array<Index> surface_start, Array<Index> surface_vertex,
          Array<Index> passes_to, Array<std::uint8_t> under_water, Array<Index> sector_first, Array<Index> sector_count,
          Array<double> solid_positions, Array<Index> face_start, Array<Index> face_vertex, Array<Index> face_solid,
          Array<std::uint8_t> face_carries) {
    nb::gil_scoped_release release;
    const std::vector<Index> unseen(view(passes_to).size(), kBlocks);
    const auto copy = [](const auto& array) {
        return std::vector(view(array).begin(), view(array).end());
    };
    new (strides) Strides(make_mesh(view(positions), view(surface_start), view(surface_vertex), unseen,
                                    view(sector_first), view(sector_count)),
                          view(passes_to), view(under_water),
                          {copy(solid_positions), copy(face_start), copy(face_vertex), copy(face_solid),
                           copy(face_carries)});
}

auto ledges(const Strides& strides, Array<Index> surface, Array<Index> face, Array<Index> corner,
            Array<std::uint8_t> active, double hover, double radius, double rise, int rises, double shallow,
            int samples, unsigned threads) {
    Ledges found;
    {
        nb::gil_scoped_release release;
        const Edges edges{view(surface), view(face), view(corner)};
        found = find_ledges(strides, edges, view(active), {hover, radius, rise, rises, shallow}, samples, threads);
    }
    return columns(std::move(found));
}

auto exact_ledges(const Strides& strides, Array<Index> surface, Array<Index> face, Array<Index> corner,
                  Array<std::uint8_t> active, double hover, double radius, double rise, int rises, double shallow,
                  unsigned threads) {
    Ledges found;
    {
        nb::gil_scoped_release release;
        const Edges edges{view(surface), view(face), view(corner)};
        found = find_exact_ledges(strides, edges, view(active), {hover, radius, rise, rises, shallow}, threads);
    }
    return columns(std::move(found));
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
             nb::arg("solid_positions"), nb::arg("face_start"), nb::arg("face_vertex"), nb::arg("face_solid"),
             nb::arg("face_carries"),
             "Copy and check the mesh: positions (3n,) float64, JKU; under_water uint8; the rest int32.\n\n"
             "passes_to is the sector behind each surface, -1 for one that carries where it faces up, -2 for another\n"
             "that stops bodies, -3 for one that they do not meet. Face i of the things that carry bodies has the vertices\n"
             "face_vertex[face_start[i]:face_start[i + 1]] and belongs to the solid face_solid[i]. Raises ValueError\n"
             "naming the index that is out of bounds.")
        .def("floors", &floors, "Answer uint8, one entry a surface: whether bodies stand on it.")
        .def("ledges", &ledges, nb::arg("surface"), nb::arg("face"), nb::arg("corner"), nb::arg("active"),
             nb::arg("hover"), nb::arg("radius"), nb::arg("rise"), nb::arg("rises"), nb::arg("shallow"),
             nb::arg("samples"), nb::arg("threads"),
             "Answer (edge, start, end, over, met, face, sector, drop0, drop1, rise, past0, past1, far0, far1), one entry\n"
             "an interval.\n\n"
             "What lies beyond edge corner[i] of floor surface[i], int32, or of face[i] where that is -1, among the\n"
             "solids whose entry of active, uint8, is not 0. native/geometry/ledges.hpp says what each holds; int32,\n"
             "float64, and uint8 for over. Raises ValueError naming the row that is out of bounds.")
        .def("exact_ledges", &exact_ledges, nb::arg("surface"), nb::arg("face"), nb::arg("corner"), nb::arg("active"),
             nb::arg("hover"), nb::arg("radius"), nb::arg("rise"), nb::arg("rises"), nb::arg("shallow"),
             nb::arg("threads"), "Answer the same in exact constructions.");
}

}  // namespace jk
