// Pairs of sectors that share room.
#pragma once

#include <vector>

#include "geometry/boxes.hpp"
#include "geometry/crossing.hpp"

namespace jk {

// Pairs first < second of sectors whose convex hulls overlap, and how deep in JKU: the least distance that one must be
// moved by so that they no longer do.
struct Overlaps {
    std::vector<Index> first, second;
    std::vector<double> depth;
};

// A pair is apart when the plane of one of their triangles exactly has one sector before it and the other behind it,
// vertices in the plane allowed. For the others the depth is measured in doubles over the normals of all triangles
// and the cross products of all edges (the separating axes of two convex solids); what is not deeper than the rounding
// of the measurement, kMeasured of the pair's size, counts as apart. Neighbours whose shared face is bent overlap by as
// much as it is bent. Sorted.
inline constexpr double kMeasured = 0x1p-44;

Overlaps sector_overlaps(const SectorMesh& mesh, const Fans& fans);

}  // namespace jk
