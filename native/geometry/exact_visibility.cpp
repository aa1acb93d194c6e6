#include "geometry/exact_visibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "geometry/double_double.hpp"

namespace jk {
namespace {

// As kMostChains, and more of them: this tier may take its time.
constexpr std::size_t kMostExactChains = 4 * vis::kMostChains;

using Number = DoubleDouble;
using Vector = std::array<Number, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector plus(const Vector& a, const Number& k, const Vector& b) {
    return {a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]};
}
Number times(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Number length(const Vector& a) { return sqrt(times(a, a)); }
Vector across(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector vector(const vis::Point& p) { return {p.x, p.y, p.z}; }

struct Polygon {
    std::vector<Vector> points;
    Number spread = 0;  // every point stands for all within this distance

    bool empty() const { return points.empty(); }
};

// All x with normal . (x - at) >= least.
struct Half {
    Vector normal, at;
    Number least;

    Number over(const Vector& x) const { return times(normal, minus(x, at)); }
};

class ExactFlow {
public:
    ExactFlow(const vis::Known& known, std::size_t start)
        : known_(known), portals_(known.portals.portals), start_(start), words_(known.might.words()) {
        // The precision's error is 2^-49 of the size.
        tiny_ = std::ldexp(known.portals.precision.error, 49 - 90);
        farthest_bend_ = known.portals.precision.farthest_bend;
    }

    bool run(vis::Bits::Word* row, vis::Stop& stop) {
        std::vector<Link> chain{link(start_, written(start_), written(start_), known_.might_see(start_), {})};
        std::size_t tried = 0;
        while (!chain.empty()) {
            Link& last = chain.back();
            if (last.next == last.end) {
                chain.pop_back();
                continue;
            }
            const auto target = static_cast<std::size_t>(last.next++);
            const auto holds = [&](const Link& l) { return l.portal == target; };
            if (!bit(last.might, target) || std::any_of(chain.begin(), chain.end(), holds)) continue;
            ++tried;
            if (stop.asked()) return false;
            std::vector<vis::Bits::Word> might(words_);
            bool more = false;
            for (std::size_t w = 0; w < words_; ++w) {
                might[w] = last.might[w] & (known_.done[target] ? known_.seen : known_.might).row(target)[w];
                more |= (might[w] & ~row[w]) != 0;
            }
            if (!more && row[target / 64] >> target % 64 & 1) continue;
            Polygon source = last.source, pass = written(target);
            if (!pass_through(last, chain.size() == 1, target, source, pass)) continue;
            row[target / 64] |= vis::Bits::Word{1} << target % 64;
            if (!more) continue;
            if (tried >= kMostExactChains) {
                for (std::size_t w = 0; w < words_; ++w) row[w] |= might[w];
                continue;
            }
            std::vector<Half> reach = parting(source, pass);
            chain.push_back(link(target, std::move(source), std::move(pass), std::move(might), std::move(reach)));
        }
        return tried < kMostExactChains;
    }

private:
    struct Link {
        std::size_t portal;
        Index next, end;
        Polygon source, pass;
        std::vector<vis::Bits::Word> might;
        std::vector<Half> reach;
    };

    static bool bit(const std::vector<vis::Bits::Word>& words, std::size_t i) { return words[i / 64] >> i % 64 & 1; }

    Link link(std::size_t portal, Polygon source, Polygon pass, std::vector<vis::Bits::Word> might,
              std::vector<Half> reach) const {
        const auto sector = static_cast<std::size_t>(portals_[portal].to);
        return {portal, known_.portals.sector_start[sector], known_.portals.sector_start[sector + 1],
                std::move(source), std::move(pass), std::move(might), std::move(reach)};
    }

    Polygon written(std::size_t portal) const {
        Polygon polygon;
        for (const vis::Point& p : portals_[portal].winding.points) polygon.points.push_back(vector(p));
        return polygon;
    }

    // Cuts the target down to what the chain reaches, and the source down to what reaches the target.
    bool pass_through(const Link& last, bool first, std::size_t target, Polygon& source, Polygon& pass) const {
        cut(pass, side(portals_[start_], pass, -1));
        for (const Half& half : last.reach) cut(pass, half);
        cut(source, side(portals_[target], source, 1));
        if (pass.empty() || source.empty()) return false;
        if (first) return true;
        for (const Half& half : parting(pass, last.pass)) cut(source, half);
        return !source.empty();
    }

    // The side of a portal's plane, 1 for the inner one, as far as its triangles lean from it.
    Half side(const vis::Portal& portal, const Polygon& polygon, int sense) const {
        Half half{vector(portal.normal), vector(portal.corner), 0};
        for (Number& x : half.normal) x = sense * x;
        Number farthest = 0;
        for (const Vector& p : polygon.points) farthest = std::max(farthest, length(minus(p, half.at)));
        half.least = -(portal.bend + portal.lean * (farthest + polygon.spread)) - tiny_;
        return half;
    }

    void cut(Polygon& polygon, const Half& half) const {
        const std::size_t count = polygon.points.size();
        std::vector<Number> over(count);
        std::vector<std::size_t> in, out;
        for (std::size_t i = 0; i < count; ++i) {
            over[i] = half.over(polygon.points[i]) + polygon.spread - half.least + tiny_;
            (over[i] >= 0 ? in : out).push_back(i);
        }
        if (out.empty()) return;
        if (in.empty()) return polygon.points.clear();
        std::optional<std::size_t> last_in, first_in;
        int crossings = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t j = (i + 1) % count;
            if ((over[i] >= 0) == (over[j] >= 0)) continue;
            ++crossings;
            (over[i] >= 0 ? last_in : first_in) = over[i] >= 0 ? i : j;
        }
        if (crossings != 2) return;
        const auto meet = [&](std::size_t i, std::size_t j) {
            return plus(polygon.points[i], over[i] / (over[i] - over[j]), minus(polygon.points[j], polygon.points[i]));
        };
        const Vector leave = meet(*last_in, (*last_in + 1) % count), enter = meet(*first_in, (*first_in + count - 1) % count);
        Number bend = 0;
        for (const std::size_t i : in)
            for (const std::size_t j : out) bend = std::max(bend, distance(meet(i, j), leave, enter));
        if (bend > farthest_bend_) return;
        Polygon left;
        for (std::size_t i = *first_in;; i = (i + 1) % count) {
            left.points.push_back(polygon.points[i]);
            if (i == *last_in) break;
        }
        left.points.push_back(leave);
        left.points.push_back(enter);
        left.spread = polygon.spread + bend + tiny_;
        polygon = std::move(left);
    }

    static Number distance(const Vector& p, const Vector& a, const Vector& b) {
        const Vector along = minus(b, a), from = minus(p, a);
        const Number squared = times(along, along);
        Number t = squared > 0 ? Number(times(from, along) / squared) : Number(0);
        t = t < 0 ? Number(0) : t > 1 ? Number(1) : t;
        return length(plus(from, -t, along));
    }

    // Every half-space that holds what lies behind `pass` as seen from `source`: each plane through an edge of one and
    // a point of the other that has them on its two sides.
    std::vector<Half> parting(const Polygon& source, const Polygon& pass) const {
        std::vector<Half> found;
        const Number clear = 64 * tiny_ + 4 * (source.spread + pass.spread);
        for (const auto& [edges, others, sense] : {std::tuple{&source, &pass, 1}, std::tuple{&pass, &source, -1}})
            for (std::size_t i = 0; i < edges->points.size(); ++i)
                for (const Vector& point : others->points)
                    for (const int turn : {1, -1}) {
                        const Vector &v = edges->points[i], &w = edges->points[(i + 1) % edges->points.size()];
                        if (!plausible(*edges, *others, sense * turn, v, w, point)) continue;
                        auto half = touching(v, w, point, sense * clear, turn);
                        if (half && parts(source, pass, *half)) found.push_back(*half);
                    }
        return found;
    }

    // Whether the plane can part the two at all, in doubles: only what is far on the wrong side is refused.
    bool plausible(const Polygon& edges, const Polygon& others, int sense, const Vector& v, const Vector& w,
                   const Vector& point) const {
        const vis::Point at = rounded(v), n = vis::cross(rounded(point) - at, rounded(w) - at);
        const double slack = 0x1p-16 * static_cast<double>(farthest_bend_) * std::sqrt(vis::dot(n, n));
        const auto wrong = [&](int side) {
            return [&, side](const Vector& x) { return side * vis::dot(n, rounded(x) - at) < -slack; };
        };
        return std::none_of(edges.points.begin(), edges.points.end(), wrong(-sense)) &&
               std::none_of(others.points.begin(), others.points.end(), wrong(sense));
    }

    static vis::Point rounded(const Vector& v) {
        return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
    }

    // The plane through an edge and a point, turned about the edge so that the point is ahead of it by `clear`.
    std::optional<Half> touching(const Vector& v, const Vector& w, const Vector& point, const Number& clear, int turn) const {
        const Vector along = minus(w, v), reach = minus(point, v);
        Vector normal = across(reach, along);
        const Number size = length(normal), edge = length(along);
        if (size <= tiny_ * edge) return std::nullopt;
        const Vector aside = plus(reach, -times(reach, along) / (edge * edge), along);
        const Number lever = length(aside);
        for (Number& x : normal) x = turn * (x / size);
        return Half{plus(normal, clear / (lever * lever), aside), v, 0};
    }

    bool parts(const Polygon& source, const Polygon& pass, Half& half) const {
        std::optional<Number> least, greatest;
        for (const Vector& p : pass.points)
            if (const Number x = half.over(p) - pass.spread - tiny_; !least || x < *least) least = x;
        for (const Vector& s : source.points)
            if (const Number x = half.over(s) + source.spread + tiny_; !greatest || x > *greatest) greatest = x;
        half.least = *least;
        return *greatest < *least;
    }

    const vis::Known& known_;
    const std::vector<vis::Portal>& portals_;
    const std::size_t start_, words_;
    Number tiny_, farthest_bend_;
};

}  // namespace

bool exact_flow(const vis::Known& known, std::size_t p, vis::Bits::Word* row, vis::Stop& stop) {
    return ExactFlow(known, p).run(row, stop);
}

}  // namespace jk
