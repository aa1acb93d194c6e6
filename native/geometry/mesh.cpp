#include "geometry/mesh.hpp"

#include <stdexcept>

#include "geometry/checks.hpp"

namespace jk {
namespace {

std::vector<Index> copy(std::span<const Index> values) { return {values.begin(), values.end()}; }

}  // namespace

SectorMesh make_mesh(std::span<const double> positions, std::span<const Index> surface_start,
                     std::span<const Index> surface_vertex, std::span<const Index> leads_to,
                     std::span<const Index> sector_first, std::span<const Index> sector_count) {
    check_coordinates("position", positions);
    check_starts("surface_start", surface_start, surface_vertex.size());
    check_indices("surface_vertex", surface_vertex, positions.size() / 3);
    if (leads_to.size() + 1 != surface_start.size())
        throw std::invalid_argument("leads_to must have one entry a surface");
    check_ranges("sector_first", sector_first, sector_count, leads_to.size());
    for (std::size_t i = 0; i < leads_to.size(); ++i)
        if (leads_to[i] != kBlocks && (leads_to[i] < 0 || static_cast<std::size_t>(leads_to[i]) >= sector_first.size()))
            refuse("leads_to", i, leads_to[i]);
    return {{positions.begin(), positions.end()}, copy(surface_start), copy(surface_vertex), copy(leads_to),
            copy(sector_first), copy(sector_count)};
}

}  // namespace jk
