// The oracle: sight by its definition, in exact constructions, written as plainly as it can be.
#pragma once

#include "geometry/mesh.hpp"

namespace jk {

struct ExactVerdict {
    bool visible;
    Index crossed, blocker;
};

// Answers one query from a in `sector` to b (x y z). Shares the mesh with the other tiers and no code: the rules are
// those of the design, "Sight", with ties taken in the order of the surfaces.
ExactVerdict exact_sight(const SectorMesh& mesh, Index sector, const double* a, const double* b);

}  // namespace jk
