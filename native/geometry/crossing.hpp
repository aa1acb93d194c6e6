// Where a segment crosses the triangles of a mesh outward, and which crossing comes first: exact answers.
#pragma once

#include "geometry/mesh.hpp"
#include "geometry/volume.hpp"

namespace jk {

// The fans of all surfaces, in order; triangles without area are left out.
struct Fans {
    struct Triangle {
        double a[3], b[3], c[3];
        Index surface;
    };

    explicit Fans(const SectorMesh& mesh);

    std::vector<Triangle> triangles;
    std::vector<Index> start;  // surface i has the triangles [start[i], start[i + 1])
};

struct Segment {
    const double* a;
    const double* b;
};

// An outward crossing: at t = from / (from - to) of the way from a to b, 0 <= t < 1.
struct Crossing {
    Index triangle;
    Volume from, to;  // of the triangle with a, not negative, and with b, negative
};

// Tests whether the segment leaves through the triangle: a on its inner side or its plane, b strictly behind it,
// and the crossing on the closed triangle.
bool crosses(const Fans& fans, Index triangle, const Segment& segment, Crossing& crossing);

// -1, 0 or 1: whether the first crossing comes before, with or after the second. Exact.
int compare(const Fans& fans, const Segment& segment, const Crossing& first, const Crossing& second);

}  // namespace jk
