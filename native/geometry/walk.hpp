// The balanced tier: a walk from sector to sector in float32 that trusts only what its bounds certify, and asks the
// complete search about the rest. Its answers are those of the complete search.
//
// In a sector, with f the planes of its sides (rooms.hpp) and m the greater of their bounds at a and b:
//  - a side with f(b) >= m or f(a) <= -m is not left through;
//  - any other could be left at t in [lo, hi] only, lo = (f(a) - m) / (f(a) - f(b)), hi = (f(a) + m) / (f(a) - f(b)):
//    t = g(a) / (g(a) - g(b)) rises with both g(a) and g(b);
//  - no side is left: b is in front of all, the segment ends here;
//  - side k is the only one left first when hi of k lies below 1 and below every other lo, and lo of k after the
//    greatest t at which the segment can have entered;
//  - the segment then passes the slab that holds side k within [lo, hi]: where that piece lies inside one polygon and
//    outside the others, each by more than its margin, the first is left through. (Each boundary edge of it has
//    the segment on its inner side, so that the segment winds once around the boundary and meets the fan.)
//  - needles are tested exactly, one by one.
// Whatever is not certified is a doubt: the complete search then answers for that sector, exactly, and the walk goes
// on. Where several ways lead on, or one that does not advance, the search answers the whole query.
#pragma once

#include "geometry/rooms.hpp"
#include "geometry/search.hpp"

namespace jk {

// How often the walk was in doubt: sectors searched completely, and whole queries.
struct Doubts {
    std::size_t sectors = 0, queries = 0;
};

Verdict walk(const SectorMesh& mesh, const Fans& fans, const Rooms& rooms, Index sector, const Segment& segment,
             Doubts& doubts);

}  // namespace jk
