// Vectors, planes and triangles in exact constructions. For exact_ledges.cpp.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/boxes.hpp"
#include "geometry/mesh.hpp"

namespace jk::exact {

using Number = CGAL::Exact_predicates_exact_constructions_kernel::FT;

inline constexpr double kSteep = 0.7;  // least z of a unit normal

struct Vector {
    Number x, y, z;
};

inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

inline Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Number dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Boost's numbers refuse subnormal doubles.
inline Number number(double x) { return Number(std::abs(x) < 0x1p-1000 ? 0.0 : x); }

inline Vector vector(const double* p) { return {number(p[0]), number(p[1]), number(p[2])}; }

struct Plane {
    Vector corner, normal;  // of any length, z > 0

    Number height(const Number& x, const Number& y) const {
        return corner.z - (normal.x * (x - corner.x) + normal.y * (y - corner.y)) / normal.z;
    }

    bool is_steep() const { return normal.z * normal.z < Number(kSteep * kSteep) * dot(normal, normal); }
};

struct Triangle {
    const double *a, *b, *c;
    Index owner;  // surface or face

    bool outside(const Box& box) const {
        Box own = Box::nothing();
        for (const double* p : {a, b, c}) own.add(p);
        return !own.touches(box);
    }

    std::optional<Plane> upward() const {
        const Vector corner = vector(a), normal = cross(vector(b) - corner, vector(c) - corner);
        if (normal.z <= 0) return std::nullopt;
        return Plane{corner, normal};
    }

    // Whether a triangle that faces up holds a place, seen from above.
    bool holds(const Number& x, const Number& y) const {
        const double* corners[4] = {a, b, c, a};
        for (int k = 0; k < 3; ++k) {
            const Vector p = vector(corners[k]), q = vector(corners[k + 1]);
            if ((q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x) < 0) return false;
        }
        return true;
    }

    // How far along a segment it passes through the closed triangle, from either side.
    std::optional<Number> pierced(const Vector& from, const Vector& to) const {
        const Vector p = vector(a), q = vector(b), r = vector(c), normal = cross(q - p, r - p);
        const Number before = dot(normal, from - p), after = dot(normal, to - p);
        if (!(before > 0 && after < 0) && !(before < 0 && after > 0)) return std::nullopt;
        const Vector way = to - from;
        int left = 0, right = 0;
        for (const auto& [u, v] : {std::pair(p, q), std::pair(q, r), std::pair(r, p)}) {
            const auto side = CGAL::sign(dot(way, cross(u - from, v - from)));
            left += side > 0, right += side < 0;
        }
        if (left && right) return std::nullopt;
        return before / (before - after);
    }
};

// Adds the triangles of a polygon.
inline void fan(const std::vector<const double*>& corners, Index owner, std::vector<Triangle>& triangles) {
    for (std::size_t i = 2; i < corners.size(); ++i)
        triangles.push_back({corners[0], corners[i - 1], corners[i], owner});
}

}  // namespace jk::exact
