#include "geometry/visibility_portals.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "geometry/volume.hpp"

namespace jk::vis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double length(const Point& a) { return std::sqrt(dot(a, a)); }
Point point(const double* v) { return {v[0], v[1], v[2]}; }
const double* coordinates(const Point& p) { return &p.x; }

Precision precision_of(const SectorMesh& mesh) {
    Box all = Box::nothing();
    for (const Index v : mesh.surface_vertex) all.add(mesh.vertex(v));
    double size = 0, farthest = 0;
    for (int k = 0; k < 3 && !mesh.surface_vertex.empty(); ++k) {
        size += all.high[k] - all.low[k];
        farthest = std::max({farthest, std::abs(all.low[k]), std::abs(all.high[k])});
    }
    // Subnormal coordinates lose digits beyond u.
    constexpr double kUnderflow = 0x1p-1000;
    return {0x1p-49 * size + kUnderflow, 0x1p-49 * (size + farthest) + kUnderflow, 0x1p-16 * size};
}

// The plane of the triangle with the greatest area, and how far the others and the corners are from it.
void find_plane(Portal& portal, std::span<const Fans::Triangle> fan, const Precision& precision) {
    const auto sides = [](const Fans::Triangle& t) {
        const Point a = point(t.a), b = point(t.b), c = point(t.c);
        return std::array{b - a, c - a};
    };
    double greatest = -1;
    for (const Fans::Triangle& t : fan) {
        const auto [e, f] = sides(t);
        const Point n = cross(e, f);
        if (!(length(n) > greatest)) continue;
        greatest = length(n);
        portal.normal = n;
    }
    portal.corner = portal.winding.points[0];
    portal.normal = (1 / greatest) * portal.normal;
    portal.lean = portal.bend = 0;
    for (const Fans::Triangle& t : fan) {
        const auto [e, f] = sides(t);
        const Point n = cross(e, f);
        const double rounding = 0x1p-49 * length(e) * length(f) / length(n);
        const double lean = length((1 / length(n)) * n - portal.normal) + rounding;
        portal.lean = std::max(portal.lean, lean < 1 ? lean : 2.0);
    }
    if (!(greatest > 0) || !std::isfinite(greatest)) portal.lean = kInfinity;
    for (const Point& p : portal.winding.points)
        portal.bend = std::max(portal.bend, std::abs(portal.height(p)) + precision.error);
}

bool is_flat(const Portal& portal, const Fans::Triangle& t) {
    return std::all_of(portal.winding.points.begin(), portal.winding.points.end(),
                       [&](const Point& p) { return volume(t.a, t.b, t.c, coordinates(p)).sign == 0; });
}

bool same(const Point& x, const Point& y) { return x.x == y.x && x.y == y.y && x.z == y.z; }

bool has(const Winding& winding, const Point& x) {
    return std::any_of(winding.points.begin(), winding.points.end(), [&](const Point& y) { return same(x, y); });
}

// How alike two portals are: 3 when they have the same points, 2 when those of one are among the other's, 1 when they
// share an edge's worth.
int likeness(const Portal& p, const Portal& q) {
    const auto& few = p.winding.points.size() < q.winding.points.size() ? p.winding : q.winding;
    const auto& many = p.winding.points.size() < q.winding.points.size() ? q.winding : p.winding;
    const auto shared = static_cast<std::size_t>(
        std::count_if(few.points.begin(), few.points.end(), [&](const Point& x) { return has(many, x); }));
    if (shared == few.points.size()) return few.points.size() == many.points.size() ? 3 : 2;
    return shared > 1 ? 1 : 0;
}

// Puts a point into the outline's nearest edge.
void insert(Winding& outline, const Point& x) {
    std::size_t nearest = 0;
    double least = kInfinity;
    for (std::size_t i = 0; i < outline.points.size(); ++i) {
        const Point &a = outline.points[i], &b = outline.points[(i + 1) % outline.points.size()];
        const double detour = length(x - a) + length(b - x) - length(b - a);
        if (detour < least) least = detour, nearest = i;
    }
    outline.points.insert(outline.points.begin() + static_cast<std::ptrdiff_t>(nearest) + 1, x);
}

