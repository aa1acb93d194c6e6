// The balanced walk of many segments at once. They advance in waves, one sector each: those that are in the same sector
// are brought together and looked at eight at a time (glance_packet), which shares the sector's planes among them.
// What a packet leaves in doubt walks on alone (walk.hpp). The answers are those of the walk, whatever else is in the
// batch.
#pragma once

#include "geometry/queries.hpp"
#include "geometry/rooms.hpp"

namespace jk {

// Rows that are walked together: enough to meet in sectors, few enough to stay in the cache.
inline constexpr std::size_t kWave = 8192;

// Answers the rows [first, end), at most kWave of them. A query that aims at a sector which is not among the `known`
// visible ones is not walked at all: it is not visible, and nothing is told of its way.
void walk_waves(const SectorMesh& mesh, const Fans& fans, const Rooms& rooms, const Queries& queries,
                const VisibleRows& known, std::size_t first, std::size_t end, Sight& out);

}  // namespace jk
