// Whether a point is seen from another: sector by sector, as the engine looks, walls only, by the profile `research`.
//
// In a sector the segment leaves through the triangle that it crosses outward first: it starts on the inner side of its
// plane or in it, ends strictly behind it, and meets the closed triangle, no sooner than it entered the sector. A
// surface that leads nowhere blocks, also where it is crossed on its edge. The segment ends where it leaves no more, so
// that an end on a wall is seen. Where it leaves through what several adjoins share, each way is tried, the lowest
// surface first; one that sees is enough. Every comparison is exact: an answer never hangs on rounding.
#pragma once

#include <algorithm>
#include <vector>

#include "mesh.hpp"

namespace jklb {

struct Sight {
    bool visible;
    Index crossed;  // sectors on the way that decided, with the first and the last; 0 where nothing can be said
    Index blocker;  // the surface that blocks, or -1
};

namespace detail {

class Look {
public:
    Look(const Mesh& mesh, const Way& way) : mesh_(mesh), way_(way) {
        for (int k = 0; k < 3; ++k) {
            along_[k] = way.to[k] - way.from[k];
            low_[k] = std::min(way.from[k], way.to[k]);
            high_[k] = std::max(way.from[k], way.to[k]);
        }
    }

    Sight from(Index start) {
        Index sector = start;
        Crossing entry;
        for (Index crossed = 1;; ++crossed) {
            leave(sector, crossed > 1 ? &entry : nullptr);
            if (found_.empty()) return {true, crossed, -1};
            const Index blocker = first_that_blocks();
            if (blocker >= 0) return {false, crossed, blocker};
            // A way on its own that gets ahead never comes back; the rest is for the search.
            if (found_.size() > 1 || !ahead(found_[0], crossed > 1 ? &entry : nullptr)) return search(start);
            entry = found_[0];
            sector = mesh_.leads_to(entry.surface);
        }
    }

private:
    struct Crossing {
        Index surface = -1;
        Meeting at;
    };

    // Finds the first crossings out of a sector, one a surface, in their order.
    void leave(Index sector, const Crossing* entry) {
        found_.clear();
        for (Index s = mesh_.first_surface(sector); s < mesh_.end_surface(sector); ++s) {
            if (misses(s)) continue;
            const Index triangles = mesh_.triangles(s);
            for (Index i = 0; i < triangles; ++i) offer(s, mesh_.triangle(s, i), entry);
        }
    }

    // Whether the segment certainly passes a surface by: their boxes do not touch, or seen along an axis all corners lie
    // on one side of the line. Spares most of the exact questions.
    bool misses(Index surface) const {
        const Mesh::Box& box = mesh_.box(surface);
        for (int k = 0; k < 3; ++k)
            if (box.low[k] > high_[k] || box.high[k] < low_[k]) return true;
        return passes_by(surface, 0, 1) || passes_by(surface, 1, 2) || passes_by(surface, 2, 0);
    }

    // The bound is that of orient2d.
    bool passes_by(Index surface, int x, int y) const {
        const Index corners = mesh_.corners(surface);
        int left = 0, right = 0;
        for (Index i = 0; i < corners; ++i) {
            const Point v = mesh_.corner(surface, i);
            const double up = along_[x] * (v[y] - way_.from[y]), down = along_[y] * (v[x] - way_.from[x]);
            const double error = 6 * kUnit * (std::abs(up) + std::abs(down)) + kUnderflow;
            left += up - down > error;
            right += down - up > error;
            if (left <= i && right <= i) return false;
        }
        return corners > 0;
    }

