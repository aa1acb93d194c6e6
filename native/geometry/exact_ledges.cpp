#include "geometry/exact_ledges.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "geometry/ground.hpp"
#include "geometry/sight.hpp"
#include "geometry/threads.hpp"

namespace jk {
namespace {

using Number = CGAL::Exact_predicates_exact_constructions_kernel::FT;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSlab = 4 * kBeyond;
constexpr double kAround = 2 * kSlab;  // JKU: what lies farther from the way is not looked at
constexpr double kSteep = 0.7;         // least z of a unit normal
constexpr double kBent = 1e-5;         // JKU that a surface may be bent and still count as one plane

struct Vector {
    Number x, y, z;
};

Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Number dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Boost's numbers refuse subnormal doubles.
Number number(double x) { return Number(std::abs(x) < 0x1p-1000 ? 0.0 : x); }

Vector vector(const double* p) { return {number(p[0]), number(p[1]), number(p[2])}; }

struct Plane {
    Vector corner, normal;  // of any length, z > 0

    Number height(const Number& x, const Number& y) const {
        return corner.z - (normal.x * (x - corner.x) + normal.y * (y - corner.y)) / normal.z;
    }

    bool is_steep() const { return normal.z * normal.z < Number(kSteep * kSteep) * dot(normal, normal); }
};

struct Triangle {
    const double *a, *b, *c;
    Index owner;  // surface or face

    bool outside(const Box& box) const {
        Box own = Box::nothing();
        for (const double* p : {a, b, c}) own.add(p);
        return !own.touches(box);
    }

    std::optional<Plane> upward() const {
        const Vector corner = vector(a), normal = cross(vector(b) - corner, vector(c) - corner);
        if (normal.z <= 0) return std::nullopt;
        return Plane{corner, normal};
    }

    // Whether a triangle that faces up holds a place, seen from above.
    bool holds(const Number& x, const Number& y) const {
        const double* corners[4] = {a, b, c, a};
        for (int k = 0; k < 3; ++k) {
            const Vector p = vector(corners[k]), q = vector(corners[k + 1]);
            if ((q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x) < 0) return false;
        }
        return true;
    }

    // How far along a segment it passes through the closed triangle, from either side.
    std::optional<Number> pierced(const Vector& from, const Vector& to) const {
        const Vector p = vector(a), q = vector(b), r = vector(c), normal = cross(q - p, r - p);
        const Number before = dot(normal, from - p), after = dot(normal, to - p);
        if (!(before > 0 && after < 0) && !(before < 0 && after > 0)) return std::nullopt;
        const Vector way = to - from;
        int left = 0, right = 0;
        for (const auto& [u, v] : {std::pair(p, q), std::pair(q, r), std::pair(r, p)}) {
            const auto side = CGAL::sign(dot(way, cross(u - from, v - from)));
            left += side > 0, right += side < 0;
        }
        if (left && right) return std::nullopt;
        return before / (before - after);
    }
};

enum class State : std::uint8_t { kNotLooked, kStopped, kNoFloor, kFloor };

struct Further {
    State state = State::kNotLooked;
    Index met = -1, face = -1;
    std::optional<Plane> plane;

    bool same(const Further& o) const { return state == o.state && met == o.met && face == o.face; }
};

struct Met {
    Over over;
    Index surface, face, sector, rise;
    std::optional<Plane> plane;
    Further further[2];

    bool same(const Met& o) const {
        return over == o.over && surface == o.surface && face == o.face && sector == o.sector && rise == o.rise &&
               further[0].same(o.further[0]) && further[1].same(o.further[1]);
    }
};

struct Row {
    Number start, end;
    Met met;
};

// A level as bodies pass through it, for the exact tiers of sight and drop.
struct World {
    explicit World(const Strides& strides)
        : strides(strides), passes_to(passes_of(strides)), viewer(mesh_of(strides, passes_to)) {}

