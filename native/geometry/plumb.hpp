// Where the vertical line down from a point meets triangles that face up: exact answers.
#pragma once

#include "geometry/crossing.hpp"

namespace jk {

// 1, 0 or -1: p lies to the left of the line from a to b seen from above, on it, or to its right. Exact.
int turn(const double* a, const double* b, const double* p);

// How far below a point a triangle lies, JKU: no less than `least`, no more than `most`.
struct Depth {
    Index triangle;
    double least, most;
};

// Tests whether a triangle that faces up lies at or below the point, with the vertical line through the point meeting
// it, edges and corners included. Exact.
bool lies_below(const Fans& fans, Index triangle, const double* point, Depth& depth);

// -1, 0 or 1: whether the first depth is less than, equal to or more than the second. Exact.
int compare(const Fans& fans, const double* point, const Depth& first, const Depth& second);

// The double nearest to the depth, ties to even.
double nearest(const Fans& fans, const double* point, const Depth& depth);

}  // namespace jk
