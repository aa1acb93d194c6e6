#include "geometry/walk.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "geometry/glance.hpp"

namespace jk {
namespace {

class Walk {
public:
    Walk(const SectorMesh& mesh, const Fans& fans, const Rooms& rooms, const Segment& segment, Index aim,
         const Stand& stand, Doubts& doubts)
        : mesh_(mesh), fans_(fans), rooms_(rooms), segment_(segment), aim_(aim), stand_(stand), doubts_(doubts) {
        stand_.reached |= aim == kNoAim;
    }

    Verdict run(Index start) {
        for (;; ++stand_.crossed) {
            stand_.reached |= stand_.sector == aim_;
            Glance seen = glance(rooms_, fans_, stand_.sector, segment_, stand_.entered);
            if (seen.kind == Glance::kDoubt)
                seen = look(stand_.sector);
            else
                entry_.reset();
            if (seen.kind == Glance::kEnds) return {true, stand_.crossed, -1, stand_.reached};
            if (seen.kind == Glance::kDoubt) {
                ++doubts_.queries;
                return search_all(start);
            }
            if (seen.leads_to == kBlocks) return {false, stand_.crossed, seen.surface, stand_.reached};
            stand_.sector = seen.leads_to;
            stand_.entered_by = seen.surface;
            stand_.entered = seen.latest;
        }
    }

private:
    Verdict search_all(Index start) const {
        if (aim_ == kNoAim) return search(mesh_, fans_, &rooms_, start, segment_);
        std::vector<Step> path;
        Verdict found = search(mesh_, fans_, &rooms_, start, segment_, &path);
        found.reached = std::any_of(path.begin(), path.end(), [&](const Step& step) { return step.sector == aim_; });
        return found;
    }

    // The exact answer for one sector; in doubt when ways part or do not advance.
    Glance look(Index sector) {
        ++doubts_.sectors;
        const std::optional<Crossing> entry = entry_ ? entry_ : entry_crossing();
        Exits exits(fans_, segment_, entry);
        exits.leave(mesh_, &rooms_, sector);
        if (exits.found().empty()) return {Glance::kEnds};
        for (const Crossing& exit : exits.found())
            if (leads_to(exit) == kBlocks) return {Glance::kLeaves, surface(exit), kBlocks, 1};
        const Crossing& exit = exits.found().front();
        const bool advances = entry ? compare(fans_, segment_, exit, *entry) > 0 : exit.from.sign > 0;
        if (exits.found().size() > 1 || !advances) return {Glance::kDoubt};
        entry_ = exit;
        return {Glance::kLeaves, surface(exit), leads_to(exit), latest(exit)};
    }

    // The exact crossing behind a certified one: the first through the surface's fan.
    std::optional<Crossing> entry_crossing() const {
        std::optional<Crossing> first;
        if (stand_.entered_by < 0) return first;
        const auto s = static_cast<std::size_t>(stand_.entered_by);
        for (Index t = fans_.start[s]; t < fans_.start[s + 1]; ++t) {
            Crossing found;
            if (!crosses(fans_, t, segment_, found)) continue;
            if (!first || compare(fans_, segment_, found, *first) < 0) first = found;
        }
        return first;
    }

    Index surface(const Crossing& exit) const { return fans_.triangles[static_cast<std::size_t>(exit.triangle)].surface; }
    Index leads_to(const Crossing& exit) const { return mesh_.leads_to[static_cast<std::size_t>(surface(exit))]; }

    const SectorMesh& mesh_;
    const Fans& fans_;
    const Rooms& rooms_;
    const Segment segment_;
    const Index aim_;
    Stand stand_;
    Doubts& doubts_;
    std::optional<Crossing> entry_;  // exact, where the last sector was searched completely
};

}  // namespace

Verdict walk(const SectorMesh& mesh, const Fans& fans, const Rooms& rooms, Index start, Index aim, const Stand& stand,
             const Segment& segment, Doubts& doubts) {
    return Walk(mesh, fans, rooms, segment, aim, stand, doubts).run(start);
}

Verdict walk(const SectorMesh& mesh, const Fans& fans, const Rooms& rooms, Index start, const Segment& segment,
             Doubts& doubts) {
    return walk(mesh, fans, rooms, start, kNoAim, {start}, segment, doubts);
}

}  // namespace jk
