#include "geometry/locate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/threads.hpp"

namespace jk {
namespace {

// Directions for probes: no two alike, none along an axis, a diagonal or each other's mirror.
constexpr int kProbes = 64;

std::array<double, 3> direction(int probe) {
    const double a = 0.7548776662466927 * (probe + 1), b = 0.5698402909980532 * (probe + 1);  // of the plastic number
    return {2 * (a - std::floor(a)) - 1, 2 * (b - std::floor(b)) - 1, probe % 2 ? 0.6180339887498949 : -0.7320508075688772};
}

bool on_triangle(const Fans::Triangle& t, const double* p) {
    if (volume(t.a, t.b, t.c, p).sign != 0) return false;
    double size = 0;  // as great as the coordinates: less would be lost beside them
    for (const double* corner : {t.a, t.b, t.c})
        for (int k = 0; k < 3; ++k) size = std::max(size, std::abs(corner[k]));
    // In the plane: seen from a point before it, the corners turn counter-clockwise around p, or p is on an edge.
    for (int probe = 0; probe < kProbes; ++probe) {
        const auto d = direction(probe);
        const double eye[3] = {t.a[0] + size * d[0], t.a[1] + size * d[1], t.a[2] + size * d[2]};
        const int side = volume(t.a, t.b, t.c, eye).sign;
        if (side == 0) continue;
        // Four points change hands when they move up by one place.
        return volume(eye, t.a, t.b, p).sign * side <= 0 && volume(eye, t.b, t.c, p).sign * side <= 0 &&
               volume(eye, t.c, t.a, p).sign * side <= 0;
    }
    return false;
}

}  // namespace

Locator::Locator(const SectorMesh& mesh, const Fans& fans)
    : mesh_(mesh), fans_(fans), boxes_(sector_boxes(mesh)), tree_(boxes_), closed_(mesh.sectors()) {
    for (std::size_t s = 0; s < closed_.size(); ++s) closed_[s] = closed(s);
}

// Whether every edge of the triangles is met by as many edges the other way, by position.
bool Locator::closed(std::size_t sector) const {
    using Point = std::array<double, 3>;
    std::map<std::pair<Point, Point>, int> balance;
    const auto first = static_cast<std::size_t>(mesh_.sector_first[sector]);
    const auto end = first + static_cast<std::size_t>(mesh_.sector_count[sector]);
    for (std::size_t s = first; s < end; ++s) {
        const auto corner = static_cast<std::size_t>(mesh_.surface_start[s]);
        const std::size_t size = static_cast<std::size_t>(mesh_.surface_start[s + 1]) - corner;
        for (std::size_t i = 0; i < size; ++i) {
            Point ends[2];
            for (std::size_t k = 0; k < 2; ++k) {
                const double* v = mesh_.vertex(mesh_.surface_vertex[corner + (i + k) % size]);
                ends[k] = {v[0], v[1], v[2]};
            }
            if (ends[0] < ends[1])
                ++balance[{ends[0], ends[1]}];
            else if (ends[1] < ends[0])
                --balance[{ends[1], ends[0]}];
        }
    }
    return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

Place Locator::behind_none(Index first, Index end, const double* point) const {
    Place place = first < end ? Place::kInside : Place::kOutside;
    for (Index t = first; t < end; ++t) {
        const Fans::Triangle& k = fans_.triangles[static_cast<std::size_t>(t)];
        const int side = volume(k.a, k.b, k.c, point).sign;
        if (side < 0) return Place::kOutside;
        if (side == 0) place = Place::kOn;
    }
    return place;
}

// Counts crossings outward less inward; false when the probe meets an edge, a vertex or a plane that it starts in.
bool Locator::winding(Index first, Index end, const Segment& probe, int& turns) const {
    turns = 0;
    for (Index t = first; t < end; ++t) {
        const Fans::Triangle& k = fans_.triangles[static_cast<std::size_t>(t)];
        const int from = volume(k.a, k.b, k.c, probe.a).sign, to = volume(k.a, k.b, k.c, probe.b).sign;
        if (from == to && from != 0) continue;
        const int ab = volume(probe.a, probe.b, k.a, k.b).sign, bc = volume(probe.a, probe.b, k.b, k.c).sign,
                  ca = volume(probe.a, probe.b, k.c, k.a).sign;
        const bool apart = std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0;
        if (apart) continue;
        if (from == 0 || to == 0 || ab == 0 || bc == 0 || ca == 0) return false;
        turns += from;
    }
    return true;
}

Place Locator::place(Index sector, const double* point) const {
    const auto s = static_cast<std::size_t>(sector);
    const Box& box = boxes_[s];
    if (!box.holds(point)) return Place::kOutside;
    const auto surface = static_cast<std::size_t>(mesh_.sector_first[s]);
    const Index first = fans_.start[surface];
    const Index end = fans_.start[surface + static_cast<std::size_t>(mesh_.sector_count[s])];
    if (!closed_[s]) return behind_none(first, end, point);
    for (Index t = first; t < end; ++t)
        if (on_triangle(fans_.triangles[static_cast<std::size_t>(t)], point)) return Place::kOn;
    const double size = 4 * std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
    for (int probe = 0; probe < kProbes; ++probe) {
        const auto d = direction(probe);
        const double far[3] = {point[0] + size * d[0], point[1] + size * d[1], point[2] + size * d[2]};
        int turns;
        if (box.holds(far) || !winding(first, end, {point, far}, turns)) continue;
        return turns != 0 ? Place::kInside : Place::kOutside;
    }
    return behind_none(first, end, point);
}

Place Locator::rough_place(Index sector, const double* point) const {
    const auto s = static_cast<std::size_t>(sector), surface = static_cast<std::size_t>(mesh_.sector_first[s]);
    if (!boxes_[s].holds(point)) return Place::kOutside;
    return fast_place(fans_, fans_.start[surface],
                      fans_.start[surface + static_cast<std::size_t>(mesh_.sector_count[s])], point);
}

Location Locator::locate(std::span<const double> points, bool fast, unsigned threads) const {
    const std::size_t rows = points.size() / 3;
    Location out{std::vector<Index>(rows, -1), std::vector<Index>(rows), std::vector<Index>(rows)};
    share_out(rows, threads, [&](std::size_t row) {
        const double* point = &points[3 * row];
        Index within = -1, beside = -1;
        tree_.find([&](const Box& box) { return box.holds(point); }, [&](Index sector) {
            const Place found = fast ? rough_place(sector, point) : place(sector, point);
            if (found == Place::kOutside) return;
            const bool inside = found == Place::kInside;
            ++(inside ? out.inside : out.touching)[row];
            Index& least = inside ? within : beside;
            if (least < 0 || sector < least) least = sector;
        });
        out.sector[row] = within >= 0 ? within : beside;
    });
    return out;
}

std::size_t Locator::memory() const {
    return boxes_.capacity() * sizeof(Box) + tree_.memory() + closed_.capacity();
}

}  // namespace jk
