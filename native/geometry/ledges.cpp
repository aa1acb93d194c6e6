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
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSlab = 4 * kBeyond;
constexpr double kSteep = 0.7;  // least z of a unit normal
constexpr double kBent = 1e-5;   // JKU that a surface may be bent and still count as one plane
constexpr double kMargin = 2 * kBeyond;  // JKU around the way in which triangles are looked for
constexpr int kMostRounds = 16;

struct Plane {
    Point normal, corner;

    double height(const Point& p) const {
        return corner[2] - (normal[0] * (p[0] - corner[0]) + normal[1] * (p[1] - corner[1])) / normal[2];
    }
};

// A place further out: whether the body gets there, and the floor below.
struct Further {
    enum State : std::uint8_t { kNotLooked, kStopped, kNoFloor, kFloor } state = kNotLooked;
    Index met = -1, face = -1;
    Plane plane{{0, 0, 1}, {0, 0, 0}};

    bool same(const Further& other) const {
        return state == other.state && met == other.met && face == other.face;
    }
};

struct Found {
    Over over;
    Index met, face, sector, rise;
    Plane plane;
    Further further[2];

    bool same(const Found& other) const {
        return over == other.over && met == other.met && face == other.face && sector == other.sector &&
               rise == other.rise && further[0].same(other.further[0]) && further[1].same(other.further[1]);
    }
};

struct Row {
    double start, end;
    Found found;
    double drop0, drop1;
};

// A corner as the edge sees it: along the edge, beyond it, above it.
struct Seen {
    double t, off, up;
};

class Edge {
public:
    Edge(const Strides& strides, const Edges& edges, std::size_t row, std::span<const std::uint8_t> active,
         const Gait& gait)
        : strides_(strides), gait_(gait),
          home_(edges.surface[row] < 0 ? -1 : strides.sector_of(edges.surface[row])) {
        const auto corners = ring(edges.surface[row], edges.face[row]);
        const auto first = static_cast<std::size_t>(edges.corner[row]);
        const double *a = corners[first], *b = corners[(first + 1) % corners.size()];
        for (std::size_t k = 0; k < 3; ++k) start_[k] = a[k], along_[k] = b[k] - a[k];
        length_ = std::hypot(along_[0], along_[1]);
        if (!has_length()) return;
        out_ = {along_[1] / length_, -along_[0] / length_, 0};
        find_plane(corners);
        const Box around = box_around();
        around_.emplace_back(strides, around, active);
        if (home_ < 0) find_homes(around);
    }

    bool has_length() const { return length_ > kShortest; }

    std::vector<Row> sampled(int samples) {
        std::vector<Row> rows;
        for (int i = 0; i < samples; ++i) {
            further_ = false;
            const double from = static_cast<double>(i) / samples, to = static_cast<double>(i + 1) / samples;
            Found found = at((i + 0.5) / samples);
            further_ = looks_further({from, to, found, drop(found, from), drop(found, to)});
            if (further_) found = at((i + 0.5) / samples);
            add(rows, from, to, found);
        }
        return rows;
    }

    std::vector<Row> analysed() {
        std::vector<Row> rows, all;
        further_ = false;
        analyse(0, 1, rows);
        for (const Row& row : rows) {
            further_ = looks_further(row);
            if (further_)
                analyse(row.start, row.end, all);
            else
                all.push_back(row);
        }
        return all;
    }

    // From the edge down to the place a radius or two beyond it.
    double further_drop(const Found& found, int which, double t) const {
        switch (found.further[which].state) {
            case Further::kNoFloor: return kInfinity;
            case Further::kFloor:
                return beside(t, 0, 0)[2] - found.further[which].plane.height(beside(t, off(which), 0));
            default: return kNone;
        }
    }

private:
    std::vector<const double*> ring(Index surface, Index face) const {
        std::vector<const double*> corners;
        if (surface >= 0) {
            const SectorMesh& mesh = strides_.mesh();
            const auto s = static_cast<std::size_t>(surface);
            for (Index c = mesh.surface_start[s]; c < mesh.surface_start[s + 1]; ++c)
                corners.push_back(mesh.vertex(mesh.surface_vertex[static_cast<std::size_t>(c)]));
        } else {
            const Solids& solids = strides_.solids();
            const auto f = static_cast<std::size_t>(face);
            for (Index c = solids.face_start[f]; c < solids.face_start[f + 1]; ++c)
                corners.push_back(solids.vertex(solids.face_vertex[static_cast<std::size_t>(c)]));
        }
        return corners;
    }

