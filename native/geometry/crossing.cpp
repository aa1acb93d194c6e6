#include "geometry/crossing.hpp"

#include <algorithm>
#include <cmath>

namespace jk {
namespace {

// Keeps products that underflow in doubt, where the exact comparison decides them.
constexpr double kUnderflow = 0x1p-960;

}  // namespace

Fans::Fans(const SectorMesh& mesh) {
    start.reserve(mesh.surfaces() + 1);
    start.push_back(0);
    for (std::size_t s = 0; s < mesh.surfaces(); ++s) {
        const Index first = mesh.surface_start[s], end = mesh.surface_start[s + 1];
        for (Index i = first + 1; i + 1 < end; ++i) {
            const double* a = mesh.vertex(mesh.surface_vertex[first]);
            const double* b = mesh.vertex(mesh.surface_vertex[i]);
            const double* c = mesh.vertex(mesh.surface_vertex[i + 1]);
            if (on_one_line(a, b, c)) continue;
            triangles.push_back({{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, {c[0], c[1], c[2]}, static_cast<Index>(s)});
        }
        start.push_back(static_cast<Index>(triangles.size()));
    }
    triangles.shrink_to_fit();
}

bool crosses(const Fans& fans, Index triangle, const Segment& segment, Crossing& crossing) {
    const Fans::Triangle& t = fans.triangles[static_cast<std::size_t>(triangle)];
    const Volume to = volume(t.a, t.b, t.c, segment.b);
    if (to.sign >= 0) return false;
    const Volume from = volume(t.a, t.b, t.c, segment.a);
    if (from.sign < 0) return false;
    // Seen along an outward segment, the triangle turns clockwise around every point inside it.
    if (volume(segment.a, segment.b, t.a, t.b).sign > 0 || volume(segment.a, segment.b, t.b, t.c).sign > 0 ||
        volume(segment.a, segment.b, t.c, t.a).sign > 0)
        return false;
    crossing = {triangle, from, to};
    return true;
}

int compare(const Fans& fans, const Segment& segment, const Crossing& first, const Crossing& second) {
    if (first.triangle == second.triangle) return 0;
    // t1 < t2 exactly when from2 to1 - from1 to2 < 0: both denominators are positive.
    const double p = second.from.value * first.to.value, q = first.from.value * second.to.value;
    const double difference = p - q;
    const double error = std::abs(second.from.value) * first.to.error + std::abs(first.to.value) * second.from.error +
                         std::abs(first.from.value) * second.to.error + std::abs(second.to.value) * first.from.error +
                         second.from.error * first.to.error + first.from.error * second.to.error +
                         0x1p-52 * (std::abs(p) + std::abs(q));
    const double bound = error * (1 + 0x1p-48) + kUnderflow;  // the bound's own rounding
    if (difference > bound) return 1;
    if (difference < -bound) return -1;
    const auto& t1 = fans.triangles[static_cast<std::size_t>(first.triangle)];
    const auto& t2 = fans.triangles[static_cast<std::size_t>(second.triangle)];
    return compare_products({t2.a, t2.b, t2.c}, {t1.a, t1.b, t1.c}, segment.a, segment.b);
}

}  // namespace jk
