#include "geometry/ledges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "geometry/threads.hpp"

namespace jk {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kOnEdge = 1e-4;  // JKU over its floor at which a body's way up begins
constexpr double kSlab = 4 * kBeyond;
constexpr double kSteep = 0.7;  // least z of a unit normal
constexpr double kBent = 1e-5;   // JKU that a surface may be bent and still count as one plane
constexpr int kMostRounds = 16;

struct Found {
    Over over;
    Index met, sector, rise;
    Point normal, corner;

    bool same(const Found& other) const {
        return over == other.over && met == other.met && sector == other.sector && rise == other.rise;
    }
};

struct Row {
    double start, end;
    Found found;
    double drop0, drop1, past, far_off;
};

class Edge {
public:
    Edge(const Strides& strides, Index surface, Index corner, const Gait& gait)
        : strides_(strides), mesh_(strides.mesh()), surface_(surface), gait_(gait), home_(strides.sector_of(surface)) {
        const auto s = static_cast<std::size_t>(surface);
        const Index first = mesh_.surface_start[s], count = mesh_.surface_start[s + 1] - first;
        const double *a = mesh_.vertex(vertex_at(first + corner)),
                     *b = mesh_.vertex(vertex_at(first + (corner + 1) % count));
        for (std::size_t k = 0; k < 3; ++k) start_[k] = a[k], along_[k] = b[k] - a[k];
        length_ = std::hypot(along_[0], along_[1]);
        out_ = {along_[1] / length_, -along_[0] / length_, 0};
        find_plane();
    }

    bool has_length() const { return length_ > kShortest; }

    void sampled(int samples, std::vector<Row>& rows) {
        for (int i = 0; i < samples; ++i)
            add(rows, static_cast<double>(i) / samples, static_cast<double>(i + 1) / samples,
                at((i + 0.5) / samples));
    }

    void analysed(std::vector<Row>& rows) {
        for (const double t : {0.5, 0.02, 0.98}) at(t);
        for (int round = 0; round < kMostRounds && gather(); ++round) {
            std::sort(breaks_.begin(), breaks_.end());
            for (std::size_t i = 0; i + 1 < breaks_.size(); ++i)
                if (!is_short(breaks_[i], breaks_[i + 1])) at((breaks_[i] + breaks_[i + 1]) / 2);
        }
        std::vector<double> cuts{0};
        for (const double t : breaks_)
            if (!is_short(cuts.back(), t)) cuts.push_back(t);
        if (cuts.size() > 1 && is_short(cuts.back(), 1)) cuts.pop_back();
        cuts.push_back(1);
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) split(rows, cuts[i], cuts[i + 1]);
    }

    // Looks at the places a radius and two beyond the middle of each row.
    void look_past(std::vector<Row>& rows) {
        for (Row& row : rows) {
            row.past = row.far_off = kNone;
            if (row.found.over == Over::kBlocked || row.found.rise > 0) continue;
            const double t = (row.start + row.end) / 2;
            row.past = drop_at(t, gait_.radius);
            row.far_off = drop_at(t, 2 * gait_.radius);
        }
    }

private:
    Index vertex_at(Index corner) const { return mesh_.surface_vertex[static_cast<std::size_t>(corner)]; }

    bool is_short(double from, double to) const { return (to - from) * length_ < kShortest; }

