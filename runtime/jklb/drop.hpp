// What is straight below a point: as a falling body meets it, sector by sector.
//
// In a sector the fall meets the triangles that face up (their corners turn counter-clockwise seen from above), at or
// below the point, no higher than where it came in, with the vertical line through the closed triangle; the highest
// decide. One that carries or stops ends the way; else the way goes on through every surface met, and ends at the
// surface if that leads under water. Where ways part (at an edge or a corner, or among overlapping sectors), the ending
// nearest to the point counts, then the first kind, then the lowest surface. Every comparison is exact.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "mesh.hpp"

namespace jklb {

enum class Ending : std::uint8_t {
    kFloor,    // a surface that carries
    kSolid,    // one that stops a body and has no floor flag
    kWater,    // a sector under water
    kFar,      // nothing within the limit
    kNothing,  // the sector has nothing below
    kUnknown,  // a sector that is not known, or a point that cannot be asked about
};

struct Drop {
    Ending ending;
    Index met;        // the surface at which the fall ends: the floor, the solid one, or the adjoin's into the water; or -1
    Index sector;     // in which it ends; with kWater the one under water
    double distance;  // JKU, the double nearest to it: the limit with kFar, infinite with kNothing, NaN with kUnknown

    Index floor() const { return ending == Ending::kFloor ? met : -1; }
};

namespace detail {

class Fall {
public:
    Fall(const Mesh& mesh, Point point, double limit) : mesh_(mesh), way_{point}, limit_(limit) {}

    Drop from(Index start) {
        if (mesh_.under_water(start)) return {Ending::kWater, -1, start, 0};
        for (Passage at{start, {}, false};;) {
            meet(at);
            if (found_.size() != 1 || beyond(found_[0])) return search(start);
            const Landing& only = found_[0];
            const Index leads = mesh_.passes_to(only.surface);
            if (leads < 0)
                return {leads == kCarries ? Ending::kFloor : Ending::kSolid, only.surface, at.sector, deep(only.at)};
            if (mesh_.under_water(leads)) return {Ending::kWater, only.surface, leads, deep(only.at)};
            // A way on its own that gets ahead never comes back; the rest is for the search.
            if (at.entered && compare(only.at, at.entry, way_) <= 0) return search(start);
            at = {leads, only.at, true};
        }
    }

private:
    struct Landing {
        Index surface;
        Meeting at;
    };

    // A sector, and where the fall came into it.
    struct Passage {
        Index sector;
        Meeting entry;
        bool entered;
    };

    struct End {
        Meeting at;
        Ending ending;
        Index met, sector;
    };

    double deep(const Meeting& at) const { return depth(at, way_); }
    bool beyond(const Landing& landing) const {
        return limit_ < std::numeric_limits<double>::infinity() && deep(landing.at) > limit_;
    }

    // Finds the highest triangles below the point and the entry, in the order of their surfaces.
    void meet(const Passage& at) {
        found_.clear();
        for (Index s = mesh_.first_surface(at.sector); s < mesh_.end_surface(at.sector); ++s) {
            if (mesh_.passes_to(s) == kAbsent || beside(mesh_.box(s))) continue;
            const Index triangles = mesh_.triangles(s);
            for (Index i = 0; i < triangles; ++i) offer(s, mesh_.triangle(s, i), at);
        }
    }

    // Whether the line straight down misses a box.
    bool beside(const Mesh::Box& box) const {
        const Point p = way_.from;
        return p[0] < box.low[0] || p[0] > box.high[0] || p[1] < box.low[1] || p[1] > box.high[1] || p[2] < box.low[2];
    }

    void offer(Index surface, const Triangle& t, const Passage& at) {
        const Signed fall = orient2d(t.a, t.b, t.c);
        if (fall.sign <= 0) return;
        if (orient2d(t.a, t.b, way_.from).sign < 0 || orient2d(t.b, t.c, way_.from).sign < 0 ||
            orient2d(t.c, t.a, way_.from).sign < 0)
            return;
        const Signed above = orient3d(t.a, t.b, t.c, way_.from);
        if (above.sign < 0) return;
        const Landing landing{surface, {t, above, fall}};
        if (at.entered && compare(landing.at, at.entry, way_) < 0) return;
        const int order = found_.empty() ? 0 : compare(landing.at, found_[0].at, way_);
        if (order > 0) return;
        if (order < 0) found_.clear();
        if (found_.empty() || found_.back().surface != surface) found_.push_back(landing);
    }

    // All ways; a sector entered where it was before is not tried again.
    Drop search(Index start) {
        enter({start, {}, false});
        for (std::size_t next = 0; next < tried_.size(); ++next) follow(Passage(tried_[next]));
        if (has_best_) return {best_.ending, best_.met, best_.sector, deep(best_.at)};
        if (far_ >= 0) return {Ending::kFar, -1, far_, limit_};
        return {Ending::kNothing, -1, nowhere_ >= 0 ? nowhere_ : start, std::numeric_limits<double>::infinity()};
    }

    void enter(const Passage& passage) {
        for (const Passage& other : tried_)
            if (other.sector == passage.sector && other.entered == passage.entered &&
                (!passage.entered || compare(passage.entry, other.entry, way_) == 0))
                return;
        tried_.push_back(passage);
    }

    void follow(const Passage& at) {
        meet(at);
        if (found_.empty()) return note(nowhere_, at.sector);
        if (beyond(found_[0])) return note(far_, at.sector);
        bool ends = false;
        for (const Landing& each : found_) {
            const Index leads = mesh_.passes_to(each.surface);
            if (leads >= 0) continue;
            offer_end({each.at, leads == kCarries ? Ending::kFloor : Ending::kSolid, each.surface, at.sector});
            ends = true;
        }
        if (ends) return;
        for (const Landing& each : found_) {
            const Index leads = mesh_.passes_to(each.surface);
            if (mesh_.under_water(leads)) offer_end({each.at, Ending::kWater, each.surface, leads});
            else enter({leads, each.at, true});
        }
    }

    void offer_end(const End& end) {
        if (has_best_) {
            const int order = compare(end.at, best_.at, way_);
            if (order > 0) return;
            if (order == 0 && (best_.ending < end.ending || (best_.ending == end.ending && best_.met <= end.met))) return;
        }
        best_ = end;
        has_best_ = true;
    }

    static void note(Index& least, Index sector) { least = least < 0 ? sector : std::min(least, sector); }

    const Mesh& mesh_;
    const Way way_;
    const double limit_;
    std::vector<Landing> found_;
    std::vector<Passage> tried_;
    End best_{};
    bool has_best_ = false;
    Index far_ = -1, nowhere_ = -1;
};

}  // namespace detail

// Asks from a point in a sector, no deeper than a limit in JKU that is not negative.
inline Drop drop(const Mesh& mesh, Point point, Index sector,
                 double limit = std::numeric_limits<double>::infinity()) {
    const Drop unknown{Ending::kUnknown, -1, sector, std::numeric_limits<double>::quiet_NaN()};
    if (!mesh.takes(sector) || !Mesh::takes(point) || !(limit >= 0)) return unknown;
    const Drop found = detail::Fall(mesh, point, limit).from(sector);
    if (mesh.known(found.sector)) return found;
    return {Ending::kUnknown, -1, found.sector, unknown.distance};
}

}  // namespace jklb
