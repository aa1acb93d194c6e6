// What queries need of a level, taken out of its columns once: the one place that reads geometry.
//
// Costs a fraction of a millisecond, and about as much memory as the geometry has in the file.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "level.hpp"
#include "predicates.hpp"

namespace jklb {

using Index = std::int32_t;

// What a surface leads into where it is no sector. Sight: all but an adjoin with flag 0x1 blocks. Bodies: an adjoin with
// flag 0x2 lets them through, other surfaces with an adjoin or with flag 0x4 stop them, and carry them with flag 0x1;
// the rest they do not meet (sithCollision in the decompiled engine).
enum : Index { kBlocks = -1, kCarries = -1, kStops = -2, kAbsent = -3 };

enum : std::uint32_t {
    kAdjoinVisible = 0x1,
    kAdjoinMovement = 0x2,
    kSurfaceFloor = 0x1,
    kSurfaceCollision = 0x4,
    kSectorUnderwater = 0x2,
};

// A level as segments and falling bodies meet it. Surfaces are the fans of their corners as written. A sector that the
// engine would not load, with a surface of more than 24 corners or a vertex that is not finite, is not known: nothing
// leads into it by sight, and a query that starts or falls into it gets no answer.
class Mesh {
public:
    explicit Mesh(const Level& level) : Mesh(level.geometry()) {}
    explicit Mesh(const Geometry& g) {
        take_vertices(g), take_surfaces(g), take_sectors(g), take_ways(g);
    }

    Index sectors() const { return static_cast<Index>(known_.size()); }
    Index surfaces() const { return static_cast<Index>(leads_to_.size()); }

    bool known(Index sector) const { return known_[index(sector)] != 0; }
    bool under_water(Index sector) const { return under_water_[index(sector)] != 0; }

    // The surfaces of a sector: [first, end). None for a sector that is not known.
    Index first_surface(Index sector) const { return first_[index(sector)]; }
    Index end_surface(Index sector) const { return end_[index(sector)]; }

    // The sector behind a surface for sight, or kBlocks; for bodies, or kCarries, kStops, kAbsent.
    Index leads_to(Index surface) const { return leads_to_[index(surface)]; }
    Index passes_to(Index surface) const { return passes_to_[index(surface)]; }

    // Triangle i of the fan of a surface, 0 <= i < triangles(surface). Of a surface of a known sector.
    Index triangles(Index surface) const {
        const Index corners = start_[index(surface) + 1] - start_[index(surface)];
        return corners > 2 ? corners - 2 : 0;
    }
    Triangle triangle(Index surface, Index i) const {
        return {corner(surface, 0), corner(surface, i + 1), corner(surface, i + 2)};
    }

    Index corners(Index surface) const { return start_[index(surface) + 1] - start_[index(surface)]; }
    // Whether it can be computed with.
    bool sound(Index surface) const { return unsound_[index(surface)] == unsound_[index(surface) + 1]; }

    Index corner_vertex(Index surface, Index i) const { return vertex_[index(start_[index(surface)] + i)]; }
    Point corner(Index surface, Index i) const { return vertex(corner_vertex(surface, i)); }

    Index vertices() const { return static_cast<Index>(position_.size() / 3); }
    Point vertex(Index i) const { return &position_[3 * index(i)]; }

    // The least and the greatest corner of a surface's box: exact, since vertices are float32.
    struct Box {
        float low[3], high[3];
    };
    const Box& box(Index surface) const { return box_[index(surface)]; }

    // Whether a point can be asked about, from a sector.
    bool takes(Index sector) const { return sector >= 0 && sector < sectors(); }
    static bool takes(Point p) { return takes(p[0]) && takes(p[1]) && takes(p[2]); }

private:
    static constexpr Index kMostCorners = 24;       // sithSurface_Load in the decompiled engine
    static constexpr double kGreatest = 0x1p150;    // where the bounds of the predicates end

    static bool takes(double x) { return std::abs(x) < kGreatest; }
    static std::size_t index(Index i) { return static_cast<std::size_t>(i); }

    void take_vertices(const Geometry& g) {
        position_.resize(3 * g.vertices.rows());
        g.vertices.copy(position_.data());
        // What is not finite stays so times 0, and shows in the sum.
        double sum = 0;
        for (const double x : position_) sum += x * 0;
        all_finite_ = sum == 0;
    }

    void take_surfaces(const Geometry& g) {
        start_.resize(g.surface_corner_start.rows());
        g.surface_corner_start.copy(start_.data());
        vertex_ = g.corner_vertex.all();
        box_.resize(g.surface_flags.rows());
        unsound_.resize(box_.size() + 1);
        for (Index s = 0; s < static_cast<Index>(box_.size()); ++s) {
            const bool good = corners(s) <= kMostCorners && finite(vertex_.data() + start_[index(s)], corners(s));
            unsound_[index(s) + 1] = unsound_[index(s)] + !good;
            if (good) box_[index(s)] = box_around(s);
        }
    }

