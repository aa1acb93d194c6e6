// The oracle of drop: a fall by its definition (landing.hpp), in exact constructions, as plainly as it can be written.
#pragma once

#include "geometry/landing.hpp"

namespace jk {

// Shares with the other tiers the mesh and the names of what it answers, and no code.
Landing exact_fall(const Ground& ground, Index sector, const double* point, double limit);

}  // namespace jk
