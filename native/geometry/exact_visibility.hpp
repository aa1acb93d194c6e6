// Portal flow in numbers of 237 bits, as a measure of how tight the balanced tier is.
#pragma once

#include "geometry/visibility_flow.hpp"

namespace jk {

// As vis::flow: the same chains over the same flood, with clipping written apart. The products of three differences of
// float32 coordinates are exact in these numbers, so every side test over the points as written is; a point made by
// clipping is off by 2^-180 of the level's size at most, and what lies within 2^-170 counts as touching.
bool exact_flow(const vis::Known& known, std::size_t p, vis::Bits::Word* row, vis::Stop& stop);

}  // namespace jk
