// Portal flow in numbers of 106 bits, as a measure of how tight the balanced tier is.
#pragma once

#include "geometry/visibility_flow.hpp"

namespace jk {

// As vis::flow: the same chains over what balanced leaves, with the clipping written apart, every plane through an edge
// and a point tried, and a slack of 2^-90 of the level's size where doubles need 2^-49.
bool exact_flow(const vis::Known& known, std::size_t p, vis::Bits::Word* row, vis::Stop& stop);

}  // namespace jk
