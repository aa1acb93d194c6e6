#include "geometry/visibility_windings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace jk::vis {
namespace {

constexpr std::size_t kMostPoints = 32;
// Holds the length of a unit vector against its rounding.
constexpr double kUnitSlack = 1 + 0x1p-20;
// Beyond these a square loses digits.
constexpr double kLeastSquare = 0x1p-900;
// A tilt greater than this would cost more than the half-space brings.
constexpr double kMostTilt = 0x1p-10;

bool is_measurable(double squared) { return squared > kLeastSquare && squared < 1 / kLeastSquare; }

double distance(const Point& p, const Point& a, const Point& b) {
    const Point along = b - a, from = p - a;
    const double squared = dot(along, along);
    const double t = squared > 0 ? std::clamp(dot(from, along) / squared, 0.0, 1.0) : 0.0;
    const Point aside = from - t * along;
    return std::sqrt(dot(aside, aside));
}

class Cut {
public:
    Cut(const Winding& winding, const HalfSpace& half, const Precision& precision)
        : winding_(winding), error_(precision.error) {
        for (const Point& p : winding.points)
            over_.push_back(dot(half.n, p - half.at) + winding.radius * kUnitSlack - half.least);
    }

    bool stays(std::size_t i) const { return over_[i] + error_ >= 0; }

    // The last place between i, which stays, and j, which goes, that can lie in the half-space.
    Point between(std::size_t i, std::size_t j) const {
        const double in = std::max(0.0, over_[i] + error_), out = -(over_[j] + error_);
        const double t = std::min(1.0, in / (in + out) * (1 + 0x1p-50));
        const Point &a = winding_.points[i], &b = winding_.points[j];
        return a + t * (b - a);
    }

private:
    const Winding& winding_;
    double error_;
    boost::container::small_vector<double, 8> over_;
};

// Which half-space parts the windings: its least value over the pass, if that exceeds the greatest over the source.
bool parts(const Winding& source, const Winding& pass, const Precision& precision, HalfSpace& half) {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (const Point& p : pass.points) least = std::min(least, dot(half.n, p - half.at));
    half.least = least - (precision.error + pass.radius * kUnitSlack);
    for (const Point& s : source.points) greatest = std::max(greatest, dot(half.n, s - half.at));
    return greatest + precision.error + source.radius * kUnitSlack < half.least;
}

// The half-spaces through the edges of one winding that touch the other one. `side` is -1 when the edges are the
// source's, 1 when they are the pass's: where the other winding must lie is -side.
void through_edges(const Winding& source, const Winding& pass, double side, const Precision& precision,
                   HalfSpaces& out) {
    const Winding &edges = side < 0 ? source : pass, &other = side < 0 ? pass : source;
    const std::size_t count = edges.points.size();
    const double clear = 4 * (precision.error + source.radius + pass.radius);
    for (std::size_t i = 0; i < count; ++i) {
        const Point &v = edges.points[i], &w = edges.points[i + 1 == count ? 0 : i + 1];
        const Point along = w - v;
        Point touched = other.points[0] - v, n = cross(touched, along);
        for (std::size_t k = 1; k < other.points.size(); ++k) {
            const Point reach = other.points[k] - v;
            if (side * dot(n, reach) <= 0 && dot(n, n) > 0) continue;
            touched = reach;
            n = cross(touched, along);
        }
        // Turned about the edge by as much as parts the other winding from it: n stays a unit vector but for the square
        // of the turn.
        const double squared = dot(n, n), edge = dot(along, along);
        const double shrink = 1 / std::sqrt(squared), turned = clear * shrink;
        if (!is_measurable(squared) || !(turned * turned * edge < kMostTilt * kMostTilt)) continue;
        const Point aside = edge * touched - dot(touched, along) * along;
        n = shrink * n + (-side * turned * shrink) * aside;
        HalfSpace half{n, v, 0};
        if (parts(source, pass, precision, half)) out.push_back(half);
    }
}

}  // namespace

bool touches(const HalfSpace& half, const Box& box, const Precision& precision) {
    const double n[] = {half.n.x, half.n.y, half.n.z}, at[] = {half.at.x, half.at.y, half.at.z};
    double greatest = 0;
    for (int k = 0; k < 3; ++k) greatest += std::max(n[k] * (box.low[k] - at[k]), n[k] * (box.high[k] - at[k]));
    return greatest - half.least + precision.error >= 0;
}

bool holds(const HalfSpace& half, const Winding& winding, const Precision& precision) {
    double least = std::numeric_limits<double>::infinity();
    for (const Point& p : winding.points) least = std::min(least, dot(half.n, p - half.at));
    return least + winding.radius * kUnitSlack - half.least + precision.error >= 0;
}

bool clip(Winding& winding, const HalfSpace& half, const Precision& precision) {
    if (holds(half, winding, precision)) return true;
    const Cut cut(winding, half, precision);
    const std::size_t count = winding.points.size();
    const auto next = [&](std::size_t i) { return i + 1 == count ? 0 : i + 1; };
    std::size_t staying = 0, leaves = 0, last_in = 0;
    for (std::size_t i = 0; i < count; ++i) {
        staying += cut.stays(i);
        if (cut.stays(i) && !cut.stays(next(i))) ++leaves, last_in = i;
    }
    if (staying == count) return true;
    if (staying == 0) return false;
    if (leaves != 1 || staying + 2 > kMostPoints) return true;
    const std::size_t first_out = next(last_in);
    const std::size_t first_in = (first_out + (count - staying)) % count, last_out = (first_in + count - 1) % count;
    const Point leave = cut.between(last_in, first_out), enter = cut.between(first_in, last_out);
    double bend = 0;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; cut.stays(i) && j < count; ++j)
            if (!cut.stays(j) && !(i == last_in && j == first_out) && !(i == first_in && j == last_out))
                bend = std::max(bend, distance(cut.between(i, j), leave, enter));
    if (!(bend <= precision.farthest_bend)) return true;
    Winding left;
    for (std::size_t i = first_in, k = 0; k < staying; ++k, i = next(i)) left.points.push_back(winding.points[i]);
    left.points.push_back(leave);
    left.points.push_back(enter);
    left.radius = winding.radius + bend * kUnitSlack + precision.step;
    winding = std::move(left);
    return true;
}

void separators(const Winding& source, const Winding& pass, const Precision& precision, HalfSpaces& out) {
    through_edges(source, pass, -1, precision, out);
    through_edges(source, pass, 1, precision, out);
}

}  // namespace jk::vis
