// The fast tier: the walk in doubles without bounds or doubts.
#pragma once

#include "geometry/rooms.hpp"
#include "geometry/search.hpp"

namespace jk {

// Leaves each room by the side whose plane is crossed first, through the polygon that holds the crossing best. Needles,
// ties and what bent surfaces do are not looked at; after as many sectors as the level has, nothing blocks.
Verdict fast_walk(const SectorMesh& mesh, const Rooms& rooms, Index sector, const Segment& segment);

}  // namespace jk