    // The plane of the floor, by Newell.
    void find_plane() {
        const auto s = static_cast<std::size_t>(surface_);
        const Index first = mesh_.surface_start[s], end = mesh_.surface_start[s + 1];
        const double* o = mesh_.vertex(vertex_at(first));
        for (Index c = first; c < end; ++c) {
            const double *p = mesh_.vertex(vertex_at(c)), *q = mesh_.vertex(vertex_at(c + 1 < end ? c + 1 : first));
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
                normal_[k] += (p[i] - o[i]) * (q[j] - o[j]) - (p[j] - o[j]) * (q[i] - o[i]);
            }
        }
    }

    // Over a place beside the edge, `up` above the edge.
    Point beside(double t, double off, double up) const {
        return {start_[0] + t * along_[0] + off * out_[0], start_[1] + t * along_[1] + off * out_[1],
                start_[2] + t * along_[2] + up};
    }

    Found at(double t) {
        Point inner = beside(t, -kBeyond, kOnEdge);
        inner[2] += kBeyond * (normal_[0] * out_[0] + normal_[1] * out_[1]) / normal_[2];
        Index blocker = -1, where = home_;
        for (Index rise = 0; rise <= gait_.rises; ++rise) {
            const double up = gait_.hover + rise * gait_.rise;
            const Moved lifted = strides_.go(home_, inner, beside(t, -kBeyond, up), visited_);
            if (lifted.blocker >= 0) {
                if (rise == 0) blocker = lifted.blocker, where = lifted.sector;
                break;
            }
            const Point beyond = beside(t, kBeyond, up);
            const Moved over = strides_.go(lifted.sector, beside(t, -kBeyond, up), beyond, visited_);
            if (over.blocker >= 0) {
                if (rise == 0) blocker = over.blocker, where = over.sector;
                continue;
            }
            const Landed landed = strides_.fall(over.sector, beyond, visited_);
            return {static_cast<Over>(landed.below), landed.met, landed.sector, rise, landed.normal, landed.corner};
        }
        return {Over::kBlocked, blocker, where, 0, {0, 0, 1}, start_};
    }

    // From the edge down to the plane met, at a place of the edge itself; on a steep one where it was met, since its
    // plane may rise by much on the way back to the edge.
    double drop(const Found& found, double t) const {
        if (found.over == Over::kBlocked || found.over == Over::kVoid) return kNone;
        if (found.met < 0) return 0;  // under water already
        const Point& n = found.normal;
        const Point p = beside(t, n[2] < kSteep ? kBeyond : 0, 0);
        return p[2] - found.corner[2] + (n[0] * (p[0] - found.corner[0]) + n[1] * (p[1] - found.corner[1])) / n[2];
    }

    double drop_at(double t, double off) {
        std::vector<Index> passed;
        const Point before = beside(t, kBeyond, gait_.hover), there = beside(t, off, gait_.hover);
        const Moved lifted = strides_.go(home_, beside(t, -kBeyond, kOnEdge), beside(t, -kBeyond, gait_.hover), passed);
        if (lifted.blocker >= 0) return kNone;
        const Moved over = strides_.go(lifted.sector, beside(t, -kBeyond, gait_.hover), before, passed);
        if (over.blocker >= 0) return kNone;
        const Moved past = strides_.go(over.sector, before, there, passed);
        if (past.blocker >= 0) return kNone;
        const Landed landed = strides_.fall(past.sector, there, passed);
        if (landed.below != Below::kFloor) return std::numeric_limits<double>::infinity();
        const Point& n = landed.normal;
        return beside(t, 0, 0)[2] - landed.corner[2] +
               (n[0] * (there[0] - landed.corner[0]) + n[1] * (there[1] - landed.corner[1])) / n[2];
    }

    void add(std::vector<Row>& rows, double from, double to, const Found& found) {
        if (!rows.empty() && rows.back().end == from && alike(rows.back().found, found, from, to)) {
            rows.back().end = to;
            rows.back().drop1 = drop(rows.back().found, to);
            return;
        }
        rows.push_back({from, to, found, drop(found, from), drop(found, to), kNone, kNone});
    }

    // Between two breaks nothing should change; where it does (bent surfaces), the place is closed in on.
    void split(std::vector<Row>& rows, double from, double to) {
        const double width = to - from;
        const Found middle = at((from + to) / 2);
        if (width * length_ < 64 * kShortest) return add(rows, from, to, middle);
        const Found first = at(from + width / 64), last = at(to - width / 64);
        double low = from, high = to;
        if (!alike(first, middle, from, to)) {
            low = close_in(from + width / 64, (from + to) / 2, first, from, to);
            add(rows, from, low, first);
        }
        if (!alike(last, middle, from, to)) high = close_in(to - width / 64, (from + to) / 2, last, from, to);
        add(rows, low, high, middle);
        if (high < to) add(rows, high, to, last);
    }

    // Whether two places meet the same, in one plane between `from` and `to`.
    bool alike(const Found& a, const Found& b, double from, double to) const {
        if (!a.same(b)) return false;
        if (a.met < 0 || a.over == Over::kBlocked) return true;
        return std::abs(drop(a, from) - drop(b, from)) <= kBent && std::abs(drop(a, to) - drop(b, to)) <= kBent;
    }

    double close_in(double same, double other, const Found& found, double from, double to) {
        while (std::abs(other - same) * length_ > kShortest / 16) {
            const double middle = (same + other) / 2;
            if (middle == same || middle == other) break;  // a vast edge: doubles have nothing between
            (alike(at(middle), found, from, to) ? same : other) = middle;
        }
        return (same + other) / 2;
    }

    // Adds the breaks of sectors that came up since; tells whether there were any.
    bool gather() {
        std::sort(visited_.begin(), visited_.end());
        visited_.erase(std::unique(visited_.begin(), visited_.end()), visited_.end());
        bool more = false;
        for (const Index sector : visited_) {
            const auto place = std::lower_bound(gathered_.begin(), gathered_.end(), sector);
            if (place != gathered_.end() && *place == sector) continue;
            gathered_.insert(place, sector);
            breaks_of(sector);
            more = true;
        }
        return more;
    }

    void breaks_of(Index sector) {
        if (breaks_.empty()) breaks_ = {0, 1};
        const auto s = static_cast<std::size_t>(sector);
        for (Index surface = mesh_.sector_first[s]; surface < mesh_.sector_first[s] + mesh_.sector_count[s]; ++surface) {
            const auto f = static_cast<std::size_t>(surface);
            const Index first = mesh_.surface_start[f], end = mesh_.surface_start[f + 1];
            for (Index c = first; c < end; ++c) breaks_of_side(vertex_at(c), vertex_at(c + 1 < end ? c + 1 : first));
            for (Index c = first + 2; c + 1 < end; ++c) breaks_of_side(vertex_at(first), vertex_at(c));
        }
    }

    struct Seen {
        double t, off, up;  // along the edge, beyond it, above it
    };

    Seen seen(Index vertex) const {
        const double* p = mesh_.vertex(vertex);
        const double x = p[0] - start_[0], y = p[1] - start_[1];
        const double t = (x * along_[0] + y * along_[1]) / (length_ * length_);
        return {t, x * out_[0] + y * out_[1], p[2] - start_[2] - t * along_[2]};
    }

    void breaks_of_side(Index from, Index to) {
        const Seen a = seen(from), b = seen(to);
        if (std::max(a.t, b.t) < 0 || std::min(a.t, b.t) > 1) return;
        for (const double off : {-kBeyond, 0.0, kBeyond}) cross(a, b, a.off - off, b.off - off);
        if (std::min(a.off, b.off) > kSlab || std::max(a.off, b.off) < -kSlab) return;
        if (std::abs(a.off) <= kSlab) add_break(a.t);
        if (std::abs(b.off) <= kSlab) add_break(b.t);
        for (Index rise = 0; rise <= gait_.rises; ++rise) {
            const double up = gait_.hover + rise * gait_.rise;
            cross(a, b, a.up - up, b.up - up);
        }
    }

    void cross(const Seen& a, const Seen& b, double before, double after) {
        if ((before < 0) != (after < 0)) add_break(a.t + (b.t - a.t) * (before / (before - after)));
    }

    void add_break(double t) {
        if (t > 0 && t < 1) breaks_.push_back(t);
    }

    const Strides& strides_;
    const SectorMesh& mesh_;
    const Index surface_;
    const Gait& gait_;
    const Index home_;
    Point start_{}, along_{}, out_{}, normal_{};
    double length_ = 0;
    std::vector<Index> visited_, gathered_;
    std::vector<double> breaks_;
};

