#include "geometry/stride.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "geometry/checks.hpp"

namespace jk {
namespace {

constexpr double kSeam = 1e-6;   // JKU that a point may lie beside a triangle and still meet it: seams are not tight
constexpr double kTouch = 1e-9;  // JKU: a rounding, far below a seam
constexpr int kMostSectors = 512;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Point point(const double* p) { return {p[0], p[1], p[2]}; }

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool normalize(Point& p) {
    const double length = std::sqrt(dot(p, p));
    if (!(length > 0)) return false;
    for (double& x : p) x /= length;
    return true;
}

// How far a point of its plane lies inside a triangle, JKU; negative outside.
double depth_inside(const Strides::Triangle& t, const Point& p) {
    return std::min({dot(t.inward[0], p) - t.side[0], dot(t.inward[1], p) - t.side[1], dot(t.inward[2], p) - t.side[2]});
}

double height(const Strides::Triangle& t, const Point& p) {
    return t.corner[2] - (t.normal[0] * (p[0] - t.corner[0]) + t.normal[1] * (p[1] - t.corner[1])) / t.normal[2];
}

// The triangle that a falling point meets: the highest among those that hold it, or else, in the gap of a seam, among
// those that it lies beside.
class Highest {
public:
    void offer(const Strides::Triangle& t, const Point& from, double under) {
        if (!(t.normal[2] > 0)) return;
        const double z = height(t, from);
        if (!(z <= under)) return;
        const double inside = depth_inside(t, {from[0], from[1], z});
        if (inside < -kSeam) return;
        const bool holds = inside >= 0;
        if (met && (holds_ != holds ? holds_ : z <= at)) return;
        met = &t, at = z, holds_ = holds;
    }

    const Strides::Triangle* met = nullptr;
    double at = -kInfinity;

private:
    bool holds_ = false;
};

}  // namespace

Strides::Strides(SectorMesh mesh, std::span<const Index> passes_to, std::span<const std::uint8_t> under_water,
                 Solids solids)
    : mesh_(std::move(mesh)), fans_(mesh_), locator_(mesh_, fans_), solids_(std::move(solids)),
      sector_boxes_(jk::sector_boxes(mesh_)), passes_to_(passes_to.begin(), passes_to.end()),
      under_water_(under_water.begin(), under_water.end()) {
    if (passes_to.size() != mesh_.surfaces()) throw std::invalid_argument("passes_to must have one entry a surface");
    if (under_water.size() != mesh_.sectors()) throw std::invalid_argument("under_water must have one entry a sector");
    for (std::size_t i = 0; i < passes_to.size(); ++i)
        if (passes_to[i] < kNothingHere || passes_to[i] >= static_cast<Index>(mesh_.sectors()))
            throw std::invalid_argument("passes_to " + std::to_string(i) + " is out of bounds");
    check_solids();
    owner_.assign(mesh_.surfaces(), -1);
    first_.push_back(0);
    std::vector<const double*> corners;
    for (std::size_t s = 0; s < mesh_.sectors(); ++s) {
        for (Index i = 0; i < mesh_.sector_count[s]; ++i) {
            const Index surface = mesh_.sector_first[s] + i;
            const auto f = static_cast<std::size_t>(surface);
            owner_[f] = static_cast<Index>(s);
            corners.clear();
            for (Index c = mesh_.surface_start[f]; c < mesh_.surface_start[f + 1]; ++c)
                corners.push_back(mesh_.vertex(mesh_.surface_vertex[static_cast<std::size_t>(c)]));
            add_triangles(corners, surface);
        }
        first_.push_back(static_cast<Index>(triangles_.size()));
    }
    for (std::size_t f = 0; f < solids_.faces(); ++f) {
        corners.clear();
        for (Index c = solids_.face_start[f]; c < solids_.face_start[f + 1]; ++c)
            corners.push_back(solids_.vertex(solids_.face_vertex[static_cast<std::size_t>(c)]));
        add_triangles(corners, static_cast<Index>(f));
    }
    std::vector<Box> boxes(triangles_.size(), Box::nothing());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (const Point& corner : triangles_[i].corners) boxes[i].add(corner.data());
    tree_.emplace_back(boxes);
}

void Strides::check_solids() const {
    check_coordinates("position", solids_.positions);
    if (solids_.face_start.size() != solids_.faces() + 1 || solids_.face_carries.size() != solids_.faces())
        throw std::invalid_argument("the columns of the faces must have one entry a face");
    check_starts("face_start", solids_.face_start, solids_.face_vertex.size());
    check_indices("face_vertex", solids_.face_vertex, solids_.positions.size() / 3);
    for (std::size_t f = 0; f < solids_.faces(); ++f)
        if (solids_.face_solid[f] < 0) throw std::invalid_argument("face_solid " + std::to_string(f) + " is out of bounds");
}

void Strides::add_triangles(std::span<const double* const> corners, Index surface) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
        Triangle t;
        t.corners = {point(corners[0]), point(corners[i - 1]), point(corners[i])};
        t.corner = t.corners[0];
        t.normal = cross(minus(t.corners[1], t.corner), minus(t.corners[2], t.corner));
        t.surface = surface;
        bool sound = normalize(t.normal);
        for (std::size_t k = 0; k < 3; ++k) {
            t.inward[k] = cross(t.normal, minus(t.corners[(k + 1) % 3], t.corners[k]));
            sound = sound && normalize(t.inward[k]);
            t.side[k] = dot(t.inward[k], t.corners[k]);
        }
        if (sound) triangles_.push_back(t);
    }
}

