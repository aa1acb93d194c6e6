// The signed volume of four points: in doubles with a bound, exactly when the bound leaves the sign in doubt.
#pragma once


namespace jk {

// Six times a signed volume: `value` is off by `error` at most, `sign` is exact.
struct Volume {
    double value, error;
    int sign;
};

// ((b - a) x (c - a)) . (p - a): positive when p lies on the side from which a, b, c turn counter-clockwise.
//
// The bound is Shewchuk's for the determinant of the three differences to p: each difference is rounded once, each
// 2 x 2 minor three times, each product and sum once more, so the error is at most (7 + 56 u) u times the sum of the
// absolute products, u = 2^-53. Underflow adds less than 2^-900 with coordinates below 2^150. Each point is x y z.
Volume volume(const double* a, const double* b, const double* c, const double* p);

// A triangle's corners.
struct Corners {
    const double *a, *b, *c;
};

// The sign of volume(s, p) volume(t, q) - volume(t, p) volume(s, q), exactly.
int compare_products(const Corners& s, const Corners& t, const double* p, const double* q);

// Whether three points lie on one line, exactly.
bool on_one_line(const double* a, const double* b, const double* c);

}  // namespace jk
