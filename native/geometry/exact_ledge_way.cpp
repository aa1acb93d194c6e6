#include "geometry/exact_ledge_way.hpp"

#include <cmath>
#include <limits>

namespace jk::exact {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Over over_of(Ending ending) {
    switch (ending) {
        case Ending::kFloor: return Over::kFloor;
        case Ending::kSolid: return Over::kSolid;
        case Ending::kWater: return Over::kWater;
        default: return Over::kVoid;
    }
}

}  // namespace

NearSolids::NearSolids(const Strides& strides, const Rim& rim, std::span<const std::uint8_t> active) {
    const Solids& solids = strides.solids();
    for (std::size_t f = 0; f < solids.faces(); ++f) {
        if (!active[static_cast<std::size_t>(solids.face_solid[f])]) continue;
        std::vector<Triangle> triangles;
        fan(face_corners(solids, static_cast<Index>(f)), static_cast<Index>(f), triangles);
        for (const Triangle& t : triangles) {
            if (t.outside(rim.box())) continue;
            all.push_back(t);
            if (solids.face_carries[f])
                if (const auto plane = t.upward()) carriers.emplace_back(t, *plane);
        }
    }
}

struct Way::Moved {
    Index sector, blocker, face;
    bool blocked() const { return blocker >= 0 || face >= 0; }
};

struct Way::Landed {
    Over over;
    Index surface, face, sector;
    std::optional<Plane> plane;
};

void Way::forget() {
    visited_.clear();
    planes_.clear();
    if (rim_.home() >= 0) return;
    const Box close = rim_.close_box();
    for (std::size_t s = 0; s < world_.mesh.sectors(); ++s)
        if (world_.strides.box(static_cast<Index>(s)).touches(close)) visited_.insert(static_cast<Index>(s));
}

Index Way::home_of(const Point& p) {
    if (rim_.home() >= 0) return rim_.home();
    Index on = -1;
    for (std::size_t s = 0; s < world_.mesh.sectors(); ++s) {
        const auto sector = static_cast<Index>(s);
        if (!world_.strides.box(sector).holds(p.data())) continue;
        const Place place = world_.strides.locator().place(sector, p.data());
        if (place == Place::kInside) return visited_.insert(sector), sector;
        if (place == Place::kOn && on < 0) on = sector;
    }
    return on;
}

Way::Moved Way::go(Index sector, const Point& from, const Point& to) {
    std::vector<Step> path;
    const Verdict verdict = world_.viewer.explain(from, sector, to, path);
    for (const Step& step : path) visited_.insert(step.sector);
    double stopped = verdict.visible ? 1 : path.back().leave;
    Moved way{path.back().sector, verdict.blocker, -1};
    Box around = Box::nothing();
    around.add(from.data()), around.add(to.data());
    for (const Triangle& t : solids_.all) {
        if (t.outside(around)) continue;
        const auto part = t.pierced(vector(from.data()), vector(to.data()));
        if (part && CGAL::to_double(*part) < stopped)
            stopped = CGAL::to_double(*part), way = {sector, -1, t.owner};
    }
    return way;
}

Way::Landed Way::fall(Index sector, const Point& from) {
    const Index sectors[] = {sector};
    const double limits[] = {kInfinity};
    const Drops drops = world_.faller.drop(from, sectors, limits, Tier::kBalanced, 1);
    const Landing landing{static_cast<Ending>(drops.ending[0]), drops.met[0], drops.sector[0], drops.distance[0]};
    const Number x = number(from[0]), y = number(from[1]), z = number(from[2]);
    Landed landed{over_of(landing.ending), landing.met, -1, landing.sector, std::nullopt};
    visited_.insert(sector);
    visited_.insert(landing.sector);
    if (std::isfinite(landing.distance)) go_down(sector, from, landing.distance);
    if (landing.met >= 0) landed.plane = plane_of(landing, from);
    std::optional<Number> highest;
    if (landed.plane) highest = landed.plane->height(x, y);
    if (landed.over == Over::kWater && landing.met < 0) highest = z;
    Box under = Box::nothing();
    under.add(from.data());
    under.low[2] = -kInfinity;
    for (const auto& [t, plane] : solids_.carriers) {
        if (t.outside(under) || !t.holds(x, y)) continue;
        const Number height = plane.height(x, y);
        if (height > z || (highest && height <= *highest)) continue;
        highest = height;
        landed = {Over::kFloor, -1, t.owner, landing.sector, plane};
    }
    return landed;
}