    static std::vector<Index> passes_of(const Strides& strides) {
        std::vector<Index> passes(strides.mesh().surfaces());
        for (std::size_t i = 0; i < passes.size(); ++i) passes[i] = strides.passes_to(static_cast<Index>(i));
        return passes;
    }

    static SectorMesh mesh_of(const Strides& strides, std::span<const Index> passes) {
        SectorMesh mesh = strides.mesh();
        for (std::size_t i = 0; i < passes.size(); ++i) mesh.leads_to[i] = passes[i] >= 0 ? passes[i] : kBlocks;
        return mesh;
    }

    const Strides& strides;
    const std::vector<Index> passes_to;
    const Viewer viewer;
    const SectorMesh& mesh = viewer.mesh();
    const Faller faller{mesh, viewer.fans(), passes_to, strides.under_water()};
};

class Edge {
public:
    Edge(const World& world, const Edges& edges, std::size_t row, std::span<const std::uint8_t> active,
         const Gait& gait)
        : world_(world), gait_(gait),
          home_(edges.surface[row] < 0 ? -1 : world.strides.sector_of(edges.surface[row])) {
        const auto corners =
            edges.surface[row] >= 0 ? surface_corners(edges.surface[row]) : face_corners(edges.face[row]);
        const auto first = static_cast<std::size_t>(edges.corner[row]);
        here_ = {corners[first][0], corners[first][1], corners[first][2]};
        const double* there = corners[(first + 1) % corners.size()];
        for (std::size_t k = 0; k < 3; ++k) along_[k] = there[k] - here_[k];
        length_ = std::hypot(along_[0], along_[1]);
        if (!has_length()) return;
        out_ = {along_[1] / length_, -along_[0] / length_, 0};
        slope_ = slope(corners);
        exact_here_ = vector(here_.data()), exact_along_ = vector(along_.data()), exact_out_ = vector(out_.data());
        square_ = exact_along_.x * exact_along_.x + exact_along_.y * exact_along_.y;
        box_ = box_around();
        gather_solids(active);
    }

    bool has_length() const { return length_ > kShortest; }

    std::vector<Row> rows() {
        further_ = false;
        std::vector<Row> all;
        for (const Row& row : analysed(Number(0), Number(1))) {
            further_ = looks_further(row);
            if (!further_) {
                all.push_back(row);
                continue;
            }
            for (Row& part : analysed(row.start, row.end)) all.push_back(std::move(part));
        }
        return all;
    }

    double drop(const Row& row, bool at_end) const {
        if (row.met.over == Over::kBlocked || row.met.over == Over::kVoid) return kNone;
        return CGAL::to_double(drop(row.met, at_end ? row.end : row.start));
    }

    double further_drop(const Row& row, int which, bool at_end) const {
        const Further& there = row.met.further[which];
        if (there.state == State::kNoFloor) return kInfinity;
        if (there.state != State::kFloor) return kNone;
        return CGAL::to_double(further_drop(there, which, at_end ? row.end : row.start));
    }

private:
    std::vector<const double*> surface_corners(Index surface) const {
        std::vector<const double*> corners;
        const auto s = static_cast<std::size_t>(surface);
        for (Index c = world_.mesh.surface_start[s]; c < world_.mesh.surface_start[s + 1]; ++c)
            corners.push_back(world_.mesh.vertex(world_.mesh.surface_vertex[static_cast<std::size_t>(c)]));
        return corners;
    }

    std::vector<const double*> face_corners(Index face) const {
        std::vector<const double*> corners;
        const Solids& solids = world_.strides.solids();
        const auto f = static_cast<std::size_t>(face);
        for (Index c = solids.face_start[f]; c < solids.face_start[f + 1]; ++c)
            corners.push_back(solids.vertex(solids.face_vertex[static_cast<std::size_t>(c)]));
        return corners;
    }

    static void fan(const std::vector<const double*>& corners, Index owner, std::vector<Triangle>& triangles) {
        for (std::size_t i = 2; i < corners.size(); ++i)
            triangles.push_back({corners[0], corners[i - 1], corners[i], owner});
    }

