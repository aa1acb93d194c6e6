// Where a straight way leaves a polygon, seen from above. Exact, as the other queries are.
#pragma once

#include <algorithm>
#include <utility>

#include "mesh.hpp"
#include "predicates.hpp"

namespace jklb {

// What a body stands on: a surface that carries, or a face of a thing.
struct Floor {
    Index surface = -1;
    // Of a thing: its source index (Things::source), where it is (kPlaced, or the number of its frame; a frame at which
    // it is as it is placed counts as that), and the face of its model at rest.
    Index thing = -1, frame = -1, face = -1;
    // The corners of that face where the thing is, in the order of the model, which is counter-clockwise seen from above:
    // x y z of each, JKU. The file does not hold models.
    const double* corners = nullptr;
    Index count = 0;

    static constexpr Index kPlaced = -1;

    static Floor of_surface(Index surface) {
        Floor floor;
        floor.surface = surface;
        return floor;
    }

    static Floor of_thing(Index thing, Index frame, Index face, const double* corners, Index count) {
        Floor floor;
        floor.thing = thing, floor.frame = frame, floor.face = face;
        floor.corners = corners, floor.count = count;
        return floor;
    }
};

// How a way leaves a polygon.
struct Exit {
    bool starts_inside;    // or on an edge; of a way that starts elsewhere nothing is said
    Index corner;          // of the edge that it crosses first: from this corner to the next one; -1 where it stays
    double place, along;   // how far along the edge, from its corner, and along the way, 0 .. 1: the nearest doubles
};

namespace detail {

// The corners of a floor.
class Ring {
public:
    Ring(const Mesh& mesh, const Floor& floor)
        : mesh_(mesh), surface_(floor.surface), corners_(floor.corners),
          count_(floor.surface >= 0 ? mesh.corners(floor.surface) : floor.count) {}

    Index count() const { return count_; }
    Point operator[](Index i) const { return corners_ ? corners_ + 3 * i : mesh_.corner(surface_, i); }
    Point after(Index i) const { return (*this)[i + 1 < count_ ? i + 1 : 0]; }

private:
    const Mesh& mesh_;
    const Index surface_;
    const double* const corners_;
    const Index count_;
};

// How far the second of two points lies to the left of a way, less how far the first does; and how far the first does.
template <typename Number>
struct Passing {
    Number first, change;
    Passing(Point a, Point b, Point from, Point to)
        : first(turn<Number>(a, b, from, 0, 1)), change(first - turn<Number>(a, b, to, 0, 1)) {}
};

// Whether a way crosses the edge from a to b sooner than that from c to d.
inline bool sooner(Point a, Point b, Point c, Point d, const Way& way) {
    const auto before = [&](auto number) {
        using Number = decltype(number);
        const Passing<Number> one(a, b, way.from, way.to), other(c, d, way.from, way.to);
        return (one.first * other.change - other.first * one.change).sign() < 0;
    };
    return fit({a, b, c, d, way.from, way.to}) ? before(Expansion()) : before(Dyadic());
}

// Which part of the way from p to q lies on the left of the line from a to b, p itself on it or there, q not.
inline double part(Point a, Point b, Point p, Point q) {
    const auto exact = [&](auto number) {
        const Passing<decltype(number)> found(a, b, p, q);
        return std::pair(found.first, found.change);
    };
    return quotient(fit({a, b, p, q}), exact);
}

// Whether a point on the line from a to b lies between the two.
inline bool between(Point a, Point b, Point p) {
    return std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= p[1] &&
           p[1] <= std::max(a[1], b[1]);
}

// An edge is crossed where the way starts on its left or on it, ends strictly on its right, and passes between its ends
// or through one. Where it leaves by a corner, the first of both edges counts.
inline Exit leaving(const Ring& ring, const Way& way) {
    Exit out{false, -1, 0, 1};
    int turns = 0;
    for (Index i = 0; i < ring.count(); ++i) {
        const Point a = ring[i], b = ring.after(i), from = way.from;
        const int side = orient2d(a, b, from).sign;
        out.starts_inside |= side == 0 && between(a, b, from);
        turns += side > 0 && a[1] <= from[1] && from[1] < b[1];
        turns -= side < 0 && b[1] <= from[1] && from[1] < a[1];
        if (side < 0 || orient2d(a, b, way.to).sign >= 0) continue;
        if (orient2d(from, way.to, a).sign > 0 || orient2d(from, way.to, b).sign < 0) continue;
        if (out.corner < 0 || sooner(a, b, ring[out.corner], ring.after(out.corner), way)) out.corner = i;
    }
    out.starts_inside |= turns > 0;
    if (!out.starts_inside) return {false, -1, 0, 1};
    if (out.corner < 0) return out;
    const Point a = ring[out.corner], b = ring.after(out.corner);
    out.along = part(a, b, way.from, way.to);
    out.place = part(way.to, way.from, a, b);
    return out;
}

}  // namespace detail
}  // namespace jklb