// The sectors on the way down.
void Way::go_down(Index sector, const Point& from, double depth) {
    std::vector<Step> path;
    const Point to = {from[0], from[1], from[2] - depth};
    world_.viewer.explain(from, sector, to, path);
    for (const Step& step : path) visited_.insert(step.sector);
}

// The triangle of a surface's fan that lies at a depth below a point: the one that comes nearest.
std::optional<Plane> Way::plane_of(const Landing& landing, const Point& from) const {
    std::vector<Triangle> triangles;
    fan(surface_corners(world_.mesh, landing.met), landing.met, triangles);
    const Number x = number(from[0]), y = number(from[1]), z = number(from[2]) - Number(landing.distance);
    std::optional<Plane> best;
    std::optional<Number> least;
    for (const Triangle& t : triangles) {
        const auto plane = t.upward();
        if (!plane || !t.holds(x, y)) continue;
        const Number apart = CGAL::abs(plane->height(x, y) - z);
        if (!least || apart < *least) least = apart, best = plane;
    }
    return best;
}

Met Way::at(double t, bool further) {
    const Point inner = rim_.beside(t, -kBeyond, rim_.start_up());
    const Index home = home_of(inner);
    Met met{Over::kBlocked, -1, -1, home, 0, std::nullopt, {}};
    if (home < 0) return met;
    for (Index rise = 0; rise <= gait_.rises; ++rise) {
        const double up = gait_.hover + rise * gait_.rise;
        const Point before = rim_.beside(t, -kBeyond, up), beyond = rim_.beside(t, kBeyond, up);
        const Moved lifted = go(home, inner, before);
        if (lifted.blocked()) {
            if (rise == 0) stop(met, lifted);
            break;
        }
        const Moved over = go(lifted.sector, before, beyond);
        if (over.blocked()) {
            if (rise == 0) stop(met, over);
            continue;
        }
        Landed landed = fall(over.sector, beyond);
        met = {landed.over, landed.surface, landed.face, landed.sector, rise, landed.plane, {}};
        if (landed.plane) remember(*landed.plane, landed.face);
        if (further && rise == 0)
            for (int which = 0; which < 2; ++which) met.further[which] = look_further(over.sector, t, which);
        break;
    }
    return met;
}

void Way::stop(Met& met, const Moved& way) {
    met.surface = way.blocker, met.face = way.face, met.sector = way.sector;
}

Further Way::look_further(Index sector, double t, int which) {
    const Point there = rim_.beside(t, rim_.off(which), gait_.hover);
    const Moved way = go(sector, rim_.beside(t, kBeyond, gait_.hover), there);
    if (way.blocked()) return {State::kStopped, way.blocker, way.face, std::nullopt};
    const Landed landed = fall(way.sector, there);
    if (landed.plane) remember(*landed.plane, landed.face);
    return {landed.over == Over::kFloor ? State::kFloor : State::kNoFloor, landed.surface, landed.face,
            landed.plane};
}

void Way::remember(const Plane& plane, Index face) {
    if (face >= 0 || solids_.carriers.empty()) return;
    for (const Plane& known : planes_)
        if (known.corner.x == plane.corner.x && known.corner.y == plane.corner.y &&
            known.corner.z == plane.corner.z && known.normal.x == plane.normal.x &&
            known.normal.y == plane.normal.y && known.normal.z == plane.normal.z)
            return;
    planes_.push_back(plane);
}

}  // namespace jk::exact
