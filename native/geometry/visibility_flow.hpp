// Portal flow: what a segment can cross after a portal, by clipping windings along every chain of portals.
//
// A segment that crosses source, ..., pass, target in this order meets the target within the half-spaces of
// `separators(source, pass)` and the source within those of `separators(target, pass)`; both windings are cut down so,
// and the chain goes on with the target as pass until one is empty. This is the method of Quake's vis, with
// certified half-spaces. A chain never holds a portal twice: what comes after its second crossing can come after the
// first.
#pragma once

#include "geometry/visibility_portals.hpp"

namespace jk::vis {

// What is known of the portals that were finished before: their rows in `seen` are final.
struct Finished {
    const Portals& portals;
    const Bits& might;  // a superset of what each portal sees, from the flood
    const Bits& seen;
    const std::vector<std::uint8_t>& done;
};

// Tells the flow to stop: asked now and then.
class Stop {
public:
    virtual ~Stop() = default;
    virtual bool asked() = 0;
};

// Chains tried for one portal before the flow gives up on it and takes the flood's answer, which is safe.
inline constexpr std::size_t kMostChains = std::size_t{1} << 20;

// Answers what portal p sees into `row`. False when it gave up (or was stopped).
bool flow(const Finished& known, std::size_t p, Bits::Word* row, Stop& stop);

}  // namespace jk::vis
