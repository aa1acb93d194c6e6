// The oracle: which sectors hold a point, by CGAL's exact predicates, written as plainly as it can be.
#pragma once

#include <array>
#include <vector>

#include "geometry/mesh.hpp"

namespace jk {

// The first sector that holds the point inside, or else the first on whose boundary it lies, or -1; and how many
// sectors do either.
struct ExactLocation {
    Index sector = -1, inside = 0, touching = 0;
};

// Shares the mesh with the other tiers and no code. A sector holds a point on its boundary when it lies on one of its
// closed triangles, inside when the triangles wind around it: counted straight above the point, which is moved
// aside by less than any distance in the level. A sector that is not closed holds those of its box that are behind
// none of its triangles.
class ExactLocator {
public:
    explicit ExactLocator(const SectorMesh& mesh);

    ExactLocation locate(const double* point) const;

private:
    struct Room {
        std::vector<std::array<const double*, 3>> triangles;  // without those whose corners lie on one line
        std::vector<const double*> corners;
        bool closed;
    };

    template <typename Kernel>
    ExactLocation answer(const double* point) const;

    std::vector<Room> rooms_;
    bool usual_;
};

}  // namespace jk
