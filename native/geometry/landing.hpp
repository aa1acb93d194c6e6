// What a fall ends at: the plain data that all tiers of drop share.
#pragma once

#include <span>

#include "geometry/mesh.hpp"

namespace jk {

// In place of the sector behind a surface that bodies do not pass: one that carries them where it faces up, one that
// stops them and carries nothing, and one that they do not meet at all.
inline constexpr Index kCarries = -1, kStops = -2, kAbsent = -3;

// A mesh as falling bodies meet it. Surface i leads into the sector passes_to[i] or is one of the three above; sector
// i is under water where under_water[i] is not 0.
struct Ground {
    const SectorMesh& mesh;
    std::span<const Index> passes_to;
    std::span<const std::uint8_t> under_water;
};

// How a fall ends. At equal depth the first of these counts.
enum class Ending : std::uint8_t { kFloor, kSolid, kWater, kFar, kNothing };

// One fall, straight down from a point in a sector.
//
// In a sector the fall meets the triangles that face up (their corners turn counter-clockwise seen from above), at or
// below the point, no higher than where it came in, with the vertical line through the closed triangle; the highest
// decide. One that carries or stops ends the way; else the way goes on through every surface met, and ends at the
// surface if that leads under water. Where ways part (at an edge or a corner, or among overlapping sectors), the
// ending nearest to the point counts, then the first kind, then the lowest surface.
struct Landing {
    Ending ending;
    Index met;        // the surface that ends the fall; -1 for kFar and kNothing, and for a start under water
    Index sector;     // where the fall ends; with kWater the one under water
    double distance;  // to the end, JKU, the nearest double; the limit for kFar, infinite for kNothing
};

}  // namespace jk
