#include "geometry/fast_locate.hpp"

namespace jk {
namespace {

// On which side of the line from a to b, seen from above, the origin lies. What lies on the line counts as moved aside
// by next to nothing, so that of two triangles that share an edge one holds it.
double beside(double ax, double ay, double bx, double by) {
    const double side = ax * by - bx * ay;
    if (side != 0) return side;
    return ay != by ? (ay > by ? 0.0 : -0.0) : (ax < bx ? 0.0 : -0.0);
}

}  // namespace

Place fast_place(const Fans& fans, Index first, Index end, const double* p) {
    int turns = 0;
    for (Index i = first; i < end; ++i) {
        const Fans::Triangle& t = fans.triangles[static_cast<std::size_t>(i)];
        const double ax = t.a[0] - p[0], ay = t.a[1] - p[1], bx = t.b[0] - p[0], by = t.b[1] - p[1];
        const double cx = t.c[0] - p[0], cy = t.c[1] - p[1];
        const double c = beside(ax, ay, bx, by), a = beside(bx, by, cx, cy), b = beside(cx, cy, ax, ay);
        const bool left = !__builtin_signbit(a);
        if (!__builtin_signbit(b) != left || !__builtin_signbit(c) != left) continue;
        const double height = a * (t.a[2] - p[2]) + b * (t.b[2] - p[2]) + c * (t.c[2] - p[2]);
        if (height == 0) return Place::kOn;
        if ((height > 0) == left) turns += left ? 1 : -1;
    }
    return turns != 0 ? Place::kInside : Place::kOutside;
}

}  // namespace jk