bool Strides::carries(Index surface) const {
    if (passes_to(surface) != kFloorHere || sector_of(surface) < 0) return false;
    // Newell's sum is steadier than one triangle; only the sign of z counts.
    const auto first = static_cast<std::size_t>(mesh_.surface_start[static_cast<std::size_t>(surface)]);
    const auto end = static_cast<std::size_t>(mesh_.surface_start[static_cast<std::size_t>(surface) + 1]);
    double up = 0;
    for (std::size_t i = first + 2; i < end; ++i) {
        const double *a = mesh_.vertex(mesh_.surface_vertex[first]), *b = mesh_.vertex(mesh_.surface_vertex[i - 1]),
                     *c = mesh_.vertex(mesh_.surface_vertex[i]);
        up += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }
    return up > 0;
}

Surroundings::Surroundings(const Strides& strides, const Box& around, std::span<const std::uint8_t> active)
    : strides_(strides) {
    strides.tree_.front().find(
        [&](const Box& box) { return box.touches(around); },
        [&](Index i) {
            if (i < strides.first_.back()) return of_sectors_.push_back(i);
            const auto face = static_cast<std::size_t>(triangle(i).surface);
            if (active[static_cast<std::size_t>(strides.solids_.face_solid[face])]) of_solids_.push_back(i);
        });
    std::sort(of_sectors_.begin(), of_sectors_.end());
    std::sort(of_solids_.begin(), of_solids_.end());
}

std::span<const Index> Surroundings::of_sector(Index sector) const {
    const auto s = static_cast<std::size_t>(sector);
    const auto begin = std::lower_bound(of_sectors_.begin(), of_sectors_.end(), strides_.first_[s]);
    return {begin, std::lower_bound(begin, of_sectors_.end(), strides_.first_[s + 1])};
}

bool Surroundings::carries(Index solid_triangle) const {
    const Strides::Triangle& t = triangle(solid_triangle);
    return t.normal[2] > 0 && strides_.solids_.face_carries[static_cast<std::size_t>(t.surface)];
}

Moved Surroundings::go(Index sector, const Point& from, const Point& to, std::vector<Index>& visited) const {
    const Point way = minus(to, from);
    const double length = std::sqrt(dot(way, way));
    // A face stops a body from both sides.
    double stopped = 1;
    Index face = -1;
    for (const Index i : of_solids_) {
        const Strides::Triangle& t = triangle(i);
        const double before = dot(t.normal, minus(from, t.corner)), after = dot(t.normal, minus(to, t.corner));
        if (!(before > 0 && after < 0) && !(before < 0 && after > 0)) continue;
        const double part = before / (before - after);
        if (part >= stopped) continue;
        if (depth_inside(t, {from[0] + part * way[0], from[1] + part * way[1], from[2] + part * way[2]}) >= -kSeam)
            stopped = part, face = t.surface;
    }
    const Index start = sector;
    double entered = -kTouch;
    visited.push_back(sector);
    for (int crossed = 0; crossed < kMostSectors; ++crossed) {
        const Strides::Triangle* out = nullptr;
        double at = kInfinity;
        for (const Index i : of_sector(sector)) {
            const Strides::Triangle& t = triangle(i);
            const double sinks = -dot(t.normal, way);
            if (!(sinks > 0)) continue;
            const double above = dot(t.normal, minus(from, t.corner));
            if (above - sinks >= 0 || above < -kSeam) continue;
            const double part = above / sinks;
            if (part * length < entered * length - kSeam || part >= at) continue;
            const Point p = {from[0] + part * way[0], from[1] + part * way[1], from[2] + part * way[2]};
            if (depth_inside(t, p) >= -kSeam) out = &t, at = part;
        }
        if (face >= 0 && stopped < at) return {start, -1, face};
        if (!out) return {sector, -1, -1};
        const Index leads = strides_.passes_to(out->surface);
        if (leads < 0) return {sector, out->surface, -1};
        sector = leads;
        entered = at;
        visited.push_back(sector);
    }
    return {sector, -1, face};
}

Landed Surroundings::fall(Index sector, const Point& from, std::vector<Index>& visited) const {
    Highest solid;
    for (const Index i : of_solids_)
        if (carries(i)) solid.offer(triangle(i), from, from[2]);
    const auto landed = [&](Below below, Index met, Index where, const Strides::Triangle* t, double at) -> Landed {
        if (solid.met && solid.at > at)
            return {Below::kFloor, -1, solid.met->surface, where, solid.met->normal, solid.met->corner};
        if (!t) return {below, met, -1, where, {0, 0, 1}, from};
        return {below, met, -1, where, t->normal, t->corner};
    };
    const auto under_water = [&](Index s) { return strides_.under_water_[static_cast<std::size_t>(s)] != 0; };
    double height = from[2];
    visited.push_back(sector);
    if (under_water(sector)) return landed(Below::kWater, -1, sector, nullptr, height);
    for (int crossed = 0; crossed < kMostSectors; ++crossed) {
        Highest found;
        for (const Index i : of_sector(sector)) {
            const Strides::Triangle& t = triangle(i);
            if (strides_.passes_to(t.surface) != kNothingHere) found.offer(t, from, height + kSeam);
        }
        if (!found.met) return landed(Below::kVoid, -1, sector, nullptr, -kInfinity);
        const Index surface = found.met->surface, leads = strides_.passes_to(surface);
        if (leads < 0)
            return landed(leads == kFloorHere ? Below::kFloor : Below::kSolid, surface, sector, found.met, found.at);
        if (under_water(leads)) return landed(Below::kWater, surface, leads, found.met, found.at);
        sector = leads;
        height = found.at;
        visited.push_back(sector);
    }
    return landed(Below::kVoid, -1, sector, nullptr, -kInfinity);
}

}  // namespace jk