    // How the floor rises inwards from the edge, JKU a JKU.
    double slope(const std::vector<const double*>& corners) const {
        double normal[3] = {};
        for (std::size_t c = 0; c < corners.size(); ++c) {
            double p[3], q[3];
            for (int k = 0; k < 3; ++k)
                p[k] = corners[c][k] - corners[0][k], q[k] = corners[(c + 1) % corners.size()][k] - corners[0][k];
            normal[0] += p[1] * q[2] - p[2] * q[1];
            normal[1] += p[2] * q[0] - p[0] * q[2];
            normal[2] += p[0] * q[1] - p[1] * q[0];
        }
        return (normal[0] * out_[0] + normal[1] * out_[1]) / normal[2];
    }

    // How far above the edge the way up begins.
    double start_up() const { return (home_ < 0 ? kOnFace : 0) + kBeyond * slope_; }

    double off(int which) const { return (which + 1) * gait_.radius; }

    Point beside(double t, double side, double up) const {
        return {here_[0] + t * along_[0] + side * out_[0], here_[1] + t * along_[1] + side * out_[1],
                here_[2] + t * along_[2] + up};
    }

    Box box_around() const {
        Box box = Box::nothing();
        for (const double t : {0.0, 1.0})
            for (const double side : {-kAround, std::max(0.0, 2 * gait_.radius) + kAround})
                box.add(beside(t, side, 0).data());
        for (int k = 0; k < 2; ++k) box.low[k] -= kAround, box.high[k] += kAround;
        box.low[2] = -kInfinity, box.high[2] = kInfinity;
        return box;
    }

    void gather_solids(std::span<const std::uint8_t> active) {
        const Solids& solids = world_.strides.solids();
        for (std::size_t f = 0; f < solids.faces(); ++f) {
            if (!active[static_cast<std::size_t>(solids.face_solid[f])]) continue;
            std::vector<Triangle> triangles;
            fan(face_corners(static_cast<Index>(f)), static_cast<Index>(f), triangles);
            for (const Triangle& t : triangles) {
                if (t.outside(box_)) continue;
                solids_.push_back(t);
                if (solids.face_carries[f])
                    if (const auto plane = t.upward()) carriers_.emplace_back(t, *plane);
            }
        }
    }

