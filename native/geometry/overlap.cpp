#include "geometry/overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace jk {
namespace {

using Vector = std::array<double, 3>;

// A direction whose length is below this part of what it is made of has no trustworthy direction.
constexpr double kThinnest = 0x1p-20;

Vector minus(const double* a, const double* b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Solid {
    std::vector<const double*> vertices;
    std::vector<const Fans::Triangle*> triangles;
    std::set<std::pair<Index, Index>> edges;  // by vertex number, low first
};

class Pairs {
public:
    Pairs(const SectorMesh& mesh, const Fans& fans) : mesh_(mesh), solids_(mesh.sectors()) {
        for (std::size_t s = 0; s < solids_.size(); ++s) gather(fans, s);
    }

    // How deep two sectors overlap, 0 when they are apart.
    double depth(std::size_t i, std::size_t j, double size) const {
        const Solid &a = solids_[i], &b = solids_[j];
        if (parted(a, b) || parted(b, a)) return 0;
        double least = std::numeric_limits<double>::infinity();
        for (const Solid* solid : {&a, &b})
            for (const Fans::Triangle* t : solid->triangles) along(minus(t->b, t->a), minus(t->c, t->a), a, b, least);
        for (const auto& [p, q] : a.edges)
            for (const auto& [r, s] : b.edges) {
                if (least <= size * kMeasured) return 0;
                along(minus(mesh_.vertex(q), mesh_.vertex(p)), minus(mesh_.vertex(s), mesh_.vertex(r)), a, b, least);
            }
        return least <= size * kMeasured ? 0 : least;
    }

private:
    void gather(const Fans& fans, std::size_t sector) {
        Solid& solid = solids_[sector];
        std::set<Index> used;
        const Index first = mesh_.sector_first[sector], end = first + mesh_.sector_count[sector];
        for (Index s = first; s < end; ++s) {
            const Index start = mesh_.surface_start[static_cast<std::size_t>(s)];
            const Index size = mesh_.surface_start[static_cast<std::size_t>(s) + 1] - start;
            for (Index c = 0; c < size; ++c) {
                const Index here = mesh_.surface_vertex[static_cast<std::size_t>(start + c)];
                const Index next = mesh_.surface_vertex[static_cast<std::size_t>(start + (c + 1) % size)];
                used.insert(here);
                solid.edges.emplace(std::min(here, next), std::max(here, next));
            }
        }
        for (const Index v : used) solid.vertices.push_back(mesh_.vertex(v));
        for (Index t = fans.start[static_cast<std::size_t>(first)]; t < fans.start[static_cast<std::size_t>(end)]; ++t)
            solid.triangles.push_back(&fans.triangles[static_cast<std::size_t>(t)]);
    }

    // Whether a triangle of `a` exactly has all of `a` before it or on it, and all of `b` behind it or on it.
    static bool parted(const Solid& a, const Solid& b) {
        return std::any_of(a.triangles.begin(), a.triangles.end(), [&](const Fans::Triangle* t) {
            const auto side = [t](const double* v) { return volume(t->a, t->b, t->c, v).sign; };
            return std::all_of(b.vertices.begin(), b.vertices.end(), [&](const double* v) { return side(v) <= 0; }) &&
                   std::all_of(a.vertices.begin(), a.vertices.end(), [&](const double* v) { return side(v) >= 0; });
        });
    }

    // Lowers `least` to the overlap along the cross product of two edges.
    static void along(const Vector& u, const Vector& v, const Solid& a, const Solid& b, double& least) {
        const Vector axis = cross(u, v);
        const double size = length(axis);
        if (!(size > kThinnest * length(u) * length(v))) return;
        const double* origin = a.vertices.front();  // far from the world's origin the products stay small
        const auto [low_a, high_a] = reach(a, origin, axis);
        const auto [low_b, high_b] = reach(b, origin, axis);
        least = std::min(least, std::min(high_a - low_b, high_b - low_a) / size);
    }

    static std::pair<double, double> reach(const Solid& solid, const double* origin, const Vector& axis) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const double* v : solid.vertices) {
            const double at = dot(minus(v, origin), axis);
            low = std::min(low, at);
            high = std::max(high, at);
        }
        return {low, high};
    }

    const SectorMesh& mesh_;
    std::vector<Solid> solids_;
};

double size_of(const Box& a, const Box& b) {
    double size = 0;
    for (int k = 0; k < 3; ++k) size = std::max({size, a.high[k] - a.low[k], b.high[k] - b.low[k]});
    return size;
}

}  // namespace

Overlaps sector_overlaps(const SectorMesh& mesh, const Fans& fans) {
    const std::vector<Box> boxes = sector_boxes(mesh);
    const BoxTree tree(boxes);
    const Pairs pairs(mesh, fans);
    Overlaps out;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        std::vector<Index> near;
        tree.find([&](const Box& box) { return box.touches(boxes[i]); }, [&](Index j) { near.push_back(j); });
        std::sort(near.begin(), near.end());
        for (const Index j : near) {
            if (static_cast<std::size_t>(j) <= i) continue;
            const double depth = pairs.depth(i, static_cast<std::size_t>(j), size_of(boxes[i], boxes[static_cast<std::size_t>(j)]));
            if (depth <= 0) continue;
            out.first.push_back(static_cast<Index>(i));
            out.second.push_back(j);
            out.depth.push_back(depth);
        }
    }
    return out;
}

}  // namespace jk
