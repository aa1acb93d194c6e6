#include "geometry/plumb.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "geometry/double_double.hpp"
#include "geometry/expansion.hpp"
#include "geometry/whole.hpp"

namespace jk {
namespace {

using Triangle = Fans::Triangle;

constexpr double kUnit = 0x1p-53;
// Shewchuk's bound for the determinant of two differences, as a part of the sum of its absolute products.
constexpr double kTurnBound = (3 + 16 * kUnit) * kUnit;
constexpr double kUnderflow = 0x1p-900;
constexpr double kSlack = 0x1p-50;  // what the arithmetic of a bound itself may round off
constexpr double kInfinite = std::numeric_limits<double>::infinity();

bool fit(std::initializer_list<const double*> points, int coordinates) {
    for (const double* p : points)
        for (int k = 0; k < coordinates; ++k)
            if (!Expansion::fits(p[k])) return false;
    return true;
}

template <typename Exact>
Exact exact_turn(const double* a, const double* b, const double* p) {
    return Exact::difference(b[0], a[0]) * Exact::difference(p[1], a[1]) -
           Exact::difference(b[1], a[1]) * Exact::difference(p[0], a[0]);
}

// A triangle's depth as a fraction, both parts positive or the upper 0: the volume with the point over the normal's z.
template <typename Exact>
struct Fraction {
    Exact above, upright;

