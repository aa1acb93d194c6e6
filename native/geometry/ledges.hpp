// What lies beyond the edges of floors, as intervals along each edge.
//
// A body's centre comes along `hover` above a floor, goes over an edge by kBeyond and falls. What it falls onto changes
// along the edge only where the way, seen from above or from the side, crosses an edge of a surface: those places are
// worked out, and the way is followed once between each two of them, far from all, where doubles leave no doubt.
#pragma once

#include "geometry/stride.hpp"

namespace jk {

// JKU from an edge to the way on its inner and on its outer side. Far above the seams of levels (1e-6) and what doubles
// round off, far below a body (0.06).
inline constexpr double kBeyond = 1e-3;
// JKU: intervals shorter than this join their neighbour.
inline constexpr double kShortest = 1e-5;

// How a body goes over an edge, JKU. Where `hover` is blocked it tries `rise` higher, `rises` times.
struct Gait {
    double hover, radius, rise;
    int rises;
};

enum class Over : std::uint8_t { kFloor, kSolid, kWater, kVoid, kBlocked };

// Columns with one entry an interval, in the order of the edges and along them.
struct Ledges {
    std::vector<Index> edge;         // row of the edge asked about
    std::vector<double> start, end;  // 0 .. 1 along it
    std::vector<std::uint8_t> over;
    std::vector<Index> met;             // the surface fallen onto (adjoin's for water), or that blocks; -1 for none
    std::vector<Index> sector;          // where the way ends
    std::vector<double> drop0, drop1;   // at start and end, from the edge down, JKU; NaN for kVoid and kBlocked
    std::vector<Index> rise;            // how often the body had to rise to pass
    std::vector<double> past, far_off;  // the drop a radius and two radii beyond the edge, at the middle; NaN: none
};

// Answers for edge corner[i] of surface[i]. `samples` > 0 asks only at so many evenly spread places an edge, and lets
// each stand for its part. The rows are shared out among threads; the answer does not depend on how many. Throws
// std::invalid_argument naming the row that is out of bounds.
Ledges find_ledges(const Strides& strides, std::span<const Index> surface, std::span<const Index> corner,
                   const Gait& gait, int samples, unsigned threads);

}  // namespace jk
