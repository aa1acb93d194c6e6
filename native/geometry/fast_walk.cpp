#include "geometry/fast_walk.hpp"

#include <algorithm>
#include <limits>

namespace jk {
namespace {

struct Line {
    double a[3], along[3];
};

struct Hit {
    Index side = -1;
    double t = 1;
};

Hit first_side(const Rooms& rooms, const Room& room, const Line& line) {
    Hit hit;
    for (Index i = 0; i < PlaneBlock::kSides * room.planes; ++i) {
        const PlaneBlock& p = rooms.planes[static_cast<std::size_t>(room.plane + i / PlaneBlock::kSides)];
        const int lane = i % PlaneBlock::kSides;
        const double x = p.x[lane], y = p.y[lane], z = p.z[lane];
        const double at = x * line.a[0] + y * line.a[1] + z * line.a[2] + static_cast<double>(p.d[lane]);
        const double fall = -(x * line.along[0] + y * line.along[1] + z * line.along[2]);
        if (fall > 0 && at < hit.t * fall) hit = {PlaneBlock::kSides * room.plane + i, at / fall};
    }
    return hit;
}

const PolygonBlock& best_polygon(const Rooms& rooms, const Side& side, const Line& line, double t) {
    const int i = side.axis == 2 ? 0 : side.axis + 1, j = side.axis == 0 ? 2 : side.axis - 1;
    const double p = line.a[i] + t * line.along[i], q = line.a[j] + t * line.along[j];
    const PolygonBlock* best = nullptr;
    double deepest = -std::numeric_limits<double>::infinity();
    const PolygonBlock* block = rooms.polygons.data() + side.first;
    for (const PolygonBlock* end = block + side.count; block != end; ++block) {
        double depth = std::numeric_limits<double>::infinity();
        for (;; ++block) {
            for (int edge = 0; edge < 4; ++edge)
                depth = std::min(depth, block->a[edge] * p + block->b[edge] * q + static_cast<double>(block->c[edge]));
            if (!block->continues) break;
        }
        if (depth <= deepest && best) continue;
        deepest = depth;
        best = block;
    }
    return *best;
}

}  // namespace

Verdict fast_walk(const SectorMesh& mesh, const Rooms& rooms, Index sector, const Segment& segment) {
    const auto most = static_cast<Index>(mesh.sectors());
    for (Index crossed = 1;; ++crossed) {
        const Room& room = rooms.rooms[static_cast<std::size_t>(sector)];
        Line line;
        for (int k = 0; k < 3; ++k) {
            line.a[k] = segment.a[k] - room.center[k];
            line.along[k] = segment.b[k] - segment.a[k];
        }
        const Hit hit = first_side(rooms, room, line);
        if (hit.side < 0 || crossed > most) return {true, crossed, -1};
        const PolygonBlock& polygon = best_polygon(rooms, rooms.sides[static_cast<std::size_t>(hit.side)], line, hit.t);
        if (polygon.leads_to == kBlocks) return {false, crossed, polygon.surface};
        sector = polygon.leads_to;
    }
}

}  // namespace jk