    Fraction(const Triangle& t, const double* p) {
        const Exact ux = Exact::difference(t.b[0], t.a[0]), uy = Exact::difference(t.b[1], t.a[1]),
                    uz = Exact::difference(t.b[2], t.a[2]), vx = Exact::difference(t.c[0], t.a[0]),
                    vy = Exact::difference(t.c[1], t.a[1]), vz = Exact::difference(t.c[2], t.a[2]);
        upright = ux * vy - uy * vx;
        above = (uy * vz - uz * vy) * Exact::difference(p[0], t.a[0]) +
                (uz * vx - ux * vz) * Exact::difference(p[1], t.a[1]) + upright * Exact::difference(p[2], t.a[2]);
    }
};

template <typename Exact>
int compare_fractions(const Triangle& s, const Triangle& t, const double* p) {
    const Fraction<Exact> first(s, p), second(t, p);
    return (first.above * second.upright - second.above * first.upright).sign();
}

bool flat(const Triangle& t) { return t.a[2] == t.b[2] && t.a[2] == t.c[2]; }

// Bounds of the depth of a triangle that lies at or below the point.
Depth bounded(Index index, const Triangle& t, const Volume& above) {
    const double left = (t.b[0] - t.a[0]) * (t.c[1] - t.a[1]), right = (t.b[1] - t.a[1]) * (t.c[0] - t.a[0]);
    const double upright = left - right, error = kTurnBound * (std::abs(left) + std::abs(right)) + kUnderflow;
    Depth depth{index, (above.value - above.error) / (upright + error) * (1 - kSlack), kInfinite};
    if (!(depth.least > kUnderflow)) depth.least = 0;
    if (upright > 2 * error)
        depth.most = std::max((above.value + above.error) / (upright - error) * (1 + kSlack), kUnderflow);
    return depth;
}

// The error of a sum of up to six products of three exact differences, as a part of the sum of the absolute products of
// their high parts: nine operations of DoubleDouble, and room for the bound's own rounding.
constexpr double kProducts = 0x1p-95;

// The double nearest to a / b, both positive and known to within their errors; not a number where these leave a doubt.
double quotient(const DoubleDouble& a, double a_error, const DoubleDouble& b, double b_error) {
    const double rough = a.high / b.high;
    const double product = rough * b.high, error = std::fma(rough, b.high, -product);
    // Off by 2^-49 of itself at most, and below 2^-51 of the whole.
    const double rest = ((a.high - product) - error + (a.low - rough * b.low)) / b.high;
    const DoubleDouble whole(rough, rest);
    const double doubt = 2 * ((a_error + whole.high * b_error) / b.high + 0x1p-98 * whole.high);
    const bool sure = b.high > 4 * b_error && whole.high > 0x1p-800 &&
                      whole.high + (whole.low + doubt) == whole.high && whole.high + (whole.low - doubt) == whole.high;
    return sure ? whole.high : std::nan("");
}

// The nearest double of a depth, or not a number where 106 bits leave a doubt.
double nearest_by_bounds(const Triangle& t, const double* p) {
    const auto difference = [](double a, double b) { return DoubleDouble(a) - DoubleDouble(b); };  // exact
    const DoubleDouble ux = difference(t.b[0], t.a[0]), uy = difference(t.b[1], t.a[1]), uz = difference(t.b[2], t.a[2]);
    const DoubleDouble vx = difference(t.c[0], t.a[0]), vy = difference(t.c[1], t.a[1]), vz = difference(t.c[2], t.a[2]);
    const DoubleDouble wx = difference(p[0], t.a[0]), wy = difference(p[1], t.a[1]), wz = difference(p[2], t.a[2]);
    const DoubleDouble upright = ux * vy - uy * vx;
    const DoubleDouble above = (uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + upright * wz;
    const double normal = std::abs(ux.high * vy.high) + std::abs(uy.high * vx.high);
    const double sum = (std::abs(uy.high * vz.high) + std::abs(uz.high * vy.high)) * std::abs(wx.high) +
                       (std::abs(uz.high * vx.high) + std::abs(ux.high * vz.high)) * std::abs(wy.high) +
                       normal * std::abs(wz.high);
    return quotient(above, kProducts * sum, upright, kProducts * normal);
}

}  // namespace

int turn(const double* a, const double* b, const double* p) {
    const double ax = a[0] - p[0], ay = a[1] - p[1], bx = b[0] - p[0], by = b[1] - p[1];
    const double left = ax * by, right = ay * bx, value = left - right;
    const double error = kTurnBound * (std::abs(left) + std::abs(right)) + kUnderflow;
    if (value > error) return 1;
    if (-value > error) return -1;
    if ((ax == 0 && bx == 0) || (ay == 0 && by == 0) || (ax == 0 && ay == 0) || (bx == 0 && by == 0)) return 0;
    return fit({a, b, p}, 2) ? exact_turn<Expansion>(a, b, p).sign() : exact_turn<Whole>(a, b, p).sign();
}

bool lies_below(const Fans& fans, Index triangle, const double* point, Depth& depth) {
    const Triangle& t = fans.triangles[static_cast<std::size_t>(triangle)];
    if (turn(t.a, t.b, point) < 0 || turn(t.b, t.c, point) < 0 || turn(t.c, t.a, point) < 0) return false;
    if (flat(t)) {
        const double down = point[2] - t.a[2];
        depth = {triangle, down * (1 - kSlack), down * (1 + kSlack)};
        return down >= 0;
    }
    const Volume above = volume(t.a, t.b, t.c, point);
    if (above.sign < 0) return false;
    depth = above.sign == 0 ? Depth{triangle, 0, 0} : bounded(triangle, t, above);
    return true;
}

int compare(const Fans& fans, const double* point, const Depth& first, const Depth& second) {
    if (first.most < second.least) return -1;
    if (second.most < first.least) return 1;
    if (first.triangle == second.triangle) return 0;
    const Triangle& s = fans.triangles[static_cast<std::size_t>(first.triangle)];
    const Triangle& t = fans.triangles[static_cast<std::size_t>(second.triangle)];
    if (flat(s) && flat(t)) return (s.a[2] < t.a[2]) - (s.a[2] > t.a[2]);
    return fit({s.a, s.b, s.c, t.a, t.b, t.c, point}, 3) ? compare_fractions<Expansion>(s, t, point)
                                                          : compare_fractions<Whole>(s, t, point);
}

double nearest(const Fans& fans, const double* point, const Depth& depth) {
    const Triangle& t = fans.triangles[static_cast<std::size_t>(depth.triangle)];
    if (flat(t)) return point[2] - t.a[2];
    if (depth.most == 0) return 0;
    const double quick = fit({t.a, t.b, t.c, point}, 3) ? nearest_by_bounds(t, point) : std::nan("");
    if (!std::isnan(quick)) return quick;
    const Fraction<Whole> whole(t, point);
    return nearest_quotient(whole.above, whole.upright);
}

}  // namespace jk
