#include "geometry/fall.hpp"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

#include "geometry/plumb.hpp"

namespace jk {
namespace {

// A sector on a way down, and the depth at which it is entered: none at the start.
struct Way {
    Index sector;
    std::optional<Depth> entry;
};

struct End {
    Depth depth;
    Ending ending;
    Index met, sector;
};

class Fall {
public:
    Fall(const Ground& ground, const Fans& fans, const Upward& upward, const double* point, double limit)
        : ground_(ground), fans_(fans), upward_(upward), point_(point), limit_(limit) {}

    Landing run(Index start) {
        if (ground_.under_water[static_cast<std::size_t>(start)]) return {Ending::kWater, -1, start, 0};
        enter({start, std::nullopt});
        while (!pending_.empty()) {
            const Way way = pending_.back();
            pending_.pop_back();
            follow(way);
        }
        if (best_) return {best_->ending, best_->met, best_->sector, distance(best_->depth)};
        if (far_ >= 0) return {Ending::kFar, -1, far_, limit_};
        return {Ending::kNothing, -1, nowhere_ >= 0 ? nowhere_ : start, std::numeric_limits<double>::infinity()};
    }

private:
    void enter(const Way& way) {
        if (std::any_of(tried_.begin(), tried_.end(), [&](const Way& other) { return same(way, other); })) return;
        tried_.push_back(way);
        pending_.push_back(way);
    }

    // A start at depth 0 and an entry there are two ways, which lead to the same ends.
    bool same(const Way& a, const Way& b) const {
        if (a.sector != b.sector || a.entry.has_value() != b.entry.has_value()) return false;
        return !a.entry || compare(fans_, point_, *a.entry, *b.entry) == 0;
    }

    void follow(const Way& way) {
        Met met;
        meet(way, met);
        if (met.empty()) return note(nowhere_, way.sector);
        if (beyond(met.front())) return note(far_, way.sector);
        bool ends = false;
        for (const Depth& depth : met) {
            const Index surface = surface_of(depth), leads = ground_.passes_to[static_cast<std::size_t>(surface)];
            if (leads >= 0) continue;
            offer({depth, leads == kCarries ? Ending::kFloor : Ending::kSolid, surface, way.sector});
            ends = true;
        }
        if (ends) return;
        for (const Depth& depth : met) {
            const Index surface = surface_of(depth), leads = ground_.passes_to[static_cast<std::size_t>(surface)];
            if (ground_.under_water[static_cast<std::size_t>(leads)])
                offer({depth, Ending::kWater, surface, leads});
            else if (!best_ || compare(fans_, point_, depth, best_->depth) <= 0)
                enter({leads, depth});
        }
    }

    using Met = boost::container::small_vector<Depth, 4>;

    // The highest triangles of the sector below the point and its entry.
    void meet(const Way& way, Met& met) const {
        const auto s = static_cast<std::size_t>(way.sector);
        for (Index i = upward_.start[s]; i < upward_.start[s + 1]; ++i) {
            Depth depth;
            if (!lies_below(fans_, upward_.triangles[static_cast<std::size_t>(i)], point_, depth)) continue;
            if (way.entry && compare(fans_, point_, depth, *way.entry) < 0) continue;
            const int order = met.empty() ? 0 : compare(fans_, point_, depth, met.front());
            if (order > 0) continue;
            if (order < 0) met.clear();
            met.push_back(depth);
        }
    }

    bool beyond(const Depth& depth) const {
        if (depth.most < limit_) return false;
        return distance(depth) > limit_;
    }

    void offer(const End& end) {
        if (best_) {
            const int order = compare(fans_, point_, end.depth, best_->depth);
            if (order > 0) return;
            if (order == 0 && std::tie(best_->ending, best_->met) <= std::tie(end.ending, end.met)) return;
        }
        best_ = end;
    }

    static void note(Index& least, Index sector) { least = least < 0 ? sector : std::min(least, sector); }

    double distance(const Depth& depth) const { return nearest(fans_, point_, depth); }
    Index surface_of(const Depth& depth) const {
        return fans_.triangles[static_cast<std::size_t>(depth.triangle)].surface;
    }

    const Ground& ground_;
    const Fans& fans_;
    const Upward& upward_;
    const double* const point_;
    const double limit_;
    boost::container::small_vector<Way, 8> tried_, pending_;
    std::optional<End> best_;
    Index far_ = -1, nowhere_ = -1;
};

}  // namespace

Landing fall(const Ground& ground, const Fans& fans, const Upward& upward, Index sector, const double* point,
             double limit) {
    return Fall(ground, fans, upward, point, limit).run(sector);
}

}  // namespace jk
