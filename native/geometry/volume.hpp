// The signed volume of four points: in doubles with a bound, exactly when the bound leaves the sign in doubt.
#pragma once

#include "geometry/expansion.hpp"

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
// absolute products, u = 2^-53. Each point is x y z.
Volume volume(const double* a, const double* b, const double* c, const double* p);

// The same as an expansion.
Expansion exact_volume(const double* a, const double* b, const double* c, const double* p);

// Whether three points lie on one line, exactly.
bool on_one_line(const double* a, const double* b, const double* c);

}  // namespace jk
