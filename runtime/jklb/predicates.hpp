// On which side a point lies, and which of two triangles a line meets first: exact answers about doubles.
//
// Each is computed in doubles first, with a bound of the rounding; where that leaves the sign in doubt, exactly. All
// answers are exact for finite coordinates below 2^150.
#pragma once

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <utility>

#include "exact.hpp"

namespace jklb {

// Every point is x y z.
using Point = const double*;

// A figure and its bound: off by `error` at most; `sign` is exact.
struct Signed {
    double value, error;
    int sign;
};

namespace detail {

inline constexpr double kUnit = 0x1p-53;

// What underflow can add to the figures below with coordinates below 2^150, many times over.
inline constexpr double kUnderflow = 0x1p-900;

template <typename Number>
struct Vector {
    Number x, y, z;
    Vector(Point to, Point from)
        : x(Number::difference(to[0], from[0])), y(Number::difference(to[1], from[1])),
          z(Number::difference(to[2], from[2])) {}
};

template <typename Number>
Number volume(Point a, Point b, Point c, Point p) {
    const Vector<Number> u(b, a), v(c, a), w(p, a);
    return (u.y * v.z - u.z * v.y) * w.x + (u.z * v.x - u.x * v.z) * w.y + (u.x * v.y - u.y * v.x) * w.z;
}

template <typename Number>
Number turn(Point a, Point b, Point p, int x, int y) {
    return Number::difference(b[x], a[x]) * Number::difference(p[y], a[y]) -
           Number::difference(b[y], a[y]) * Number::difference(p[x], a[x]);
}

inline bool fit(std::initializer_list<Point> points) {
    for (const Point p : points)
        if (!Expansion::fits(p[0]) || !Expansion::fits(p[1]) || !Expansion::fits(p[2])) return false;
    return true;
}

// orient3d as doubles have it, sign 0 in doubt.
//
// The bound, u = 2^-53: a difference is off by u of itself. Of a product of two such, less another, the rounding of both
// products and of the difference is 2 u of the sum S of their magnitudes; times the third difference, 3 u of S times it.
// That the differences themselves were rounded adds 3 u of the same, and each of the two sums u: 8 u of the sum of all
// S times their third, to first order. 10 u leaves room for the rest and for the rounding of the bound.
inline Signed rough_orient3d(Point a, Point b, Point c, Point p) {
    const double ax = a[0] - p[0], ay = a[1] - p[1], az = a[2] - p[2];
    const double bx = b[0] - p[0], by = b[1] - p[1], bz = b[2] - p[2];
    const double cx = c[0] - p[0], cy = c[1] - p[1], cz = c[2] - p[2];
    const double bc = bx * cy, cb = by * cx, ca = cx * ay, ac = cy * ax, ab = ax * by, ba = ay * bx;
    const double value = (cb - bc) * az + (ac - ca) * bz + (ba - ab) * cz;
    const double sum = (std::abs(bc) + std::abs(cb)) * std::abs(az) + (std::abs(ca) + std::abs(ac)) * std::abs(bz) +
                       (std::abs(ab) + std::abs(ba)) * std::abs(cz);
    const double error = 10 * kUnit * sum + kUnderflow;
    return {value, error, (value > error) - (value < -error)};
}

// The same with its sign, of one that is in doubt.
inline Signed sure_orient3d(Point a, Point b, Point c, Point p, Signed rough) {
    // Points with a coordinate in common: the usual doubt in levels, which are built on a grid.
    for (int k = 0; k < 3; ++k)
        if (a[k] == p[k] && b[k] == p[k] && c[k] == p[k]) return {0, 0, 0};
    rough.sign = fit({a, b, c, p}) ? volume<Expansion>(a, b, c, p).sign() : volume<Dyadic>(a, b, c, p).sign();
    return rough;
}

}  // namespace detail

// Six times the volume of a, b, c, p: positive when p lies on the side from which a, b, c turn counter-clockwise.
inline Signed orient3d(Point a, Point b, Point c, Point p) {
    const Signed rough = detail::rough_orient3d(a, b, c, p);
    return rough.sign ? rough : detail::sure_orient3d(a, b, c, p, rough);
}

namespace detail {

// orient2d as doubles have it. The bound as above: 2 u for the products and their difference, 2 u for the differences;
// 6 u leaves room.
inline Signed rough_orient2d(Point a, Point b, Point p, int x, int y) {
    const double left = (a[x] - p[x]) * (b[y] - p[y]), right = (a[y] - p[y]) * (b[x] - p[x]), value = left - right;
    const double error = 6 * kUnit * (std::abs(left) + std::abs(right)) + kUnderflow;
    return {value, error, (value > error) - (value < -error)};
}

}  // namespace detail

// Twice the area of a, b, p as seen along the third axis: positive when p lies to the left of the way from a to b in
// the plane of the axes x and y, 0 to 2.
inline Signed orient2d(Point a, Point b, Point p, int x = 0, int y = 1) {
    Signed out = detail::rough_orient2d(a, b, p, x, y);
    if (out.sign) return out;
    if ((a[x] == p[x] && b[x] == p[x]) || (a[y] == p[y] && b[y] == p[y]) || (a[x] == p[x] && a[y] == p[y]) ||
        (b[x] == p[x] && b[y] == p[y]))
        return {0, 0, 0};
    out.sign = detail::fit({a, b, p}) ? detail::turn<Expansion>(a, b, p, x, y).sign()
                                      : detail::turn<Dyadic>(a, b, p, x, y).sign();
    return out;
}

// Whether three points lie on one line: seen along every axis.
inline bool collinear(Point a, Point b, Point c) {
    constexpr int kAxes[][2] = {{0, 1}, {1, 2}, {2, 0}};
    for (const auto& [x, y] : kAxes)
        if (detail::rough_orient2d(a, b, c, x, y).sign) return false;
    for (const auto& [x, y] : kAxes)
        if (orient2d(a, b, c, x, y).sign) return false;
    return true;
}

// A way from a point: to another, or without one straight down, 1 JKU for t = 1.
struct Way {
    Point from, to = nullptr;
};

struct Triangle {
    Point a, b, c;
};

// orient3d of a triangle and a point. Much faster where the corners lie on one line, as fans of surfaces often have it.
inline Signed side(const Triangle& t, Point p) {
    const Signed rough = detail::rough_orient3d(t.a, t.b, t.c, p);
    if (rough.sign) return rough;
    if (collinear(t.a, t.b, t.c)) return {0, 0, 0};
    return detail::sure_orient3d(t.a, t.b, t.c, p, rough);
}

// Where a way meets the plane of a triangle: at t = above / fall, fall > 0 and above >= 0.
struct Meeting {
    Triangle triangle;
    Signed above, fall;
};

namespace detail {

// above and fall of a meeting, six times a volume each.
template <typename Number>
struct Fraction {
    Number above, fall;

