#include "geometry/exact_ledges.hpp"

#include <limits>

#include "geometry/exact_ledge_breaks.hpp"
#include "geometry/threads.hpp"

namespace jk {
namespace {

using exact::Further;
using exact::kSteep;
using exact::Met;
using exact::Number;
using exact::Rim;
using exact::State;
using exact::Vector;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBent = 1e-5;  // JKU that a surface may be bent and still count as one plane

struct Row {
    Number start, end;
    Met met;
};

class Edge {
public:
    Edge(const exact::World& world, const Rim& rim, std::span<const std::uint8_t> active, const Gait& gait)
        : mesh_(world.mesh), rim_(rim), gait_(gait), solids_(world.strides, rim, active),
          way_(world, rim, gait, solids_) {}

    Edge(const Edge&) = delete;  // its parts refer to each other
    Edge& operator=(const Edge&) = delete;

    std::vector<Row> rows() {
        further_ = false;
        std::vector<Row> all;
        for (const Row& row : analysed(Number(0), Number(1))) {
            further_ = looks_further(row);
            if (!further_) {
                all.push_back(row);
                continue;
            }
            for (Row& part : analysed(row.start, row.end)) all.push_back(std::move(part));
        }
        return all;
    }

    double drop(const Row& row, bool at_end) const {
        if (row.met.over == Over::kBlocked || row.met.over == Over::kVoid) return kNone;
        return CGAL::to_double(drop(row.met, at_end ? row.end : row.start));
    }

    double further_drop(const Row& row, int which, bool at_end) const {
        const Further& there = row.met.further[which];
        if (there.state == State::kNoFloor) return kInfinity;
        if (there.state != State::kFloor) return kNone;
        return CGAL::to_double(further_drop(there, which, at_end ? row.end : row.start));
    }

private:
    Met at(double t) { return way_.at(t, further_); }

    bool looks_further(const Row& row) const {
        if (row.met.over == Over::kBlocked || row.met.rise > 0) return false;
        if (row.met.over != Over::kFloor) return true;
        return drop(row.met, row.start) > Number(gait_.shallow) || drop(row.met, row.end) > Number(gait_.shallow);
    }

    std::vector<Row> analysed(const Number& from, const Number& to) {
        const double first = CGAL::to_double(from), last = CGAL::to_double(to);
        way_.forget();
        for (const double part : {0.5, 0.02, 0.98}) at(first + part * (last - first));
        exact::Breaks breaks(mesh_, rim_, gait_, solids_, from, to, further_);
        std::vector<Row> found;
        do {
            found = between(breaks.with(way_.visited(), way_.planes()), from, to);
        } while (!breaks.has(way_.visited(), way_.planes()));
        std::vector<Row> merged;
        for (Row& row : found) {
            if (!merged.empty() && alike(merged.back().met, row.met, row.start, row.end))
                merged.back().end = row.end;
            else
                merged.push_back(std::move(row));
        }
        return merged;
    }

    std::vector<Row> between(const std::vector<Number>& breaks, const Number& from, const Number& to) {
        const Number shortest = Number(kShortest) / Number(rim_.length());
        std::vector<Number> cuts{from};
        for (const Number& t : breaks)
            if (t - cuts.back() >= shortest) cuts.push_back(t);
        if (cuts.size() > 1 && to - cuts.back() < shortest) cuts.pop_back();
        cuts.push_back(to);
        std::vector<Row> rows;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
            rows.push_back({cuts[i], cuts[i + 1], at(CGAL::to_double((cuts[i] + cuts[i + 1]) / 2))});
        return rows;
    }

    bool alike(const Met& a, const Met& b, const Number& start, const Number& end) const {
        if (!a.same(b)) return false;
        for (const Number& t : {start, end}) {
            if (a.over != Over::kBlocked && CGAL::abs(drop(a, t) - drop(b, t)) > Number(kBent)) return false;
            for (int which = 0; which < 2; ++which)
                if (a.further[which].state == State::kFloor &&
                    CGAL::abs(further_drop(a.further[which], which, t) - further_drop(b.further[which], which, t)) >
                        Number(kBent))
                    return false;
        }
        return true;
    }

    Number drop(const Met& met, const Number& t) const {
        if (!met.plane) return Number(0);
        const Vector p = rim_.exact_beside(t, met.plane->is_steep() ? kBeyond : 0);
        return p.z - met.plane->height(p.x, p.y);
    }

    Number further_drop(const Further& there, int which, const Number& t) const {
        const Vector p = rim_.exact_beside(t, rim_.off(which));
        return p.z - there.plane->height(p.x, p.y);
    }

    const SectorMesh& mesh_;
    const Rim& rim_;
    const Gait& gait_;
    const exact::NearSolids solids_;
    exact::Way way_;
    bool further_ = false;
};

}  // namespace

Ledges find_exact_ledges(const Strides& strides, const Edges& edges, std::span<const std::uint8_t> active,
                         const Gait& gait, unsigned threads) {
    check_edges(strides, edges, active);
    const exact::World world(strides);
    struct Answer {
        double start, end, drop[2], further[2][2];
        Over over;
        Index surface, face, sector, rise;
    };
    std::vector<std::vector<Answer>> found(edges.surface.size());
    share_out_ranges(found.size(), 8, threads, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Rim rim(strides, edges, i, gait);
            if (!rim.has_length()) continue;
            Edge edge(world, rim, active, gait);
            for (const Row& row : edge.rows()) {
                Answer answer{CGAL::to_double(row.start), CGAL::to_double(row.end), {}, {}, row.met.over,
                              row.met.surface, row.met.face, row.met.sector, row.met.rise};
                for (int end = 0; end < 2; ++end) {
                    answer.drop[end] = edge.drop(row, end);
                    for (int which = 0; which < 2; ++which)
                        answer.further[which][end] = edge.further_drop(row, which, end);
                }
                found[i].push_back(answer);
            }
        }
    });
    Ledges out;
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const Answer& a : found[i]) {
            out.edge.push_back(static_cast<Index>(i));
            out.start.push_back(a.start), out.end.push_back(a.end);
            out.over.push_back(static_cast<std::uint8_t>(a.over));
            out.met.push_back(a.surface), out.face.push_back(a.face), out.sector.push_back(a.sector);
            out.drop0.push_back(a.drop[0]), out.drop1.push_back(a.drop[1]);
            out.rise.push_back(a.rise);
            out.past0.push_back(a.further[0][0]), out.past1.push_back(a.further[0][1]);
            out.far0.push_back(a.further[1][0]), out.far1.push_back(a.further[1][1]);
        }
    return out;
}

}  // namespace jk
