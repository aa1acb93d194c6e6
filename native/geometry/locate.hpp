// Which sector holds a point: exact, by the winding of the sector's triangles around it.
#pragma once

#include <span>
#include <vector>

#include "geometry/boxes.hpp"
#include "geometry/crossing.hpp"
#include "geometry/fast_locate.hpp"

namespace jk {

// Where a point lies: `sector` is the first that holds it inside, or else the first on whose boundary it lies, or -1;
// `inside` and `touching` count the sectors of either kind.
struct Location {
    std::vector<Index> sector, inside, touching;
};

class Locator {
public:
    Locator(const SectorMesh& mesh, const Fans& fans);

    // Whether a sector holds a point. It lies on the boundary when it lies on a closed triangle of the sector, and
    // inside when the triangles wind around it: counted along a segment from the point to beyond the sector, which
    // is chosen anew while it meets an edge or a vertex, or grazes a triangle. A sector that is not closed has no
    // winding; it holds the points that are behind none of its triangles, on the boundary where they are in the plane
    // of one.
    Place place(Index sector, const double* point) const;

    // Every point in every sector, by `place`, or in plain doubles.
    Location locate(std::span<const double> points, bool fast, unsigned threads) const;

    std::size_t memory() const;

private:
    Place rough_place(Index sector, const double* point) const;
    bool closed(std::size_t sector) const;
    Place behind_none(Index first, Index end, const double* point) const;
    bool winding(Index first, Index end, const Segment& probe, int& turns) const;

    const SectorMesh& mesh_;
    const Fans& fans_;
    std::vector<Box> boxes_;
    BoxTree tree_;
    std::vector<std::uint8_t> closed_;
};

}  // namespace jk
