#include "geometry/fast_fall.hpp"

#include <limits>

namespace jk {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// How far a triangle lies below a point, or infinity where the vertical line misses it.
double depth_of(const Fans::Triangle& t, const double* p) {
    const double ax = t.a[0] - p[0], ay = t.a[1] - p[1], bx = t.b[0] - p[0], by = t.b[1] - p[1];
    const double cx = t.c[0] - p[0], cy = t.c[1] - p[1];
    const double a = bx * cy - by * cx, b = cx * ay - cy * ax, c = ax * by - ay * bx;
    if (a < 0 || b < 0 || c < 0) return kInfinite;
    const double sum = a + b + c;
    return sum > 0 ? p[2] - (a * t.a[2] + b * t.b[2] + c * t.c[2]) / sum : kInfinite;
}

}  // namespace

Landing fast_fall(const Ground& ground, const Fans& fans, const Upward& upward, Index sector, const double* point,
                  double limit) {
    if (ground.under_water[static_cast<std::size_t>(sector)]) return {Ending::kWater, -1, sector, 0};
    double entry = 0;
    for (std::size_t crossed = 0; crossed <= ground.mesh.sectors(); ++crossed) {
        double least = kInfinite;
        Index met = -1;
        const auto s = static_cast<std::size_t>(sector);
        for (Index i = upward.start[s]; i < upward.start[s + 1]; ++i) {
            const auto t = static_cast<std::size_t>(upward.triangles[static_cast<std::size_t>(i)]);
            const double depth = depth_of(fans.triangles[t], point);
            if (depth < entry || depth >= least) continue;
            least = depth;
            met = fans.triangles[t].surface;
        }
        if (met < 0) break;
        if (least > limit) return {Ending::kFar, -1, sector, limit};
        const Index leads = ground.passes_to[static_cast<std::size_t>(met)];
        if (leads < 0) return {leads == kCarries ? Ending::kFloor : Ending::kSolid, met, sector, least};
        if (ground.under_water[static_cast<std::size_t>(leads)]) return {Ending::kWater, met, leads, least};
        sector = leads;
        entry = least;
    }
    return {Ending::kNothing, -1, sector, kInfinite};
}

}  // namespace jk
