#include "geometry/stride.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace jk {
namespace {

constexpr double kSeam = 1e-6;   // JKU that a point may lie beside a triangle and still meet it: seams are not tight
constexpr double kTouch = 1e-9;  // JKU: a rounding, far below a seam
constexpr int kMostSectors = 512;

Point minus(const double* a, const double* b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

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

}  // namespace

Strides::Strides(SectorMesh mesh, std::span<const Index> passes_to, std::span<const std::uint8_t> under_water)
    : mesh_(std::move(mesh)), passes_to_(passes_to.begin(), passes_to.end()),
      under_water_(under_water.begin(), under_water.end()) {
    if (passes_to.size() != mesh_.surfaces()) throw std::invalid_argument("passes_to must have one entry a surface");
    if (under_water.size() != mesh_.sectors()) throw std::invalid_argument("under_water must have one entry a sector");
    for (std::size_t i = 0; i < passes_to.size(); ++i)
        if (passes_to[i] < kNothingHere || passes_to[i] >= static_cast<Index>(mesh_.sectors()))
            throw std::invalid_argument("passes_to " + std::to_string(i) + " is out of bounds");
    owner_.assign(mesh_.surfaces(), -1);
    first_.push_back(0);
    for (std::size_t s = 0; s < mesh_.sectors(); ++s) {
        for (Index i = 0; i < mesh_.sector_count[s]; ++i) {
            const Index surface = mesh_.sector_first[s] + i;
            owner_[static_cast<std::size_t>(surface)] = static_cast<Index>(s);
            add_triangles(surface);
        }
        first_.push_back(static_cast<Index>(triangles_.size()));
    }
}

void Strides::add_triangles(Index surface) {
    const auto first = static_cast<std::size_t>(mesh_.surface_start[static_cast<std::size_t>(surface)]);
    const auto end = static_cast<std::size_t>(mesh_.surface_start[static_cast<std::size_t>(surface) + 1]);
    for (std::size_t i = first + 2; i < end; ++i) {
        const double* corners[3] = {mesh_.vertex(mesh_.surface_vertex[first]),
                                    mesh_.vertex(mesh_.surface_vertex[i - 1]),
                                    mesh_.vertex(mesh_.surface_vertex[i])};
        Triangle t;
        t.corner = {corners[0][0], corners[0][1], corners[0][2]};
        t.normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
        t.surface = surface;
        bool sound = normalize(t.normal);
        for (std::size_t k = 0; k < 3; ++k) {
            t.inward[k] = cross(t.normal, minus(corners[(k + 1) % 3], corners[k]));
            sound = sound && normalize(t.inward[k]);
            t.side[k] = dot(t.inward[k], {corners[k][0], corners[k][1], corners[k][2]});
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

Moved Strides::go(Index sector, const Point& from, const Point& to, std::vector<Index>& visited) const {
    const Point way = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const double length = std::sqrt(dot(way, way));
    double entered = -kTouch;
    visited.push_back(sector);
    for (int crossed = 0; crossed < kMostSectors; ++crossed) {
        const Triangle* out = nullptr;
        double at = std::numeric_limits<double>::infinity();
        for (auto i = static_cast<std::size_t>(first_[static_cast<std::size_t>(sector)]);
             i < static_cast<std::size_t>(first_[static_cast<std::size_t>(sector) + 1]); ++i) {
            const Triangle& t = triangles_[i];
            const double sinks = -dot(t.normal, way);
            if (!(sinks > 0)) continue;
            const double above = dot(t.normal, minus(from.data(), t.corner.data()));
            if (above - sinks >= 0 || above < -kSeam) continue;
            const double part = above / sinks;
            if (part * length < entered * length - kSeam || part >= at) continue;
            const Point p = {from[0] + part * way[0], from[1] + part * way[1], from[2] + part * way[2]};
            bool inside = true;
            for (std::size_t k = 0; inside && k < 3; ++k) inside = dot(t.inward[k], p) >= t.side[k] - kSeam;
            if (inside) out = &t, at = part;
        }
        if (!out) return {sector, -1};
        const Index leads = passes_to(out->surface);
        if (leads < 0) return {sector, out->surface};
        sector = leads;
        entered = at;
        visited.push_back(sector);
    }
    return {sector, -1};
}

Landed Strides::fall(Index sector, const Point& from, std::vector<Index>& visited) const {
    double height = from[2];
    visited.push_back(sector);
    if (under_water_[static_cast<std::size_t>(sector)]) return {Below::kWater, -1, sector, {0, 0, 1}, from};
    for (int crossed = 0; crossed < kMostSectors; ++crossed) {
        const Triangle* met = nullptr;
        double highest = -std::numeric_limits<double>::infinity();
        for (auto i = static_cast<std::size_t>(first_[static_cast<std::size_t>(sector)]);
             i < static_cast<std::size_t>(first_[static_cast<std::size_t>(sector) + 1]); ++i) {
            const Triangle& t = triangles_[i];
            if (!(t.normal[2] > 0) || passes_to(t.surface) == kNothingHere) continue;
            const double z = t.corner[2] - (t.normal[0] * (from[0] - t.corner[0]) + t.normal[1] * (from[1] - t.corner[1])) / t.normal[2];
            if (!(z <= height + kSeam) || z <= highest) continue;
            const Point p = {from[0], from[1], z};
            bool inside = true;
            for (std::size_t k = 0; inside && k < 3; ++k) inside = dot(t.inward[k], p) >= t.side[k] - kSeam;
            if (inside) met = &t, highest = z;
        }
        if (!met) return {Below::kVoid, -1, sector, {0, 0, 1}, from};
        const Index leads = passes_to(met->surface);
        if (leads == kFloorHere) return {Below::kFloor, met->surface, sector, met->normal, met->corner};
        if (leads < 0) return {Below::kSolid, met->surface, sector, met->normal, met->corner};
        if (under_water_[static_cast<std::size_t>(leads)])
            return {Below::kWater, met->surface, leads, met->normal, met->corner};
        sector = leads;
        height = highest;
        visited.push_back(sector);
    }
    return {Below::kVoid, -1, sector, {0, 0, 1}, from};
}

}  // namespace jk
