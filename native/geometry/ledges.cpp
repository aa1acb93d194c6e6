#include "geometry/ledges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "geometry/ledge_way.hpp"
#include "geometry/threads.hpp"

namespace jk {
namespace {

using ledge::Found;
using ledge::Further;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSteep = 0.7;  // least z of a unit normal
constexpr double kBent = 1e-5;  // JKU that a surface may be bent and still count as one plane
constexpr int kMostRounds = 16;

struct Row {
    double start, end;
    Found found;
    double drop0, drop1;
};

class Edge {
public:
    Edge(const Strides& strides, const ledge::Rim& rim, std::span<const std::uint8_t> active, const Gait& gait)
        : rim_(rim), gait_(gait), around_(strides, rim.box(), active), breaks_(rim, gait, around_),
          way_(strides, rim, gait, around_, breaks_) {}

    Edge(const Edge&) = delete;  // its parts refer to each other
    Edge& operator=(const Edge&) = delete;

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
                return rim_.beside(t, 0, 0)[2] - found.further[which].plane.height(rim_.beside(t, rim_.off(which), 0));
            default: return kNone;
        }
    }

private:
    Found at(double t) { return way_.at(t, further_); }

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
        const Point p = rim_.beside(t, found.plane.normal[2] < kSteep ? kBeyond : 0, 0);
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
        way_.forget();
        breaks_.begin(from, to, further_);
        for (const double part : {0.5, 0.02, 0.98}) at(from + part * (to - from));
        for (int round = 0; round < kMostRounds && breaks_.gather(way_.visited()); ++round) {
            const std::vector<double>& breaks = breaks_.sorted();
            for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
                if (!rim_.is_short(breaks[i], breaks[i + 1])) at((breaks[i] + breaks[i + 1]) / 2);
        }
        std::vector<double> cuts{from};
        for (const double t : breaks_.sorted())
            if (!rim_.is_short(cuts.back(), t)) cuts.push_back(t);
        if (cuts.size() > 1 && rim_.is_short(cuts.back(), to)) cuts.pop_back();
        cuts.push_back(to);
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) split(rows, cuts[i], cuts[i + 1]);
    }

    // Between two breaks nothing should change; where it does (bent surfaces), the place is closed in on.
    void split(std::vector<Row>& rows, double from, double to) {
        const double width = to - from;
        const Found middle = at((from + to) / 2);
        if (width * rim_.length() < 64 * kShortest) return add(rows, from, to, middle);
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
        while (std::abs(other - same) * rim_.length() > kShortest / 16) {
            const double middle = (same + other) / 2;
            if (middle == same || middle == other) break;  // a vast edge: doubles have nothing between
            (alike(at(middle), found, from, to) ? same : other) = middle;
        }
        return (same + other) / 2;
    }

    const ledge::Rim& rim_;
    const Gait& gait_;
    const Surroundings around_;
    ledge::Breaks breaks_;
    ledge::Way way_;
    bool further_ = false;  // whether places further out are looked at
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
            const ledge::Rim rim(strides, edges, i, gait);
            if (!rim.has_length()) continue;
            Edge edge(strides, rim, active, gait);
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
