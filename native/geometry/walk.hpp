// The balanced tier: a walk from sector to sector in float32 that trusts only what its bounds certify, and asks the
// complete search about the rest. Its answers are those of the complete search.
//
// Each room is glanced at (glance.hpp). Where that leaves a doubt, the sector is searched, exactly, and the walk goes on
// from there. Where several ways lead on, or one that does not advance, the search answers the whole query.
#pragma once

#include "geometry/rooms.hpp"
#include "geometry/search.hpp"

namespace jk {

// How often the walk was in doubt: sectors searched completely, and whole queries.
struct Doubts {
    std::size_t sectors = 0, queries = 0;
};

// Where a walk stands: in a sector, the `crossed`-th on its way, that it entered through a surface (-1: it started
// there) at t = `entered` at the latest.
struct Stand {
    Index sector, entered_by = -1, crossed = 1;
    float entered = 0;
    bool reached = false;  // whether the sector aimed at was one of those before
};

// Walks on from `stand`; `start` is the sector that the segment starts in, `aim` one that it aims at, or kNoAim.
Verdict walk(const SectorMesh& mesh, const Fans& fans, const Rooms& rooms, Index start, Index aim, const Stand& stand,
             const Segment& segment, Doubts& doubts);

Verdict walk(const SectorMesh& mesh, const Fans& fans, const Rooms& rooms, Index start, const Segment& segment,
             Doubts& doubts);

}  // namespace jk
