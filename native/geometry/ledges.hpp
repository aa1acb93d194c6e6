// What lies beyond the edges of floors, as intervals along each edge.
//
// A body's centre comes along `hover` above a floor, goes over an edge by kBeyond and falls. What it falls onto changes
// along the edge only where the way, seen from above or from the side, crosses an edge of a surface or of a face, or
// where two planes cross: those places are worked out, and the way is followed once between each two of them, far from
// all, where doubles leave no doubt.
#pragma once

#include "geometry/stride.hpp"

namespace jk {

// JKU from an edge to the way on its inner and on its outer side. Far above the seams of levels (1e-6) and what doubles
// round off, far below a body (0.06).
inline constexpr double kBeyond = 1e-3;
// JKU: intervals shorter than this join their neighbour.
inline constexpr double kShortest = 1e-5;
// JKU over the face of a thing at which a body's way up begins, past the face itself. On the floor of a sector it begins
// in its plane: at the rim of a bowl the sector may be lower than any such height.
inline constexpr double kOnFace = 1e-4;

// How a body goes over an edge, JKU. Where `hover` is blocked it tries `rise` higher, `rises` times. A floor that is
// no deeper than `shallow` is taken at the edge: what lies further out is then not looked at.
struct Gait {
    double hover, radius, rise;
    int rises;
    double shallow;
};

enum class Over : std::uint8_t { kFloor, kSolid, kWater, kVoid, kBlocked };

// The edges asked about: edge corner[i] of the floor surface[i], or where that is -1 of the face face[i] of a solid.
struct Edges {
    std::span<const Index> surface, face, corner;
};

// Columns with one entry an interval, in the order of the edges and along them.
struct Ledges {
    std::vector<Index> edge;         // row of the edge asked about
    std::vector<double> start, end;  // 0 .. 1 along it
    std::vector<std::uint8_t> over;
    std::vector<Index> met;           // the surface fallen onto (adjoin's for water), or that blocks; -1 for none
    std::vector<Index> face;          // the face of a solid fallen onto, or that blocks; -1 for none
    std::vector<Index> sector;        // where the way ends
    std::vector<double> drop0, drop1;  // at start and end, from the edge down, JKU; NaN for kVoid and kBlocked
    std::vector<Index> rise;           // how often the body had to rise to pass
    // The drop from the edge a radius and two radii beyond it, at start and end: infinite where no floor is, NaN where
    // the body does not get there, or is not looked at.
    std::vector<double> past0, past1, far0, far1;
};

// Answers for edges. `samples` > 0 asks only at so many evenly spread places an edge, and lets each stand for its part.
// `active` has one entry a solid: those with 0 are not there. The rows are shared out among threads; the answer does
// not depend on how many. Throws std::invalid_argument naming the row that is out of bounds.
Ledges find_ledges(const Strides& strides, const Edges& edges, std::span<const std::uint8_t> active, const Gait& gait,
                   int samples, unsigned threads);

// Throws std::invalid_argument naming the row that is out of bounds.
void check_edges(const Strides& strides, const Edges& edges, std::span<const std::uint8_t> active);

}  // namespace jk