void check(const Strides& strides, std::span<const Index> surface, std::span<const Index> corner) {
    if (surface.size() != corner.size()) throw std::invalid_argument("surface and corner must have one entry an edge");
    const SectorMesh& mesh = strides.mesh();
    for (std::size_t i = 0; i < surface.size(); ++i) {
        const auto s = static_cast<std::size_t>(surface[i]);
        if (surface[i] < 0 || s >= mesh.surfaces() || !strides.carries(surface[i]))
            throw std::invalid_argument("surface of edge " + std::to_string(i) + " is no floor");
        if (corner[i] < 0 || corner[i] >= mesh.surface_start[s + 1] - mesh.surface_start[s])
            throw std::invalid_argument("corner of edge " + std::to_string(i) + " is out of bounds");
    }
}

std::vector<Row> rows_of(const Strides& strides, Index surface, Index corner, const Gait& gait, int samples) {
    Edge edge(strides, surface, corner, gait);
    std::vector<Row> rows;
    if (!edge.has_length()) return rows;
    if (samples > 0)
        edge.sampled(samples, rows);
    else
        edge.analysed(rows);
    edge.look_past(rows);
    return rows;
}

}  // namespace

Ledges find_ledges(const Strides& strides, std::span<const Index> surface, std::span<const Index> corner,
                   const Gait& gait, int samples, unsigned threads) {
    check(strides, surface, corner);
    std::vector<std::vector<Row>> found(surface.size());
    share_out_ranges(surface.size(), 64, threads, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) found[i] = rows_of(strides, surface[i], corner[i], gait, samples);
    });
    Ledges out;
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const Row& row : found[i]) {
            out.edge.push_back(static_cast<Index>(i));
            out.start.push_back(row.start), out.end.push_back(row.end);
            out.over.push_back(static_cast<std::uint8_t>(row.found.over));
            out.met.push_back(row.found.met), out.sector.push_back(row.found.sector);
            out.drop0.push_back(row.drop0), out.drop1.push_back(row.drop1);
            out.rise.push_back(row.found.rise);
            out.past.push_back(row.past), out.far_off.push_back(row.far_off);
        }
    return out;
}

}  // namespace jk
