// Polygons as portal flow carries them, and the two operations on them, each certified to err on the side of seeing.
//
// A winding stands for every point within `radius` of the hull of its points. Certified means: whatever the rounding,
// a half-space that `separators` gives holds every point that a line can reach, and what `clip` leaves holds every
// point of the winding in that half-space. Both rest on two figures of the level: `error`, a bound of the error of
// n . (x - o) in doubles for a unit n and points of the level (16 u times the level's size, u = 2^-53; the differences,
// products and sums need 6 u), and `step`, a bound of the rounding of a point computed between two others.
#pragma once

#include <boost/container/small_vector.hpp>

#include "geometry/boxes.hpp"

namespace jk::vis {

struct Point {
    double x, y, z;

    friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Point operator*(double k, const Point& a) { return {k * a.x, k * a.y, k * a.z}; }
};

inline double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point cross(const Point& a, const Point& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Precision {
    double error, step;
    double farthest_bend;  // a cut farther than this from where a flat polygon has it is not made
};

struct Winding {
    boost::container::small_vector<Point, 8> points;
    double radius = 0;
};

// The half-space n . (x - at) >= least, n a unit vector but for rounding.
struct HalfSpace {
    Point n, at;
    double least;
};

using HalfSpaces = boost::container::small_vector<HalfSpace, 12>;

// False when the whole box, whose corners are coordinates of the level, is certainly outside the half-space.
bool touches(const HalfSpace& half, const Box& box, const Precision& precision);

// Whether no point of the winding is certainly outside the half-space: `clip` then leaves it as it is.
bool holds(const HalfSpace& half, const Winding& winding, const Precision& precision);

// Cuts away what lies outside the half-space. False when nothing is left.
//
// Points certainly outside go; a cut is made between each point that stays and the next one that goes, at the place
// farthest out that rounding allows. The hull of the points is not flat if the polygon was bent: then what joins
// points that are not neighbours leaves it elsewhere, and the radius grows to hold that as well. Where it would grow
// beyond `farthest_bend`, or the outline crosses the plane more than twice, the winding stays as it is.
bool clip(Winding& winding, const HalfSpace& half, const Precision& precision);

// Appends half-spaces that hold every point y which a line meets after `pass`, having met `source` before it.
//
// y = p + k (p - s), k >= 0, with p of the pass and s of the source: when n.s < d <= n.p for all of them, n.y >= d.
// The candidates hold an edge of one winding and touch the other, tilted about that edge by more than the rounding;
// one that does not strictly part the two windings, radii and rounding included, is left out. Windings that touch
// have none.
// Only planes on one side of an edge are tried: the points of both turn counter-clockwise seen from before the source.
void separators(const Winding& source, const Winding& pass, const Precision& precision, HalfSpaces& out);

}  // namespace jk::vis