    bool is_short(double from, double to) const { return (to - from) * length_ < kShortest; }

    double off(int which) const { return (which + 1) * gait_.radius; }

    // The plane of the floor, by Newell.
    void find_plane(std::span<const double* const> corners) {
        const double* o = corners.front();
        for (std::size_t c = 0; c < corners.size(); ++c) {
            const double *p = corners[c], *q = corners[(c + 1) % corners.size()];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
                normal_[k] += (p[i] - o[i]) * (q[j] - o[j]) - (p[j] - o[j]) * (q[i] - o[i]);
            }
        }
    }

    // All that the way over the edge comes past, however high or deep.
    Box box_around() const {
        Box box = Box::nothing();
        for (const double t : {0.0, 1.0})
            for (const double side : {-kMargin, std::max(kMargin, 2 * gait_.radius + kMargin)})
                box.add(beside(t, side, 0).data());
        for (int k = 0; k < 2; ++k) box.low[k] -= kMargin, box.high[k] += kMargin;
        box.low[2] = -kInfinity, box.high[2] = kInfinity;
        return box;
    }

    // The sectors that may hold the edge of a face.
    void find_homes(Box around) {
        around.low[2] = std::min(start_[2], start_[2] + along_[2]) - kMargin;
        around.high[2] = std::max(start_[2], start_[2] + along_[2]) + kMargin;
        for (std::size_t s = 0; s < strides_.mesh().sectors(); ++s)
            if (strides_.box(static_cast<Index>(s)).touches(around)) homes_.push_back(static_cast<Index>(s));
    }

    // The sector that a way over the edge begins in: the first that holds it; -1 outside the level.
    Index home_of(const Point& p) const {
        if (home_ >= 0) return home_;
        Index on = -1;
        for (const Index sector : homes_) {
            const Place place = strides_.locator().place(sector, p.data());
            if (place == Place::kInside) return sector;
            if (place == Place::kOn && on < 0) on = sector;
        }
        return on;
    }

    const Surroundings& around() const { return around_.front(); }

    // Over a place beside the edge, `up` above the edge.
    Point beside(double t, double off, double up) const {
        return {start_[0] + t * along_[0] + off * out_[0], start_[1] + t * along_[1] + off * out_[1],
                start_[2] + t * along_[2] + up};
    }

    // Where the way up begins.
    Point inner(double t) const {
        const double rises = (normal_[0] * out_[0] + normal_[1] * out_[1]) / normal_[2];
        return beside(t, -kBeyond, (home_ < 0 ? kOnFace : 0) + kBeyond * rises);
    }

    Found at(double t) {
        const Point start = inner(t);
        const Index home = home_of(start);
        Found found{Over::kBlocked, -1, -1, home, 0, {{0, 0, 1}, start_}, {}};
        if (home < 0) return found;
        for (Index rise = 0; rise <= gait_.rises; ++rise) {
            const double up = gait_.hover + rise * gait_.rise;
            const Moved lifted = around().go(home, start, beside(t, -kBeyond, up), visited_);
            if (lifted.blocked()) {
                if (rise == 0) stop(found, lifted);
                break;
            }
            const Point beyond = beside(t, kBeyond, up);
            const Moved over = around().go(lifted.sector, beside(t, -kBeyond, up), beyond, visited_);
            if (over.blocked()) {
                if (rise == 0) stop(found, over);
                continue;
            }
            const Landed landed = around().fall(over.sector, beyond, visited_);
            found = {static_cast<Over>(landed.below), landed.met, landed.face, landed.sector, rise,
                     {landed.normal, landed.corner}, {}};
            if (found.face < 0 && found.met >= 0) remember(found.plane);
            if (further_ && rise == 0)
                for (int which = 0; which < 2; ++which) found.further[which] = look_further(over.sector, t, which);
            return found;
        }
        return found;
    }

    static void stop(Found& found, const Moved& moved) {
        found.met = moved.blocker, found.face = moved.face, found.sector = moved.sector;
    }

    Further look_further(Index sector, double t, int which) {
        const Point there = beside(t, off(which), gait_.hover);
        const Moved past = around().go(sector, beside(t, kBeyond, gait_.hover), there, visited_);
        if (past.blocked()) return {Further::kStopped, past.blocker, past.face, {}};
        const Landed landed = around().fall(past.sector, there, visited_);
        const Plane plane{landed.normal, landed.corner};
        if (landed.face < 0 && landed.met >= 0) remember(plane);
        return {landed.below == Below::kFloor ? Further::kFloor : Further::kNoFloor, landed.met, landed.face, plane};
    }

    // Whether what lies further out counts.
    bool looks_further(const Row& row) const {
        if (row.found.over == Over::kBlocked || row.found.rise > 0) return false;
        return row.found.over != Over::kFloor || std::max(row.drop0, row.drop1) > gait_.shallow;
    }

    // From the edge down to the plane met, at a place of the edge itself; on a steep one where it was met, since its
    // plane may rise by much on the way back to the edge.
    double drop(const Found& found, double t) const {
        if (found.over == Over::kBlocked || found.over == Over::kVoid) return kNone;
        if (found.met < 0 && found.face < 0) return 0;  // under water already
        const Point p = beside(t, found.plane.normal[2] < kSteep ? kBeyond : 0, 0);
        return p[2] - found.plane.height(p);
    }

    void add(std::vector<Row>& rows, double from, double to, const Found& found) {
        if (!rows.empty() && rows.back().end == from && alike(rows.back().found, found, from, to)) {
            rows.back().end = to;
            rows.back().drop1 = drop(rows.back().found, to);
            return;
        }
        rows.push_back({from, to, found, drop(found, from), drop(found, to)});
    }

    void analyse(double from, double to, std::vector<Row>& rows) {
        from_ = from, to_ = to;
        visited_ = homes_, gathered_.clear(), breaks_ = {from, to};
        breaks_of_solids();
        for (const double part : {0.5, 0.02, 0.98}) at(from + part * (to - from));
        for (int round = 0; round < kMostRounds && gather(); ++round) {
            std::sort(breaks_.begin(), breaks_.end());
            for (std::size_t i = 0; i + 1 < breaks_.size(); ++i)
                if (!is_short(breaks_[i], breaks_[i + 1])) at((breaks_[i] + breaks_[i + 1]) / 2);
        }
        std::sort(breaks_.begin(), breaks_.end());
        std::vector<double> cuts{from};
        for (const double t : breaks_)
            if (!is_short(cuts.back(), t)) cuts.push_back(t);
        if (cuts.size() > 1 && is_short(cuts.back(), to)) cuts.pop_back();
        cuts.push_back(to);
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) split(rows, cuts[i], cuts[i + 1]);
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
        for (const double t : {from, to}) {
            if (std::abs(drop(a, t) - drop(b, t)) > kBent) return false;
            for (int which = 0; which < 2; ++which)
                if (a.further[which].state == Further::kFloor &&
                    std::abs(further_drop(a, which, t) - further_drop(b, which, t)) > kBent)
                    return false;
        }
        return true;
    }

    double close_in(double same, double other, const Found& found, double from, double to) {
        while (std::abs(other - same) * length_ > kShortest / 16) {
            const double middle = (same + other) / 2;
            if (middle == same || middle == other) break;  // a vast edge: doubles have nothing between
            (alike(at(middle), found, from, to) ? same : other) = middle;
        }
        return (same + other) / 2;
    }

    // Adds the breaks of sectors and planes that came up since; tells whether there were any.
    bool gather() {
        std::sort(visited_.begin(), visited_.end());
        visited_.erase(std::unique(visited_.begin(), visited_.end()), visited_.end());
        bool more = false;
        for (const Index sector : visited_) {
            const auto place = std::lower_bound(gathered_.begin(), gathered_.end(), sector);
            if (place != gathered_.end() && *place == sector) continue;
            gathered_.insert(place, sector);
            for (const Index i : around().of_sector(sector)) {
                breaks_of(around().triangle(i));
                if (home_ < 0) pierced(around().triangle(i), inner(0));
            }
            more = true;
        }
        for (; compared_ < planes_.size(); ++compared_)
            for (const Index i : around().of_solids())
                if (around().carries(i)) more |= meets(around().triangle(i), planes_[compared_], {from_, to_});
        return more;
    }

    void remember(const Plane& plane) {
        if (around().of_solids().empty()) return;
        for (const Plane& known : planes_)
            if (known.corner == plane.corner && known.normal == plane.normal) return;
        planes_.push_back(plane);
    }

    void breaks_of_solids() {
        const auto faces = around().of_solids();
        compared_ = 0;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const Strides::Triangle& t = around().triangle(faces[i]);
            breaks_of(t);
            pierced(t, inner(0));
            for (Index rise = 0; rise <= gait_.rises; ++rise)
                for (const double side : {-kBeyond, kBeyond})
                    pierced(t, beside(0, side, gait_.hover + rise * gait_.rise));
            if (!around().carries(faces[i])) continue;
            for (std::size_t j = 0; j < i; ++j)
                if (around().carries(faces[j])) {
                    const Strides::Triangle& other = around().triangle(faces[j]);
                    meets(t, {other.normal, other.corner}, extent(other));
                }
        }
    }

    // Where a straight line along the edge passes a triangle's plane, in the triangle or as near to it as matters: who
    // goes past it elsewhere is stopped by others.
    void pierced(const Strides::Triangle& t, const Point& from) {
        double before = 0, change = 0;
        for (std::size_t k = 0; k < 3; ++k)
            before += t.normal[k] * (from[k] - t.corner[k]), change += t.normal[k] * along_[k];
        if (change == 0) return;
        const double at = -before / change;
        if (!(at > 0 && at < 1)) return;
        for (std::size_t side = 0; side < 3; ++side) {
            double inside = -t.side[side];
            for (std::size_t k = 0; k < 3; ++k) inside += t.inward[side][k] * (from[k] + at * along_[k]);
            if (inside < -kSlab) return;
        }
        add_break(at);
    }

    using Extent = std::array<double, 2>;

    // From where to where a triangle goes along the edge.
    Extent extent(const Strides::Triangle& t) const {
        const auto [low, high] = std::minmax({seen(t.corners[0]).t, seen(t.corners[1]).t, seen(t.corners[2]).t});
        return {low, high};
    }

    // Where a triangle and a plane, within an extent of its own, are at one height.
    bool meets(const Strides::Triangle& t, const Plane& plane, const Extent& of_plane) {
        bool any = false;
        const Plane own{t.normal, t.corner};
        const Extent here = extent(t);
        const auto [low, high] =
            std::minmax({seen(t.corners[0]).off, seen(t.corners[1]).off, seen(t.corners[2]).off});
        const double first_t = std::max(here[0], of_plane[0]), last_t = std::min(here[1], of_plane[1]);
        for (int which = -1; which < (further_ ? 2 : 0); ++which) {
            const double side = which < 0 ? kBeyond : off(which);
            if (side < low || side > high) continue;
            const Point first = beside(0, side, 0), last = beside(1, side, 0);
            const double before = own.height(first) - plane.height(first), after = own.height(last) - plane.height(last);
            if ((before < 0) == (after < 0)) continue;
            const double t_met = before / (before - after);
            if (t_met < first_t || t_met > last_t) continue;
            add_break(t_met);
            any = true;
        }
        return any;
    }

    void breaks_of(const Strides::Triangle& t) {
        const Seen corners[3] = {seen(t.corners[0]), seen(t.corners[1]), seen(t.corners[2])};
        for (std::size_t k = 0; k < 3; ++k) breaks_of_side(corners[k], corners[(k + 1) % 3]);
    }

    Seen seen(const Point& p) const {
        const double x = p[0] - start_[0], y = p[1] - start_[1];
        const double t = (x * along_[0] + y * along_[1]) / (length_ * length_);
        return {t, x * out_[0] + y * out_[1], p[2] - start_[2] - t * along_[2]};
    }

    void breaks_of_side(const Seen& a, const Seen& b) {
        if (std::max(a.t, b.t) < from_ || std::min(a.t, b.t) > to_) return;
        for (const double side : {-kBeyond, 0.0, kBeyond}) cross(a, b, a.off - side, b.off - side);
        if (further_)
            for (int which = 0; which < 2; ++which) cross(a, b, a.off - off(which), b.off - off(which));
        const double reach = further_ ? off(1) + kSlab : kSlab;
        if (std::min(a.off, b.off) > reach || std::max(a.off, b.off) < -kSlab) return;
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
        if (t > from_ && t < to_) breaks_.push_back(t);
    }

    const Strides& strides_;
    const Gait& gait_;
    const Index home_;
    Point start_{}, along_{}, out_{}, normal_{};
    double length_ = 0;
    std::vector<Surroundings> around_;  // one
    std::vector<Index> homes_, visited_, gathered_;
    std::vector<double> breaks_;
    double from_ = 0, to_ = 1;    // between which they are looked for
    std::vector<Plane> planes_;   // of the surfaces fallen onto
    std::size_t compared_ = 0;    // of these, how many were set against the faces of solids
    bool further_ = false;        // whether places further out are looked at
};

}  // namespace

