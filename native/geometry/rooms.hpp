// A mesh packed for the walk: each sector as the planes of its sides and the polygons on them, in float32 about the
// sector's own centre, with bounds on how far that picture is from the truth.
//
// A side is a set of nearly coplanar surfaces: one wall of a room, cut up by windows. The walk trusts a float32
// result only beyond these bounds, so they are what makes it exact. Let u = 2^-24, x a point, x' = x - centre rounded
// to float32 and X its greatest coordinate.
//
// Side. Every triangle T of the side has an exact unit plane g(x) = N.(x - centre) + D. The side's float32 plane
// f(x') = n.x' + d differs from it by at most |n - N|_1 X + |D - d| (different planes), sqrt(3) u X (rounding x')
// and 4 u (sqrt(3) X + |d|) (rounding the sum): below `still + tilt X`, where tilt = max |n - N|_1 + 9 u and
// still = max |D - d| + 4 u |d| + u r, r the room's half size, both padded by 1/1000. A room that no such bounds hold
// for, too large or too small for float32 among them, has no centre (NaN), and is always in doubt.
//
// A surface that is bent, whose triangles lean from its plane by more than kMostTilt, is packed as one polygon a
// triangle, each on a side of its own. Needles, triangles so thin that their plane is ill-conditioned or leans though
// their surface does not, keep out of the bounds: they are listed with the side that they lie along, whose `still`
// bounds the distance to it, and tested one by one.
//
// Polygon. Its edges are lines a p + b q + c >= 0 in two of the three coordinates, those other than the side normal's
// greatest, with a^2 + b^2 = 1. `margin` bounds how far its vertices lie outside its own edges, the length of
// edges and the height of needles left out, and the rounding of a point in the room. A point beyond the margin inside
// all edges is inside the polygon, one beyond the margin outside some edge is outside; the segments in between are
// left in doubt.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/crossing.hpp"
#include "geometry/mesh.hpp"

namespace jk {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));

// Eight sides of a sector and their bounds; places left over hold a plane that is infinitely far ahead.
struct alignas(64) PlaneBlock {
    static constexpr int kSides = 8;
    Float8 x, y, z, d;
    Float8 still, tilt;
};

// The polygons of one side: blocks [first, first + count).
struct Side {
    Index first;
    std::uint16_t count;
    std::uint16_t axis;  // the coordinate that is left out
};

// Four edges of a polygon; places left over hold an edge that is infinitely far off. A polygon of more edges
// continues in the next block. A point beyond the margin inside a polygon that is `apart` is outside all others of its
// side: each lies beyond one of its edges, by the margin at most on the wrong side.
struct alignas(64) PolygonBlock {
    Float4 a, b, c;
    float margin;
    Index surface, leads_to;
    std::uint16_t continues, apart;
};

struct Room {
    double center[3];
    Index plane, planes;  // blocks, counted from `plane`
    Index sides;
    Index needle, needles;
};

// A needle lies within `margin` of the line a p + b q + c = 0 in its side's two coordinates, and within the side's
// `still` of its plane.
struct Needle {
    Index triangle, side;
    float a, b, c, margin;
};

struct Rooms {
    Rooms(const SectorMesh& mesh, const Fans& fans);

    std::size_t memory() const;

    std::vector<Room> rooms;
    std::vector<PlaneBlock> planes;
    std::vector<Side> sides;  // eight a plane block
    std::vector<PolygonBlock> polygons;
    std::vector<Needle> needles;
};

}  // namespace jk
