// What queries need of a level, taken out of its columns once: the one place that reads geometry.
//
// Costs a fraction of a millisecond and, for each corner of a surface, 24 bytes and a few more.
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
        const std::vector<float> vertices = g.vertices.all();
        take_surfaces(g, vertices), take_sectors(g, vertices), take_ways(g);
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

    // Triangle i of the fan of a surface, 0 <= i < triangles(surface), and whether its corners lie on one line: such a
    // triangle counts for nothing. Of a surface of a known sector.
    Index triangles(Index surface) const {
        const Index corners = start_[index(surface) + 1] - start_[index(surface)];
        return corners > 2 ? corners - 2 : 0;
    }
    Triangle triangle(Index surface, Index i) const {
        const Point fan = corner(surface, 0);
        return {fan, fan + 3 * (i + 1), fan + 3 * (i + 2)};
    }

    bool degenerate(Index surface, Index i) const { return degenerate_[index(surface)] >> i & 1; }

    Index corners(Index surface) const { return start_[index(surface) + 1] - start_[index(surface)]; }
    Point corner(Index surface, Index i) const { return &corner_[3 * index(start_[index(surface)] + i)]; }

    // The least and the greatest corner of a surface's box.
    struct Box {
        double low[3], high[3];
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

    void take_surfaces(const Geometry& g, const std::vector<float>& vertices) {
        const std::vector<Index> own = g.corner_vertex.all();
        const std::vector<std::uint32_t> start = g.surface_corner_start.all();
        start_.assign(start.begin(), start.end());
        corner_.resize(3 * own.size());
        for (std::size_t i = 0; i < own.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) corner_[3 * i + k] = vertices[3 * index(own[i]) + k];
        degenerate_.resize(g.surface_flags.rows());
        box_.resize(g.surface_flags.rows());
        for (Index s = 0; s < static_cast<Index>(box_.size()); ++s) box_[index(s)] = box_around(s);
    }

    Box box_around(Index surface) const {
        constexpr double kFar = std::numeric_limits<double>::infinity();
        Box box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
        for (Index i = 0; i < corners(surface); ++i)
            for (int k = 0; k < 3; ++k) {
                box.low[k] = std::min(box.low[k], corner(surface, i)[k]);
                box.high[k] = std::max(box.high[k], corner(surface, i)[k]);
            }
        return box;
    }

    void take_sectors(const Geometry& g, const std::vector<float>& vertices) {
        const std::size_t count = g.sector_flags.rows();
        const std::vector<std::uint8_t> finite = finite_sectors(g, vertices);
        known_.resize(count), under_water_.resize(count), first_.resize(count), end_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const Index first = g.sector_first_surface(i), end = first + g.sector_surface_count(i);
            known_[i] = finite[i] && sound(first, end);
            if (known_[i]) mark_degenerate(first, end);
            first_[i] = known_[i] ? first : 0;
            end_[i] = known_[i] ? end : 0;
            under_water_[i] = (g.sector_flags(i) & kSectorUnderwater) != 0;
        }
    }

    // Whether all vertices that a sector lists are finite.
    static std::vector<std::uint8_t> finite_sectors(const Geometry& g, const std::vector<float>& vertices) {
        const std::vector<Index> own = g.sector_vertex.all();
        const std::vector<std::uint32_t> start = g.sector_vertex_start.all();
        std::vector<std::uint8_t> finite(g.sector_flags.rows(), 1);
        for (std::size_t s = 0; s < finite.size(); ++s)
            for (std::size_t i = start[s]; i < start[s + 1]; ++i)
                for (std::size_t k = 0; k < 3; ++k)
                    if (!std::isfinite(vertices[3 * index(own[i]) + k])) finite[s] = 0;
        return finite;
    }

    bool sound(Index first, Index end) const {
        for (Index s = first; s < end; ++s)
            if (corners(s) > kMostCorners) return false;
        for (std::size_t i = 3 * index(start_[index(first)]); i < 3 * index(start_[index(end)]); ++i)
            if (!std::isfinite(corner_[i])) return false;
        return true;
    }

    void mark_degenerate(Index first, Index end) {
        for (Index s = first; s < end; ++s) {
            std::uint32_t marks = 0;
            for (Index i = 0; i < triangles(s); ++i) {
                const Triangle t = triangle(s, i);
                marks |= static_cast<std::uint32_t>(collinear(t.a, t.b, t.c)) << i;
            }
            degenerate_[index(s)] = marks;
        }
    }

    // An adjoin leads into the sector whose surface carries its mirror.
    void take_ways(const Geometry& g) {
        leads_to_.resize(start_.size() - 1), passes_to_.resize(start_.size() - 1);
        for (std::size_t i = 0; i < leads_to_.size(); ++i) {
            const Index adjoin = g.surface_adjoin(i);
            const std::uint32_t flags = adjoin < 0 ? 0 : g.adjoin_flags(index(adjoin));
            const Index behind = adjoin < 0 ? -1 : sector_behind(g, index(adjoin));
            const bool solid = adjoin >= 0 || (g.surface_flags(i) & kSurfaceCollision);
            const Index stays = !solid ? kAbsent : (g.surface_flags(i) & kSurfaceFloor) ? kCarries : kStops;
            leads_to_[i] = (flags & kAdjoinVisible) && behind >= 0 && known(behind) ? behind : kBlocks;
            passes_to_[i] = (flags & kAdjoinMovement) && behind >= 0 ? behind : stays;
        }
    }

    static Index sector_behind(const Geometry& g, std::size_t adjoin) {
        const Index surface = g.adjoin_surface(index(g.adjoin_mirror(adjoin)));
        return surface < 0 ? -1 : g.surface_sector(index(surface));
    }

    std::vector<double> corner_;  // x y z of each, surface by surface
    std::vector<Index> start_, leads_to_, passes_to_, first_, end_;
    std::vector<Box> box_;
    std::vector<std::uint32_t> degenerate_;  // bit i for triangle i
    std::vector<std::uint8_t> known_, under_water_;
};

}  // namespace jklb
