// One room looked at in float32: how the segment leaves it, where the bounds of rooms.hpp certify that, and which
// triangles it can leave through at all.
//
// In a room, with f the planes of its sides and m the greater of their bounds at a and b:
//  - a side with f(b) >= m or f(a) <= -m is not left through;
//  - any other could be left at t in [lo, hi] only, lo = (f(a) - m) / (f(a) - f(b)), hi = (f(a) + m) / (f(a) - f(b)):
//    t = g(a) / (g(a) - g(b)) rises with both g(a) and g(b);
//  - no side is left: b is in front of all, the segment ends here;
//  - side k is the only one left first when hi of k lies below 1 and below every other lo, and lo of k after the
//    greatest t at which the segment can have entered;
//  - the segment then passes the slab that holds side k within [lo, hi]: where that piece lies inside one polygon and
//    outside the others, each by more than its margin, the first is left through. (Each boundary edge of it has
//    the segment on its inner side, so that the segment winds once around the boundary and meets the fan.)
//    Where it lies outside all, side k is missed, and the next is looked at;
//  - a needle lies in the slab of its side, but may face anywhere: it is tested exactly unless the segment stays in
//    front of the slab until after hi of k.
// Whatever is not certified is a doubt.
#pragma once

#include <boost/container/small_vector.hpp>

#include "geometry/rooms.hpp"

namespace jk {

struct Glance {
    enum Kind { kEnds, kLeaves, kDoubt } kind;
    Index surface = -1, leads_to = kBlocks;
    float latest = 0;  // an upper bound of the t at which it leaves
};

// Looks at a room that the segment enters at `entered` at the latest.
Glance glance(const Rooms& rooms, const Fans& fans, Index sector, const Segment& segment, float entered);

// The same for up to kPacket segments that are in one room at once, which share the room's planes: segment i of `count`
// enters at `entered[i]` at the latest, and `seen[i]` receives what glance() finds. One that only a look of its own can
// decide is told as a doubt.
inline constexpr int kPacket = 8;
void glance_packet(const Rooms& rooms, const Fans& fans, Index sector, const Segment* segments, const float* entered,
                   int count, Glance* seen);

// An upper bound of the t of a crossing in float32; 1 and above leaves the next room in doubt.
float latest(const Crossing& crossing);

using Triangles = boost::container::small_vector<Index, 64>;

// The triangles of the sector that the segment could leave through, some of them more than once.
void possible_exits(const SectorMesh& mesh, const Rooms& rooms, const Fans& fans, Index sector, const Segment& segment,
                    Triangles& triangles);

}  // namespace jk
