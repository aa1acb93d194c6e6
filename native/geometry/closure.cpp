#include "geometry/closure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace jk {
namespace {

using Point = std::array<double, 3>;

struct HalfEdge {
    Index surface, corner;
    double length;
};

Point position(const SectorMesh& mesh, Index corner) {
    const double* v = mesh.vertex(mesh.surface_vertex[static_cast<std::size_t>(corner)]);
    return {v[0], v[1], v[2]};
}

double distance(const Point& a, const Point& b) { return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]); }

// Calls visit(surface, corner within it, from, to) for every edge of the surfaces [first, end).
template <typename Visit>
void each_edge(const SectorMesh& mesh, Index first, Index end, const Visit& visit) {
    for (Index s = first; s < end; ++s) {
        const Index start = mesh.surface_start[static_cast<std::size_t>(s)];
        const Index size = mesh.surface_start[static_cast<std::size_t>(s) + 1] - start;
        for (Index i = 0; i < size; ++i)
            visit(s, i, position(mesh, start + i), position(mesh, start + (i + 1) % size));
    }
}

void find_open_edges(const SectorMesh& mesh, std::size_t sector, Closure& out) {
    std::map<std::pair<Point, Point>, std::vector<HalfEdge>> edges;
    const Index first = mesh.sector_first[sector], end = first + mesh.sector_count[sector];
    each_edge(mesh, first, end, [&](Index surface, Index corner, const Point& from, const Point& to) {
        if (from == to) return;
        const auto opposite = edges.find({to, from});
        if (opposite == edges.end()) {
            edges[{from, to}].push_back({surface, corner, distance(from, to)});
            return;
        }
        opposite->second.pop_back();
        if (opposite->second.empty()) edges.erase(opposite);
    });
    for (const auto& [ends, left] : edges)
        for (const HalfEdge& edge : left) {
            ++out.open[sector];
            if (out.surface[sector] >= 0 && edge.length <= out.length[sector]) continue;
            out.surface[sector] = edge.surface;
            out.corner[sector] = edge.corner;
            out.length[sector] = edge.length;
        }
}

// The sum of the tetrahedra between the triangles and one corner of the sector.
void measure_volume(const SectorMesh& mesh, const Fans& fans, std::size_t sector, Closure& out) {
    const auto first = static_cast<std::size_t>(mesh.sector_first[sector]);
    const auto end = first + static_cast<std::size_t>(mesh.sector_count[sector]);
    double sum = 0, error = 0;
    for (Index t = fans.start[first]; t < fans.start[end]; ++t) {
        const Fans::Triangle& k = fans.triangles[static_cast<std::size_t>(t)];
        const Volume part = volume(k.a, k.b, k.c, fans.triangles[static_cast<std::size_t>(fans.start[first])].a);
        sum += part.value;
        error += part.error + 0x1p-52 * std::abs(sum);
    }
    out.volume[sector] = sum / 6;
    out.certain[sector] = std::abs(sum) > error * (1 + 0x1p-40);
}

}  // namespace

Closure sector_closure(const SectorMesh& mesh, const Fans& fans) {
    const std::size_t n = mesh.sectors();
    Closure out{std::vector<Index>(n),  std::vector<Index>(n, -1), std::vector<Index>(n, -1),
                std::vector<double>(n), std::vector<double>(n),    std::vector<std::uint8_t>(n)};
    for (std::size_t s = 0; s < n; ++s) {
        find_open_edges(mesh, s, out);
        measure_volume(mesh, fans, s, out);
    }
    return out;
}

Edges surface_edges(const SectorMesh& mesh, const Fans& fans) {
    const std::size_t n = mesh.surfaces();
    Edges out{std::vector<Index>(n, -1), std::vector<Index>(n), std::vector<double>(n)};
    each_edge(mesh, 0, static_cast<Index>(n), [&](Index surface, Index corner, const Point& from, const Point& to) {
        const auto s = static_cast<std::size_t>(surface);
        const double length = distance(from, to);
        if (out.corner[s] >= 0 && length >= out.length[s]) return;
        out.corner[s] = corner;
        out.length[s] = length;
    });
    for (std::size_t s = 0; s < n; ++s) {
        const Index corners = mesh.surface_start[s + 1] - mesh.surface_start[s];
        out.degenerate[s] = std::max(0, corners - 2) - (fans.start[s + 1] - fans.start[s]);
    }
    return out;
}

}  // namespace jk
