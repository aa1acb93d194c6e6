// A level's sectors as sight sees them: plain data, shared by all tiers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace jk {

using Index = std::int32_t;

// What lies behind a surface that sight does not pass.
inline constexpr Index kBlocks = -1;

// Surface i has the vertices surface_vertex[surface_start[i] .. surface_start[i + 1]), counter-clockwise seen from
// inside its sector, and leads into the sector leads_to[i], or kBlocks. Sector i owns the surfaces
// [sector_first[i], sector_first[i] + sector_count[i]).
struct SectorMesh {
    std::vector<double> positions;  // x y z of each vertex, JKU
    std::vector<Index> surface_start, surface_vertex, leads_to;
    std::vector<Index> sector_first, sector_count;

    std::size_t sectors() const { return sector_first.size(); }
    std::size_t surfaces() const { return leads_to.size(); }
    const double* vertex(Index i) const { return positions.data() + 3 * static_cast<std::size_t>(i); }
};

// Copies and checks. Throws std::invalid_argument naming the index when a range, a vertex or a sector is out of
// bounds or a coordinate is not finite or too great (check_coordinates).
SectorMesh make_mesh(std::span<const double> positions, std::span<const Index> surface_start,
                     std::span<const Index> surface_vertex, std::span<const Index> leads_to,
                     std::span<const Index> sector_first, std::span<const Index> sector_count);

}  // namespace jk