    bool finite(const Index* vertices, Index count) const {
        if (all_finite_) return true;
        for (Index i = 0; i < count; ++i)
            if (!takes(vertex(vertices[i]))) return false;
        return true;
    }

    Box box_around(Index surface) const {
        constexpr double kFar = std::numeric_limits<double>::infinity();
        double low[3] = {kFar, kFar, kFar}, high[3] = {-kFar, -kFar, -kFar};
        for (Index i = 0; i < corners(surface); ++i) {
            const Point p = corner(surface, i);
            for (int k = 0; k < 3; ++k) {
                low[k] = p[k] < low[k] ? p[k] : low[k];
                high[k] = p[k] > high[k] ? p[k] : high[k];
            }
        }
        Box box;
        for (int k = 0; k < 3; ++k) {
            box.low[k] = static_cast<float>(low[k]);
            box.high[k] = static_cast<float>(high[k]);
        }
        return box;
    }

    void take_sectors(const Geometry& g) {
        const std::size_t count = g.sector_flags.rows();
        const std::vector<std::uint8_t> finite = finite_sectors(g);
        const std::vector<std::uint32_t> flags = g.sector_flags.all();
        const std::vector<Index> surfaces = g.sector_surface_count.all();
        first_ = g.sector_first_surface.all();
        known_.resize(count), under_water_.resize(count), end_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const Index first = first_[i], end = first + surfaces[i];
            known_[i] = finite[i] && unsound_[index(first)] == unsound_[index(end)];
            first_[i] = known_[i] ? first : 0;
            end_[i] = known_[i] ? end : 0;
            under_water_[i] = (flags[i] & kSectorUnderwater) != 0;
        }
    }

    // Whether all vertices that a sector lists are finite.
    std::vector<std::uint8_t> finite_sectors(const Geometry& g) const {
        std::vector<std::uint8_t> found(g.sector_flags.rows(), 1);
        if (all_finite_) return found;
        const std::vector<Index> own = g.sector_vertex.all();
        const std::vector<std::uint32_t> start = g.sector_vertex_start.all();
        for (std::size_t s = 0; s < found.size(); ++s)
            found[s] = finite(own.data() + start[s], static_cast<Index>(start[s + 1] - start[s]));
        return found;
    }

    void take_ways(const Geometry& g) {
        const std::vector<Index> behind = sectors_behind(g), adjoins = g.surface_adjoin.all();
        const std::vector<std::uint32_t> adjoin_flags = g.adjoin_flags.all(), flags = g.surface_flags.all();
        leads_to_.resize(flags.size()), passes_to_.resize(flags.size());
        for (std::size_t i = 0; i < leads_to_.size(); ++i) {
            const bool has_adjoin = adjoins[i] >= 0;
            const std::uint32_t through = has_adjoin ? adjoin_flags[index(adjoins[i])] : 0;
            const Index sector = has_adjoin ? behind[index(adjoins[i])] : -1;
            const bool solid = has_adjoin || (flags[i] & kSurfaceCollision);
            const Index stays = !solid ? kAbsent : (flags[i] & kSurfaceFloor) ? kCarries : kStops;
            leads_to_[i] = (through & kAdjoinVisible) && sector >= 0 && known(sector) ? sector : kBlocks;
            passes_to_[i] = (through & kAdjoinMovement) && sector >= 0 ? sector : stays;
        }
    }

    // Of each adjoin: the sector whose surface carries its mirror, or -1.
    static std::vector<Index> sectors_behind(const Geometry& g) {
        const std::vector<Index> mirror = g.adjoin_mirror.all(), surface = g.adjoin_surface.all();
        const std::vector<Index> sector = g.surface_sector.all();
        std::vector<Index> behind(mirror.size());
        for (std::size_t i = 0; i < behind.size(); ++i) {
            const Index carries = surface[index(mirror[i])];
            behind[i] = carries < 0 ? -1 : sector[index(carries)];
        }
        return behind;
    }

    std::vector<double> position_;  // x y z of each vertex
    std::vector<Index> vertex_;     // of each corner, surface by surface
    std::vector<Index> start_, leads_to_, passes_to_, first_, end_;
    std::vector<Index> unsound_;  // surfaces before each that cannot be computed with
    std::vector<Box> box_;
    std::vector<std::uint8_t> known_, under_water_;
    bool all_finite_ = false;
};

}  // namespace jklb