void check_edges(const Strides& strides, const Edges& edges, std::span<const std::uint8_t> active) {
    const auto refuse = [](const char* what, std::size_t row, const char* why) {
        throw std::invalid_argument(what + (" of edge " + std::to_string(row)) + why);
    };
    if (edges.surface.size() != edges.corner.size() || edges.surface.size() != edges.face.size())
        throw std::invalid_argument("surface, face and corner must have one entry an edge");
    const SectorMesh& mesh = strides.mesh();
    const Solids& solids = strides.solids();
    if (solids.faces() && static_cast<std::size_t>(
            *std::max_element(solids.face_solid.begin(), solids.face_solid.end())) >= active.size())
        throw std::invalid_argument("active must have one entry a solid");
    for (std::size_t i = 0; i < edges.surface.size(); ++i) {
        Index corners;
        if (edges.surface[i] >= 0) {
            const auto s = static_cast<std::size_t>(edges.surface[i]);
            if (s >= mesh.surfaces() || !strides.carries(edges.surface[i])) refuse("surface", i, " is no floor");
            corners = mesh.surface_start[s + 1] - mesh.surface_start[s];
        } else {
            const auto f = static_cast<std::size_t>(edges.face[i]);
            if (edges.face[i] < 0 || f >= solids.faces() || !solids.face_carries[f])
                refuse("face", i, " is no floor");
            corners = solids.face_start[f + 1] - solids.face_start[f];
        }
        if (edges.corner[i] < 0 || edges.corner[i] >= corners) refuse("corner", i, " is out of bounds");
    }
}