bool touch(const Portal& p, const Portal& q) { return p.box.touches(q.box); }

}  // namespace

std::size_t Bits::count(std::size_t i) const {
    std::size_t sum = 0;
    for (std::size_t w = 0; w < words_; ++w) sum += static_cast<std::size_t>(std::popcount(row(i)[w]));
    return sum;
}

double Portal::slack(const Winding& other, const Precision& precision) const {
    double farthest = 0;
    for (const Point& p : other.points) farthest = std::max(farthest, dot(p - corner, p - corner));
    farthest = std::sqrt(farthest) * (1 + 0x1p-40) + other.radius;
    return bend + lean * farthest + precision.error;
}

HalfSpace Portal::before(const Winding& other, const Precision& precision) const {
    return {normal, corner, -slack(other, precision)};
}

HalfSpace Portal::after(const Winding& other, const Precision& precision) const {
    return {-1 * normal, corner, -slack(other, precision)};
}

bool Portal::may_be_before(const Winding& other) const {
    const double least = -most_slack - 4 * other.radius;  // the lean is 2 at most or infinite
    return std::any_of(other.points.begin(), other.points.end(),
                       [&](const Point& p) { return !(height(p) < least); });
}

// What lies wholly on the side of the plane that is wanted lies there with any slack.
bool Portal::cut_before(Winding& other, const Precision& precision) const {
    if (holds({normal, corner, -bend - precision.error}, other, precision)) return true;
    return clip(other, before(other, precision), precision);
}

bool Portal::cut_after(Winding& other, const Precision& precision) const {
    if (holds({-1 * normal, corner, -bend - precision.error}, other, precision)) return true;
    return clip(other, after(other, precision), precision);
}

Portals::Portals(const SectorMesh& mesh, const Fans& fans, std::span<const Index> leads_to)
    : precision(precision_of(mesh)) {
    sector_start.push_back(0);
    for (std::size_t sector = 0; sector < mesh.sectors(); ++sector) {
        const auto first = static_cast<std::size_t>(mesh.sector_first[sector]);
        for (std::size_t s = first; s < first + static_cast<std::size_t>(mesh.sector_count[sector]); ++s) {
            const auto fan = std::span(fans.triangles).subspan(static_cast<std::size_t>(fans.start[s]),
                                                               static_cast<std::size_t>(fans.start[s + 1] - fans.start[s]));
            if (leads_to[s] == kBlocks || fan.empty()) continue;
            Portal portal{};
            portal.box = Box::nothing();
            for (Index i = mesh.surface_start[s]; i < mesh.surface_start[s + 1]; ++i) {
                const double* v = mesh.vertex(mesh.surface_vertex[static_cast<std::size_t>(i)]);
                portal.winding.points.push_back(point(v));
                portal.box.add(v);
            }
            find_plane(portal, fan, precision);
            portal.flat = is_flat(portal, fan[0]);
            portal.from = static_cast<Index>(sector), portal.to = leads_to[s], portal.surface = static_cast<Index>(s);
            portals.push_back(std::move(portal));
        }
        sector_start.push_back(static_cast<Index>(portals.size()));
    }
    find_twins();
    // The error is 2^-49 of the level's size, which is no less than any distance in it.
    for (Portal& p : portals) p.most_slack = p.bend + p.lean * 0x1p50 * precision.error + precision.error;
}