    Fraction(const Triangle& t, const Way& way) {
        const Vector<Number> u(t.b, t.a), v(t.c, t.a), w(way.from, t.a);
        const Number x = u.y * v.z - u.z * v.y, y = u.z * v.x - u.x * v.z, z = u.x * v.y - u.y * v.x;
        above = x * w.x + y * w.y + z * w.z;
        if (!way.to) {
            fall = z;
            return;
        }
        const Vector<Number> back(way.from, way.to);
        fall = x * back.x + y * back.y + z * back.z;
    }
};

template <typename Number>
int compare(const Triangle& first, const Triangle& second, const Way& way) {
    const Fraction<Number> s(first, way), t(second, way);
    return (s.above * t.fall - t.above * s.fall).sign();
}

inline bool fit(const Triangle& t, const Way& way) {
    return fit({t.a, t.b, t.c, way.from}) && (!way.to || fit({way.to}));
}

inline double next(double x, bool up) {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    bits = up ? bits + 1 : bits - 1;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}

inline bool odd(double x) {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits & 1;
}

// The double nearest to above / fall, ties to even: `guess` moved until neither neighbour is nearer. Positive numbers.
template <typename Number>
double nearest(const Number& above, const Number& fall, double guess) {
    const Number twice = above + above;
    for (bool up : {true, false})
        for (;;) {
            const double other = guess == 0 && !up ? guess : next(guess, up);
            if (other == guess) break;
            // Whether above / fall lies beyond the middle between the two.
            const int beyond = (twice - Number::difference(guess, -other) * fall).sign() * (up ? 1 : -1);
            if (beyond < 0 || (beyond == 0 && !odd(guess))) break;
            guess = other;
        }
    return guess;
}

// The double nearest to above / fall, ties to even. exact(Number()) is the pair of them, fall positive, in expansions
// where these hold what they are made of.
template <typename Exact>
double quotient(bool fits, const Exact& exact) {
    const auto of = [](const auto& above, const auto& fall, const auto& guess) {
        if (above.sign() < 0) return -nearest(decltype(above + above)() - above, fall, guess());
        return nearest(above, fall, guess());
    };
    if (fits) {
        const auto [above, fall] = exact(Expansion());
        if (above.sign() == 0) return 0;
        const double guess = std::abs(above.about() / fall.about());
        if (guess > 0x1p-600) return of(above, fall, [guess] { return guess; });  // its last bit times fall: no underflow
    }
    const auto pair = exact(Dyadic());
    if (pair.first.sign() == 0) return 0;
    return of(pair.first, pair.second, [&pair] { return rough_quotient(pair.first, pair.second); });
}

}  // namespace detail

// -1, 0 or 1: whether a way meets the first before, with or after the second.
inline int compare(const Meeting& first, const Meeting& second, const Way& way) {
    if (first.above.sign == 0 || second.above.sign == 0) return first.above.sign - second.above.sign;
    const double p = first.above.value * second.fall.value, q = second.above.value * first.fall.value;
    const auto doubt = [](const Signed& a, const Signed& b) {
        return std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error;
    };
    const double error = 1.0625 * (doubt(first.above, second.fall) + doubt(second.above, first.fall)) +
                         4 * detail::kUnit * (std::abs(p) + std::abs(q)) + detail::kUnderflow;
    if (p - q > error) return 1;
    if (p - q < -error) return -1;
    const Triangle &s = first.triangle, &t = second.triangle;
    if (s.a == t.a && s.b == t.b && s.c == t.c) return 0;
    return detail::fit(s, way) && detail::fit(t, way) ? detail::compare<Expansion>(s, t, way)
                                                      : detail::compare<Dyadic>(s, t, way);
}

// How far down the way meets the triangle: the double nearest to it, ties to even. For ways straight down.
inline double depth(const Meeting& met, const Way& way) {
    const Triangle& t = met.triangle;
    if (t.a[2] == t.b[2] && t.a[2] == t.c[2]) return way.from[2] - t.a[2];
    if (met.above.sign == 0) return 0;
    return detail::quotient(detail::fit(t, way), [&](auto number) {
        const detail::Fraction<decltype(number)> exact(t, way);
        return std::pair(exact.above, exact.fall);
    });
}

}  // namespace jklb