Ledges find_ledges(const Strides& strides, const Edges& edges, std::span<const std::uint8_t> active, const Gait& gait,
                   int samples, unsigned threads) {
    check_edges(strides, edges, active);
    struct Answer {
        Row row;
        double further[2][2];  // a radius and two radii out, at start and end
    };
    std::vector<std::vector<Answer>> found(edges.surface.size());
    share_out_ranges(found.size(), 64, threads, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            Edge edge(strides, edges, i, active, gait);
            if (!edge.has_length()) continue;
            for (const Row& row : samples > 0 ? edge.sampled(samples) : edge.analysed()) {
                Answer answer{row, {}};
                for (int which = 0; which < 2; ++which)
                    answer.further[which][0] = edge.further_drop(row.found, which, row.start),
                    answer.further[which][1] = edge.further_drop(row.found, which, row.end);
                found[i].push_back(answer);
            }
        }
    });
    Ledges out;
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const auto& [row, further] : found[i]) {
            out.edge.push_back(static_cast<Index>(i));
            out.start.push_back(row.start), out.end.push_back(row.end);
            out.over.push_back(static_cast<std::uint8_t>(row.found.over));
            out.met.push_back(row.found.met), out.face.push_back(row.found.face);
            out.sector.push_back(row.found.sector);
            out.drop0.push_back(row.drop0), out.drop1.push_back(row.drop1);
            out.rise.push_back(row.found.rise);
            out.past0.push_back(further[0][0]), out.past1.push_back(further[0][1]);
            out.far0.push_back(further[1][0]), out.far1.push_back(further[1][1]);
        }
    return out;
}

}  // namespace jk
