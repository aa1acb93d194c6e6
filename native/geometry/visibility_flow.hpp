// Portal flow: what a segment can cross after a portal, by clipping windings along every chain of portals.
//
// A segment that crosses source, ..., pass, target in this order meets the target within the half-spaces of
// `separators(source, pass)` and the source before the target's plane; both windings are cut down so, and the chain goes
// on with the target as pass until one is empty. This is the method of Quake's vis, with certified half-spaces. A chain
// never holds a portal twice: what comes after its second crossing can come after the first.
//
// What lies outside the half-spaces of a chain stays out however far the chain goes on: a chain whose unseen portals all
// do ends at once. Quake's vis also cuts the source by `separators(target, pass)`. That took a third of the time
// and brought next to nothing (0.04 % of the visible pairs of azulcity): what is asked both ways already knows it.
#pragma once

#include "geometry/visibility_portals.hpp"

namespace jk::vis {

// What is known before a portal is worked on.
struct Known {
    const Portals& portals;
    const Bits& might;  // a superset of what each portal sees, from the flood
    const Bits& seen;   // what the portals that are done see
    const std::vector<std::uint8_t>& done;
    const std::vector<std::uint8_t>& reversible;  // portals for which, and for all that follow them, there is a twin

    // What portal p might see: what the flood reaches, but for what is known not to be seen the other way.
    std::vector<Bits::Word> might_see(std::size_t p) const;
};

// Tells the flow to stop: asked now and then.
class Stop {
public:
    virtual ~Stop() = default;
    virtual bool asked() = 0;
};

// Chains tried for one portal. Beyond them no chain is made longer: all that the flood reaches from where it then ends
// counts as seen. Where thousands of chains cross one open room, a longer search would bring next to nothing.
inline constexpr std::size_t kMostChains = std::size_t{1} << 11;

// Answers what portal p sees into `row`, zero before. False when some chains were cut short, or it was stopped.
bool flow(const Known& known, std::size_t p, Bits::Word* row, Stop& stop);

}  // namespace jk::vis
