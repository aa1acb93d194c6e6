// Whether sectors are closed and which way they are wound, and which edges have no length.
#pragma once

#include <vector>

#include "geometry/crossing.hpp"

namespace jk {

// Per sector: how many directed edges no edge the other way matches (by exact position; edges of no length are left
// out), and of these the longest: its surface, its first corner and its length in JKU. 0, -1, -1 and 0 for a closed
// sector; an edge that runs along two shorter ones counts with them as open.
//
// `volume` is the signed volume within the surfaces in JKU cubed, positive when they turn counter-clockwise seen from
// inside; `certain` tells whether its sign is beyond rounding. It means nothing for a sector that is not closed.
struct Closure {
    std::vector<Index> open, surface, corner;
    std::vector<double> length, volume;
    std::vector<std::uint8_t> certain;
};

Closure sector_closure(const SectorMesh& mesh, const Fans& fans);

// Per surface: the corner at which its shortest edge starts, that edge's length in JKU (exactly 0 only where both ends
// coincide), and how many triangles of its fan have no area, exactly. -1, 0 and 0 for a surface without corners.
struct Edges {
    std::vector<Index> corner, degenerate;
    std::vector<double> length;
};

Edges surface_edges(const SectorMesh& mesh, const Fans& fans);

}  // namespace jk