    void offer(Index surface, const Triangle& t, const Crossing* entry) {
        const Signed to = side(t, way_.to);
        if (to.sign >= 0) return;  // also where the corners lie on one line
        // Seen along the way, the triangle turns clockwise around every point of it.
        if (orient3d(way_.from, way_.to, t.a, t.b).sign > 0 || orient3d(way_.from, way_.to, t.b, t.c).sign > 0 ||
            orient3d(way_.from, way_.to, t.c, t.a).sign > 0)
            return;
        const Signed above = orient3d(t.a, t.b, t.c, way_.from);
        if (above.sign < 0) return;
        const double fall = above.value - to.value;
        const Crossing crossing{surface, {t, above, {fall, above.error + to.error + 2 * kUnit * std::abs(fall), 1}}};
        if (entry && compare(crossing.at, entry->at, way_) < 0) return;
        const int order = found_.empty() ? 0 : compare(crossing.at, found_[0].at, way_);
        if (order > 0) return;
        if (order < 0) found_.clear();
        if (found_.empty() || found_.back().surface != surface) found_.push_back(crossing);
    }

    Index first_that_blocks() const {
        for (const Crossing& each : found_)
            if (mesh_.leads_to(each.surface) == kBlocks) return each.surface;
        return -1;
    }

    bool ahead(const Crossing& exit, const Crossing* entry) const {
        return entry ? compare(exit.at, entry->at, way_) > 0 : exit.at.above.sign > 0;
    }

    // A sector and where it is entered: no surface at the start.
    struct State {
        Index sector;
        Crossing entry;
    };

    struct Branch {
        std::vector<Crossing> exits;
        std::size_t next;
    };

    // Depth first over all ways; a sector entered where it was before is not tried again. Of the ways, the first that
    // sees decides, else the first that is blocked, else the first that goes in a circle, by which nothing blocks.
    Sight search(Index start) {
        visit({start, {}});
        while (!open_.empty() && !seen_) {
            Branch& last = open_.back();
            if (last.next == last.exits.size()) {
                open_.pop_back();
                continue;
            }
            const Crossing exit = last.exits[last.next++];
            visit({mesh_.leads_to(exit.surface), exit});
        }
        if (seen_) return {true, seen_, -1};
        if (blocked_) return {false, blocked_, blocker_};
        return {true, circle_, -1};
    }

    void visit(const State& state) {
        const auto depth = static_cast<Index>(open_.size()) + 1;
        if (tried(state)) {
            if (!circle_) circle_ = depth - 1;
            return;
        }
        tried_.push_back(state);
        leave(state.sector, state.entry.surface < 0 ? nullptr : &state.entry);
        if (found_.empty()) {
            seen_ = depth;
            return;
        }
        const Index blocker = first_that_blocks();
        if (blocker < 0) {
            open_.push_back({found_, 0});
        } else if (!blocked_) {
            blocked_ = depth;
            blocker_ = blocker;
        }
    }

    bool tried(const State& state) const {
        for (const State& other : tried_) {
            if (other.sector != state.sector) continue;
            const bool starts = state.entry.surface < 0, started = other.entry.surface < 0;
            const bool same = starts || started ? (starts || state.entry.at.above.sign == 0) &&
                                                      (started || other.entry.at.above.sign == 0)
                                                : compare(state.entry.at, other.entry.at, way_) == 0;
            if (same) return true;
        }
        return false;
    }

    const Mesh& mesh_;
    const Way way_;
    double along_[3], low_[3], high_[3];
    std::vector<Crossing> found_;
    std::vector<State> tried_;
    std::vector<Branch> open_;
    Index seen_ = 0, blocked_ = 0, blocker_ = -1, circle_ = 0;
};

}  // namespace detail

// Asks from a point in a sector to another. What cannot be asked about (Mesh::takes, Mesh::known) is not visible, with
// crossed 0.
inline Sight sight(const Mesh& mesh, Point origin, Index sector, Point target) {
    if (!mesh.takes(sector) || !Mesh::takes(origin) || !Mesh::takes(target) || !mesh.known(sector))
        return {false, 0, -1};
    return detail::Look(mesh, {origin, target}).from(sector);
}

}  // namespace jklb