// A surface and its mirror have the same corners, or either has more of them along its edges. The portals of both then
// take the points of both, planes that are each other's reverse, and the looser bounds, so that what can be crossed one
// way can be crossed the other way.
void Portals::find_twins() {
    std::map<std::pair<Index, Index>, std::vector<std::size_t>> between;
    for (std::size_t i = 0; i < portals.size(); ++i) {
        portals[i].twin = -1;
        between[{portals[i].from, portals[i].to}].push_back(i);
    }
    for (const auto& [ends, those] : between) {
        const auto back = between.find({ends.second, ends.first});
        if (ends.first > ends.second || back == between.end()) continue;
        for (const int like : {3, 2, 1})
            for (const std::size_t p : those)
                for (const std::size_t q : back->second)
                    if (p != q && portals[p].twin < 0 && portals[q].twin < 0 && likeness(portals[p], portals[q]) == like)
                        pair_up(p, q);
    }
}

void Portals::pair_up(std::size_t first, std::size_t second) {
    const bool larger = portals[first].winding.points.size() >= portals[second].winding.points.size();
    const std::size_t p = larger ? first : second, q = larger ? second : first;
    Portal &model = portals[p], &other = portals[q];
    for (const Point& x : other.winding.points) {
        if (has(model.winding, x)) continue;
        insert(model.winding, x);
        model.box.add(coordinates(x));
        model.bend = std::max(model.bend, std::abs(model.height(x)) + precision.error);
        model.flat = false;
    }
    const double apart = length(model.normal + other.normal);
    model.lean = other.lean = std::max(model.lean, other.lean + apart * (1 + 0x1p-20) + 0x1p-50);
    other.normal = -1 * model.normal, other.corner = model.corner, other.bend = model.bend;
    other.winding = model.winding, other.box = model.box, other.flat = model.flat;
    std::reverse(other.winding.points.begin(), other.winding.points.end());
    model.twin = static_cast<Index>(q), other.twin = static_cast<Index>(p);
}

// Whether a point of the other portal lies on the side of the plane, 1 for its inner side, -1 for behind it.
bool Portals::behind(const Portal& plane, const Portal& other, double side) const {
    const HalfSpace half = plane.before(other.winding, precision);
    bool doubt = false;
    for (const Point& p : other.winding.points) {
        const double over = side * plane.height(p);
        if (over > -half.least) return true;
        doubt |= over >= half.least;
    }
    if (!doubt) return false;
    if (!plane.flat) return true;
    const auto& ring = plane.winding.points;
    // Exact, with a triangle of the plane that turns as the normal says.
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
        const double *a = coordinates(ring[0]), *b = coordinates(ring[k]), *c = coordinates(ring[k + 1]);
        if (on_one_line(a, b, c)) continue;
        const double turn = dot(cross(ring[k] - ring[0], ring[k + 1] - ring[0]), plane.normal) > 0 ? side : -side;
        return std::any_of(other.winding.points.begin(), other.winding.points.end(),
                           [&](const Point& p) { return turn * volume(a, b, c, coordinates(p)).sign > 0; });
    }
    return true;
}

bool Portals::can_follow(std::size_t first, std::size_t second) const {
    const Portal &p = portals[first], &q = portals[second];
    const bool beyond = behind(p, q, -1), ahead = behind(q, p, 1);
    if (beyond && ahead) return true;
    // A segment that is strictly behind p afterwards can cross q in p's plane only where it crosses p.
    if (!touch(p, q)) return false;
    return !(p.flat && q.flat && !beyond && !ahead && !behind(p, q, 1) && dot(p.normal, q.normal) < 0);
}

void Portals::flood(std::size_t p, Bits& reached) const {
    std::vector<Index> sectors{portals[p].to};
    std::vector<std::uint8_t> entered(sector_start.size() - 1);
    entered[static_cast<std::size_t>(portals[p].to)] = 1;
    while (!sectors.empty()) {
        const auto sector = static_cast<std::size_t>(sectors.back());
        sectors.pop_back();
        for (auto q = static_cast<std::size_t>(sector_start[sector]);
             q < static_cast<std::size_t>(sector_start[sector + 1]); ++q) {
            if (q == p || !can_follow(p, q)) continue;
            reached.set(p, q);
            const auto to = static_cast<std::size_t>(portals[q].to);
            if (!entered[to]) entered[to] = 1, sectors.push_back(portals[q].to);
        }
    }
}

}  // namespace jk::vis
