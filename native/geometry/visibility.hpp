// Which sectors can be seen from which: the potentially visible set of a level.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "geometry/sight.hpp"

namespace jk {

// Rows of bits, each (sectors + 7) / 8 bytes: bit b % 8 of byte b / 8 of row a says that b is potentially visible from a.
struct Visibility {
    std::vector<std::uint8_t> rows;
    std::size_t portals = 0;
    std::size_t cut_short = 0;  // portals of which some chains were cut short (kMostChains): their answer is looser
};

// Told how many of how many portals are done, on the calling thread; false stops the work.
using Watch = std::function<bool(std::size_t done, std::size_t all)>;

// Answers for every pair of sectors. `leads_to` as in SectorMesh, a sector behind each surface that sight passes or
// may come to pass; kFast floods, kBalanced clips in doubles, kExact with 106 bits. A pair without a bit is certain:
// no segment that starts in a enters b by the rules of sight, whatever shape the sectors have. The work is
// shared out among `threads` threads (0: one a core); the answer does not depend on how many. Throws
// std::invalid_argument when `leads_to` names no sector. Empty when `watch` stopped it.
Visibility visibility(const Viewer& viewer, std::span<const Index> leads_to, Tier tier, unsigned threads,
                      const Watch& watch);

}  // namespace jk