    Index home_of(const Point& p) {
        if (home_ >= 0) return home_;
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

    struct Way {
        Index sector, blocker, face;
        bool blocked() const { return blocker >= 0 || face >= 0; }
    };

    Way go(Index sector, const Point& from, const Point& to) {
        std::vector<Step> path;
        const Verdict verdict = world_.viewer.explain(from, sector, to, path);
        for (const Step& step : path) visited_.insert(step.sector);
        double stopped = verdict.visible ? 1 : path.back().leave;
        Way way{path.back().sector, verdict.blocker, -1};
        Box around = Box::nothing();
        around.add(from.data()), around.add(to.data());
        for (const Triangle& t : solids_) {
            if (t.outside(around)) continue;
            const auto part = t.pierced(vector(from.data()), vector(to.data()));
            if (part && CGAL::to_double(*part) < stopped)
                stopped = CGAL::to_double(*part), way = {sector, -1, t.owner};
        }
        return way;
    }

    struct Landed {
        Over over;
        Index surface, face, sector;
        std::optional<Plane> plane;
    };

    Landed fall(Index sector, const Point& from) {
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
        for (const auto& [t, plane] : carriers_) {
            if (t.outside(under) || !t.holds(x, y)) continue;
            const Number height = plane.height(x, y);
            if (height > z || (highest && height <= *highest)) continue;
            highest = height;
            landed = {Over::kFloor, -1, t.owner, landing.sector, plane};
        }
        return landed;
    }

    // The sectors on the way down.
    void go_down(Index sector, const Point& from, double depth) {
        std::vector<Step> path;
        const Point to = {from[0], from[1], from[2] - depth};
        world_.viewer.explain(from, sector, to, path);
        for (const Step& step : path) visited_.insert(step.sector);
    }

    static Over over_of(Ending ending) {
        switch (ending) {
            case Ending::kFloor: return Over::kFloor;
            case Ending::kSolid: return Over::kSolid;
            case Ending::kWater: return Over::kWater;
            default: return Over::kVoid;
        }
    }

    // The triangle of a surface's fan that lies at a depth below a point: the one that comes nearest.
    std::optional<Plane> plane_of(const Landing& landing, const Point& from) const {
        std::vector<Triangle> triangles;
        fan(surface_corners(landing.met), landing.met, triangles);
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

    Met at(double t) {
        const Point inner = beside(t, -kBeyond, start_up());
        const Index home = home_of(inner);
        Met met{Over::kBlocked, -1, -1, home, 0, std::nullopt, {}};
        if (home < 0) return met;
        for (Index rise = 0; rise <= gait_.rises; ++rise) {
            const double up = gait_.hover + rise * gait_.rise;
            const Point before = beside(t, -kBeyond, up), beyond = beside(t, kBeyond, up);
            const Way lifted = go(home, inner, before);
            if (lifted.blocked()) {
                if (rise == 0) stop(met, lifted);
                break;
            }
            const Way over = go(lifted.sector, before, beyond);
            if (over.blocked()) {
                if (rise == 0) stop(met, over);
                continue;
            }
            Landed landed = fall(over.sector, beyond);
            met = {landed.over, landed.surface, landed.face, landed.sector, rise, landed.plane, {}};
            if (landed.plane) remember(*landed.plane, landed.face);
            if (further_ && rise == 0)
                for (int which = 0; which < 2; ++which) met.further[which] = look_further(over.sector, t, which);
            break;
        }
        return met;
    }

    static void stop(Met& met, const Way& way) {
        met.surface = way.blocker, met.face = way.face, met.sector = way.sector;
    }

    Further look_further(Index sector, double t, int which) {
        const Point there = beside(t, off(which), gait_.hover);
        const Way way = go(sector, beside(t, kBeyond, gait_.hover), there);
        if (way.blocked()) return {State::kStopped, way.blocker, way.face, std::nullopt};
        const Landed landed = fall(way.sector, there);
        if (landed.plane) remember(*landed.plane, landed.face);
        return {landed.over == Over::kFloor ? State::kFloor : State::kNoFloor, landed.surface, landed.face,
                landed.plane};
    }

    bool looks_further(const Row& row) const {
        if (row.met.over == Over::kBlocked || row.met.rise > 0) return false;
        if (row.met.over != Over::kFloor) return true;
        return drop(row.met, row.start) > Number(gait_.shallow) || drop(row.met, row.end) > Number(gait_.shallow);
    }

    void remember(const Plane& plane, Index face) {
        if (face >= 0 || carriers_.empty()) return;
        for (const Plane& known : planes_)
            if (known.corner.x == plane.corner.x && known.corner.y == plane.corner.y &&
                known.corner.z == plane.corner.z && known.normal.x == plane.normal.x &&
                known.normal.y == plane.normal.y && known.normal.z == plane.normal.z)
                return;
        planes_.push_back(plane);
    }

    std::vector<Row> analysed(const Number& from, const Number& to) {
        from_ = from, to_ = to;
        const double first = CGAL::to_double(from), last = CGAL::to_double(to);
        visited_.clear();
        planes_.clear();
        for (std::size_t s = 0; home_ < 0 && s < world_.mesh.sectors(); ++s)
            if (near_edge(world_.strides.box(static_cast<Index>(s)))) visited_.insert(static_cast<Index>(s));
        for (const double part : {0.5, 0.02, 0.98}) at(first + part * (last - first));
        std::vector<Number> breaks{from, to};
        std::set<Index> gathered;
        std::size_t compared = 0;
        breaks_of_solids(breaks);
        std::vector<Row> found;
        do {
            for (const Index sector : visited_)
                if (gathered.insert(sector).second) breaks_of(sector, breaks);
            for (; compared < planes_.size(); ++compared)
                for (const auto& [t, plane] : carriers_) crossing_of(t, plane, planes_[compared], breaks);
            std::sort(breaks.begin(), breaks.end());
            breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
            found = between(breaks);
        } while (gathered.size() < visited_.size() || compared < planes_.size());
        std::vector<Row> merged;
        for (Row& row : found) {
            if (!merged.empty() && alike(merged.back().met, row.met, row.start, row.end))
                merged.back().end = row.end;
            else
                merged.push_back(std::move(row));
        }
        return merged;
    }

    bool near_edge(const Box& box) const {
        Box around = box_;
        around.low[2] = std::min(here_[2], here_[2] + along_[2]) - kAround;
        around.high[2] = std::max(here_[2], here_[2] + along_[2]) + kAround;
        return box.touches(around);
    }

    std::vector<Row> between(const std::vector<Number>& breaks) {
        const Number shortest = Number(kShortest) / Number(length_);
        std::vector<Number> cuts{from_};
        for (const Number& t : breaks)
            if (t - cuts.back() >= shortest) cuts.push_back(t);
        if (cuts.size() > 1 && to_ - cuts.back() < shortest) cuts.pop_back();
        cuts.push_back(to_);
        std::vector<Row> rows;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
            rows.push_back({cuts[i], cuts[i + 1], at(CGAL::to_double((cuts[i] + cuts[i + 1]) / 2))});
        return rows;
    }

    bool alike(const Met& a, const Met& b, const Number& start, const Number& end) const {
        if (!a.same(b)) return false;
        for (const Number& t : {start, end}) {
            if (a.over != Over::kBlocked && CGAL::abs(drop(a, t) - drop(b, t)) > Number(kBent)) return false;
            for (int which = 0; which < 2; ++which)
                if (a.further[which].state == State::kFloor &&
                    CGAL::abs(further_drop(a.further[which], which, t) - further_drop(b.further[which], which, t)) >
                        Number(kBent))
                    return false;
        }
        return true;
    }

    Vector exact_beside(const Number& t, double side) const {
        return {exact_here_.x + t * exact_along_.x + Number(side) * exact_out_.x,
                exact_here_.y + t * exact_along_.y + Number(side) * exact_out_.y,
                exact_here_.z + t * exact_along_.z};
    }

    Number drop(const Met& met, const Number& t) const {
        if (!met.plane) return Number(0);
        const Vector p = exact_beside(t, met.plane->is_steep() ? kBeyond : 0);
        return p.z - met.plane->height(p.x, p.y);
    }

    Number further_drop(const Further& there, int which, const Number& t) const {
        const Vector p = exact_beside(t, off(which));
        return p.z - there.plane->height(p.x, p.y);
    }

    // A corner along the edge, beyond it, above it.
    Vector seen(const double* p) const {
        const Vector away = vector(p) - exact_here_;
        const Number t = (away.x * exact_along_.x + away.y * exact_along_.y) / square_;
        return {t, away.x * exact_out_.x + away.y * exact_out_.y, away.z - t * exact_along_.z};
    }

    void breaks_of(Index sector, std::vector<Number>& breaks) const {
        const Index first = world_.mesh.sector_first[static_cast<std::size_t>(sector)];
        const Index count = world_.mesh.sector_count[static_cast<std::size_t>(sector)];
        for (Index surface = first; surface < first + count; ++surface) {
            std::vector<Triangle> triangles;
            fan(surface_corners(surface), surface, triangles);
            for (const Triangle& t : triangles)
                if (!t.outside(box_)) breaks_of(t, breaks);
        }
    }

    void breaks_of_solids(std::vector<Number>& breaks) const {
        for (const Triangle& t : solids_) breaks_of(t, breaks);
        for (std::size_t i = 0; i < carriers_.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (share_extent(carriers_[i].first, carriers_[j].first) &&
                    share_height(carriers_[i].first, carriers_[j].first))
                    crossing_of(carriers_[i].first, carriers_[i].second, carriers_[j].second, breaks);
    }

    std::pair<double, double> rough_extent(const Triangle& t) const {
        double low = kInfinity, high = -kInfinity;
        for (const double* p : {t.a, t.b, t.c}) {
            const double at =
                ((p[0] - here_[0]) * along_[0] + (p[1] - here_[1]) * along_[1]) / (length_ * length_);
            low = std::min(low, at), high = std::max(high, at);
        }
        return {low - 1e-6, high + 1e-6};
    }

    bool share_extent(const Triangle& a, const Triangle& b) const {
        const auto [low, high] = rough_extent(a);
        const auto [other_low, other_high] = rough_extent(b);
        return low <= other_high && other_low <= high;
    }

    static bool share_height(const Triangle& a, const Triangle& b) {
        const auto [low, high] = std::minmax({a.a[2], a.b[2], a.c[2]});
        const auto [other_low, other_high] = std::minmax({b.a[2], b.b[2], b.c[2]});
        return low <= other_high && other_low <= high;
    }

    // Whether a triangle reaches over the line along the edge on its `side`, or close to it.
    bool reaches(const Triangle& t, double side) const {
        double low = kInfinity, high = -kInfinity;
        for (const double* p : {t.a, t.b, t.c}) {
            const double at = (p[0] - here_[0]) * out_[0] + (p[1] - here_[1]) * out_[1];
            low = std::min(low, at), high = std::max(high, at);
        }
        return low - 1e-6 <= side && side <= high + 1e-6;
    }

    // Where a triangle is at the height of a plane.
    void crossing_of(const Triangle& t, const Plane& own, const Plane& plane, std::vector<Number>& breaks) const {
        const auto [low, high] = rough_extent(t);
        for (int which = -1; which < (further_ ? 2 : 0); ++which) {
            const double side = which < 0 ? kBeyond : off(which);
            if (!reaches(t, side)) continue;
            const Vector first = exact_beside(Number(0), side), last = exact_beside(Number(1), side);
            const Number before = own.height(first.x, first.y) - plane.height(first.x, first.y);
            const Number after = own.height(last.x, last.y) - plane.height(last.x, last.y);
            if (before == after) continue;
            const Number met = before / (before - after);
            if (met >= Number(low) && met <= Number(high)) add(met, breaks);
        }
    }

    void breaks_of(const Triangle& t, std::vector<Number>& breaks) const {
        if (clear_of_way(t)) return;
        const Vector corners[3] = {seen(t.a), seen(t.b), seen(t.c)};
        Number low = corners[0].x, high = corners[0].x;
        for (const Vector& c : corners) low = std::min(low, c.x), high = std::max(high, c.x);
        if (high < from_ || low > to_) return;
        for (int k = 0; k < 3; ++k) breaks_of_side(corners[k], corners[(k + 1) % 3], breaks);
        // Where the lines along which the centre comes pass the triangle's plane.
        const Vector normal = cross(vector(t.b) - vector(t.a), vector(t.c) - vector(t.a));
        const Number change = dot(normal, exact_along_);
        if (change == 0) return;
        const auto pierced = [&](double side, double up) {
            Vector from = exact_beside(Number(0), side);
            from.z += Number(up);
            const Number met = dot(normal, vector(t.a) - from) / change;
            if (met >= low && met <= high) add(met, breaks);
        };
        pierced(-kBeyond, start_up());
        for (Index rise = 0; rise <= gait_.rises; ++rise)
            for (const double side : {-kBeyond, kBeyond}) pierced(side, gait_.hover + rise * gait_.rise);
    }

    // Whether a triangle lies on one side of all that the centre comes over, by far more than a rounding.
    bool clear_of_way(const Triangle& t) const {
        double low = kInfinity, high = -kInfinity;
        for (const double* p : {t.a, t.b, t.c}) {
            const double off = (p[0] - here_[0]) * out_[0] + (p[1] - here_[1]) * out_[1];
            low = std::min(low, off), high = std::max(high, off);
        }
        return low > (further_ ? off(1) : 0) + kAround || high < -kAround;
    }

    void breaks_of_side(const Vector& a, const Vector& b, std::vector<Number>& breaks) const {
        for (const double side : {-kBeyond, 0.0, kBeyond})
            cross_at(a, b, a.y - Number(side), b.y - Number(side), breaks);
        for (int which = 0; further_ && which < 2; ++which)
            cross_at(a, b, a.y - Number(off(which)), b.y - Number(off(which)), breaks);
        const Number reach(further_ ? off(1) + kSlab : kSlab);
        if ((a.y > reach && b.y > reach) || (a.y < -kSlab && b.y < -kSlab)) return;
        for (const Vector& p : {a, b})
            if (CGAL::abs(p.y) <= Number(kSlab)) add(p.x, breaks);
        for (Index rise = 0; rise <= gait_.rises; ++rise) {
            const Number up(gait_.hover + rise * gait_.rise);
            cross_at(a, b, a.z - up, b.z - up, breaks);
        }
    }

    void cross_at(const Vector& a, const Vector& b, const Number& before, const Number& after,
                  std::vector<Number>& breaks) const {
        if ((before < 0) != (after < 0)) add(a.x + (b.x - a.x) * (before / (before - after)), breaks);
    }

    void add(const Number& t, std::vector<Number>& breaks) const {
        if (t > from_ && t < to_) breaks.push_back(t);
    }

    const World& world_;
    const Gait& gait_;
    const Index home_;
    Point here_{}, along_{}, out_{};
    double length_ = 0, slope_ = 0;
    Vector exact_here_, exact_along_, exact_out_;
    Number square_, from_, to_;
    Box box_ = Box::nothing();
    std::vector<Triangle> solids_;
    std::vector<std::pair<Triangle, Plane>> carriers_;
    std::vector<Plane> planes_;  // of the surfaces fallen onto
    std::set<Index> visited_;
    bool further_ = false;
};

}  // namespace

Ledges find_exact_ledges(const Strides& strides, const Edges& edges, std::span<const std::uint8_t> active,
                         const Gait& gait, unsigned threads) {
    check_edges(strides, edges, active);
    const World world(strides);
    struct Answer {
        double start, end, drop[2], further[2][2];
        Over over;
        Index surface, face, sector, rise;
    };
    std::vector<std::vector<Answer>> found(edges.surface.size());
    share_out_ranges(found.size(), 8, threads, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            Edge edge(world, edges, i, active, gait);
            if (!edge.has_length()) continue;
            for (const Row& row : edge.rows()) {
                Answer answer{CGAL::to_double(row.start), CGAL::to_double(row.end), {}, {}, row.met.over,
                              row.met.surface, row.met.face, row.met.sector, row.met.rise};
                for (int end = 0; end < 2; ++end) {
                    answer.drop[end] = edge.drop(row, end);
                    for (int which = 0; which < 2; ++which)
                        answer.further[which][end] = edge.further_drop(row, which, end);
                }
                found[i].push_back(answer);
            }
        }
    });
    Ledges out;
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const Answer& a : found[i]) {
            out.edge.push_back(static_cast<Index>(i));
            out.start.push_back(a.start), out.end.push_back(a.end);
            out.over.push_back(static_cast<std::uint8_t>(a.over));
            out.met.push_back(a.surface), out.face.push_back(a.face), out.sector.push_back(a.sector);
            out.drop0.push_back(a.drop[0]), out.drop1.push_back(a.drop[1]);
            out.rise.push_back(a.rise);
            out.past0.push_back(a.further[0][0]), out.past1.push_back(a.further[0][1]);
            out.far0.push_back(a.further[1][0]), out.far1.push_back(a.further[1][1]);
        }
    return out;
}

}  // namespace jk
