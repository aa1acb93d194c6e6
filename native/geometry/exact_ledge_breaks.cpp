#include "geometry/exact_ledge_breaks.hpp"

#include <algorithm>
#include <limits>

namespace jk::exact {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool share_height(const Triangle& a, const Triangle& b) {
    const auto [low, high] = std::minmax({a.a[2], a.b[2], a.c[2]});
    const auto [other_low, other_high] = std::minmax({b.a[2], b.b[2], b.c[2]});
    return low <= other_high && other_low <= high;
}

}  // namespace

Breaks::Breaks(const SectorMesh& mesh, const Rim& rim, const Gait& gait, const NearSolids& solids, const Number& from,
               const Number& to, bool further)
    : mesh_(mesh), rim_(rim), gait_(gait), solids_(solids), from_(from), to_(to), further_(further),
      breaks_{from, to} {
    of_solids();
}

const std::vector<Number>& Breaks::with(const std::set<Index>& visited, const std::vector<Plane>& planes) {
    for (const Index sector : visited)
        if (gathered_.insert(sector).second) of_sector(sector);
    for (; compared_ < planes.size(); ++compared_)
        for (const auto& [t, plane] : solids_.carriers) of_crossing(t, plane, planes[compared_]);
    std::sort(breaks_.begin(), breaks_.end());
    breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
    return breaks_;
}

void Breaks::of_sector(Index sector) {
    const Index first = mesh_.sector_first[static_cast<std::size_t>(sector)];
    const Index count = mesh_.sector_count[static_cast<std::size_t>(sector)];
    for (Index surface = first; surface < first + count; ++surface) {
        std::vector<Triangle> triangles;
        fan(surface_corners(mesh_, surface), surface, triangles);
        for (const Triangle& t : triangles)
            if (!t.outside(rim_.box())) of_triangle(t);
    }
}

void Breaks::of_solids() {
    for (const Triangle& t : solids_.all) of_triangle(t);
    for (std::size_t i = 0; i < solids_.carriers.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (share_extent(solids_.carriers[i].first, solids_.carriers[j].first) &&
                share_height(solids_.carriers[i].first, solids_.carriers[j].first))
                of_crossing(solids_.carriers[i].first, solids_.carriers[i].second, solids_.carriers[j].second);
}

std::pair<double, double> Breaks::rough_extent(const Triangle& t) const {
    double low = kInfinity, high = -kInfinity;
    for (const double* p : {t.a, t.b, t.c}) {
        const double at = rim_.along_of(p);
        low = std::min(low, at), high = std::max(high, at);
    }
    return {low - 1e-6, high + 1e-6};
}

bool Breaks::share_extent(const Triangle& a, const Triangle& b) const {
    const auto [low, high] = rough_extent(a);
    const auto [other_low, other_high] = rough_extent(b);
    return low <= other_high && other_low <= high;
}

// Whether a triangle reaches over the line along the edge on its `side`, or close to it.
bool Breaks::reaches(const Triangle& t, double side) const {
    double low = kInfinity, high = -kInfinity;
    for (const double* p : {t.a, t.b, t.c}) {
        const double at = rim_.off_of(p);
        low = std::min(low, at), high = std::max(high, at);
    }
    return low - 1e-6 <= side && side <= high + 1e-6;
}

// Where a triangle is at the height of a plane.
void Breaks::of_crossing(const Triangle& t, const Plane& own, const Plane& plane) {
    const auto [low, high] = rough_extent(t);
    for (int which = -1; which < (further_ ? 2 : 0); ++which) {
        const double side = which < 0 ? kBeyond : rim_.off(which);
        if (!reaches(t, side)) continue;
        const Vector first = rim_.exact_beside(Number(0), side), last = rim_.exact_beside(Number(1), side);
        const Number before = own.height(first.x, first.y) - plane.height(first.x, first.y);
        const Number after = own.height(last.x, last.y) - plane.height(last.x, last.y);
        if (before == after) continue;
        const Number met = before / (before - after);
        if (met >= Number(low) && met <= Number(high)) add(met);
    }
}

void Breaks::of_triangle(const Triangle& t) {
    if (clear_of_way(t)) return;
    const Vector corners[3] = {rim_.seen(t.a), rim_.seen(t.b), rim_.seen(t.c)};
    Number low = corners[0].x, high = corners[0].x;
    for (const Vector& c : corners) low = std::min(low, c.x), high = std::max(high, c.x);
    if (high < from_ || low > to_) return;
    for (int k = 0; k < 3; ++k) of_side(corners[k], corners[(k + 1) % 3]);
    // Where the lines along which the centre comes pass the triangle's plane.
    const Vector normal = cross(vector(t.b) - vector(t.a), vector(t.c) - vector(t.a));
    const Number change = dot(normal, rim_.exact_along());
    if (change == 0) return;
    const auto pierced = [&](double side, double up) {
        Vector from = rim_.exact_beside(Number(0), side);
        from.z += Number(up);
        const Number met = dot(normal, vector(t.a) - from) / change;
        if (met >= low && met <= high) add(met);
    };
    pierced(-kBeyond, rim_.start_up());
    for (Index rise = 0; rise <= gait_.rises; ++rise)
        for (const double side : {-kBeyond, kBeyond}) pierced(side, gait_.hover + rise * gait_.rise);
}

// Whether a triangle lies on one side of all that the centre comes over, by far more than a rounding.
bool Breaks::clear_of_way(const Triangle& t) const {
    double low = kInfinity, high = -kInfinity;
    for (const double* p : {t.a, t.b, t.c}) {
        const double off = rim_.off_of(p);
        low = std::min(low, off), high = std::max(high, off);
    }
    return low > (further_ ? rim_.off(1) : 0) + kAround || high < -kAround;
}

void Breaks::of_side(const Vector& a, const Vector& b) {
    for (const double side : {-kBeyond, 0.0, kBeyond})
        cross_at(a, b, a.y - Number(side), b.y - Number(side));
    for (int which = 0; further_ && which < 2; ++which)
        cross_at(a, b, a.y - Number(rim_.off(which)), b.y - Number(rim_.off(which)));
    const Number reach(further_ ? rim_.off(1) + kSlab : kSlab);
    if ((a.y > reach && b.y > reach) || (a.y < -kSlab && b.y < -kSlab)) return;
    for (const Vector& p : {a, b})
        if (CGAL::abs(p.y) <= Number(kSlab)) add(p.x);
    for (Index rise = 0; rise <= gait_.rises; ++rise) {
        const Number up(gait_.hover + rise * gait_.rise);
        cross_at(a, b, a.z - up, b.z - up);
    }
}

void Breaks::cross_at(const Vector& a, const Vector& b, const Number& before, const Number& after) {
    if ((before < 0) != (after < 0)) add(a.x + (b.x - a.x) * (before / (before - after)));
}

void Breaks::add(const Number& t) {
    if (t > from_ && t < to_) breaks_.push_back(t);
}

}  // namespace jk::exact
