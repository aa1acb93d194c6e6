#include "geometry/ledge_breaks.hpp"

#include <algorithm>
#include <cmath>

namespace jk::ledge {

Breaks::Breaks(const Rim& rim, const Gait& gait, const Surroundings& around)
    : rim_(rim), gait_(gait), around_(around) {}

void Breaks::begin(double from, double to, bool further) {
    from_ = from, to_ = to, further_ = further;
    gathered_.clear(), breaks_ = {from, to};
    of_solids();
}

const std::vector<double>& Breaks::sorted() {
    std::sort(breaks_.begin(), breaks_.end());
    return breaks_;
}

// Adds the breaks of sectors and planes that came up since; tells whether there were any.
bool Breaks::gather(std::vector<Index>& visited) {
    std::sort(visited.begin(), visited.end());
    visited.erase(std::unique(visited.begin(), visited.end()), visited.end());
    bool more = false;
    for (const Index sector : visited) {
        const auto place = std::lower_bound(gathered_.begin(), gathered_.end(), sector);
        if (place != gathered_.end() && *place == sector) continue;
        gathered_.insert(place, sector);
        for (const Index i : around_.of_sector(sector)) {
            of_triangle(around_.triangle(i));
            if (rim_.of_face()) pierced(around_.triangle(i), rim_.inner(0));
        }
        more = true;
    }
    for (; compared_ < planes_.size(); ++compared_)
        for (const Index i : around_.of_solids())
            if (around_.carries(i)) more |= meets(around_.triangle(i), planes_[compared_], {from_, to_});
    return more;
}

void Breaks::remember(const Plane& plane) {
    if (around_.of_solids().empty()) return;
    for (const Plane& known : planes_)
        if (known.corner == plane.corner && known.normal == plane.normal) return;
    planes_.push_back(plane);
}

void Breaks::of_solids() {
    const auto faces = around_.of_solids();
    compared_ = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const Strides::Triangle& t = around_.triangle(faces[i]);
        of_triangle(t);
        pierced(t, rim_.inner(0));
        for (Index rise = 0; rise <= gait_.rises; ++rise)
            for (const double side : {-kBeyond, kBeyond})
                pierced(t, rim_.beside(0, side, gait_.hover + rise * gait_.rise));
        if (!around_.carries(faces[i])) continue;
        for (std::size_t j = 0; j < i; ++j)
            if (around_.carries(faces[j])) {
                const Strides::Triangle& other = around_.triangle(faces[j]);
                meets(t, {other.normal, other.corner}, extent(other));
            }
    }
}

// Where a straight line along the edge passes a triangle's plane, in the triangle or as near to it as matters: who goes
// past it elsewhere is stopped by others.
void Breaks::pierced(const Strides::Triangle& t, const Point& from) {
    double before = 0, change = 0;
    for (std::size_t k = 0; k < 3; ++k)
        before += t.normal[k] * (from[k] - t.corner[k]), change += t.normal[k] * rim_.along()[k];
    if (change == 0) return;
    const double at = -before / change;
    if (!(at > 0 && at < 1)) return;
    for (std::size_t side = 0; side < 3; ++side) {
        double inside = -t.side[side];
        for (std::size_t k = 0; k < 3; ++k) inside += t.inward[side][k] * (from[k] + at * rim_.along()[k]);
        if (inside < -kSlab) return;
    }
    add(at);
}

// From where to where a triangle goes along the edge.
Breaks::Extent Breaks::extent(const Strides::Triangle& t) const {
    const auto [low, high] = std::minmax({rim_.seen(t.corners[0]).t, rim_.seen(t.corners[1]).t, rim_.seen(t.corners[2]).t});
    return {low, high};
}

// Where a triangle and a plane, within an extent of its own, are at one height.
bool Breaks::meets(const Strides::Triangle& t, const Plane& plane, const Extent& of_plane) {
    bool any = false;
    const Plane own{t.normal, t.corner};
    const Extent here = extent(t);
    const auto [low, high] =
        std::minmax({rim_.seen(t.corners[0]).off, rim_.seen(t.corners[1]).off, rim_.seen(t.corners[2]).off});
    const double first_t = std::max(here[0], of_plane[0]), last_t = std::min(here[1], of_plane[1]);
    for (int which = -1; which < (further_ ? 2 : 0); ++which) {
        const double side = which < 0 ? kBeyond : rim_.off(which);
        if (side < low || side > high) continue;
        const Point first = rim_.beside(0, side, 0), last = rim_.beside(1, side, 0);
        const double before = own.height(first) - plane.height(first), after = own.height(last) - plane.height(last);
        if ((before < 0) == (after < 0)) continue;
        const double t_met = before / (before - after);
        if (t_met < first_t || t_met > last_t) continue;
        add(t_met);
        any = true;
    }
    return any;
}

void Breaks::of_triangle(const Strides::Triangle& t) {
    const Seen corners[3] = {rim_.seen(t.corners[0]), rim_.seen(t.corners[1]), rim_.seen(t.corners[2])};
    for (std::size_t k = 0; k < 3; ++k) of_side(corners[k], corners[(k + 1) % 3]);
}

void Breaks::of_side(const Seen& a, const Seen& b) {
    if (std::max(a.t, b.t) < from_ || std::min(a.t, b.t) > to_) return;
    for (const double side : {-kBeyond, 0.0, kBeyond}) cross(a, b, a.off - side, b.off - side);
    if (further_)
        for (int which = 0; which < 2; ++which) cross(a, b, a.off - rim_.off(which), b.off - rim_.off(which));
    const double reach = further_ ? rim_.off(1) + kSlab : kSlab;
    if (std::min(a.off, b.off) > reach || std::max(a.off, b.off) < -kSlab) return;
    if (std::abs(a.off) <= kSlab) add(a.t);
    if (std::abs(b.off) <= kSlab) add(b.t);
    for (Index rise = 0; rise <= gait_.rises; ++rise) {
        const double up = gait_.hover + rise * gait_.rise;
        cross(a, b, a.up - up, b.up - up);
    }
}

void Breaks::cross(const Seen& a, const Seen& b, double before, double after) {
    if ((before < 0) != (after < 0)) add(a.t + (b.t - a.t) * (before / (before - after)));
}

void Breaks::add(double t) {
    if (t > from_ && t < to_) breaks_.push_back(t);
}

}  // namespace jk::ledge
