#include "geometry/search.hpp"

#include <algorithm>

namespace jk {
namespace {

struct State {
    Index sector;
    std::optional<Crossing> entry;
};

enum class End { kVisible, kBlocked, kCircle };

class Search {
public:
    Search(const SectorMesh& mesh, const Fans& fans, const Segment& segment)
        : mesh_(mesh), fans_(fans), segment_(segment) {}

    Verdict run(Index sector) {
        walk({sector, std::nullopt});
        return {end_ != End::kBlocked, static_cast<Index>(decided_.size()), blocker_};
    }

    const std::vector<Step>& path() const { return decided_; }

private:
    // An explicit stack, since a way can be as long as the level has sectors.
    struct Frame {
        State state;
        std::vector<Crossing> exits;
        std::size_t next;
    };

    void walk(const State& start) {
        if (enter(start)) return;
        while (!frames_.empty()) {
            Frame& frame = frames_.back();
            if (frame.next == frame.exits.size()) {
                frames_.pop_back();
                steps_.pop_back();
                continue;
            }
            const Crossing exit = frame.exits[frame.next++];
            const Index surface = fans_.triangles[static_cast<std::size_t>(exit.triangle)].surface;
            steps_.back() = {frame.state.sector, surface, exit.from.value / (exit.from.value - exit.to.value)};
            if (enter({mesh_.leads_to[static_cast<std::size_t>(surface)], exit})) return;
        }
    }

    // True when the segment ends in the sector: the search is over.
    bool enter(const State& state) {
        if (tried(state)) {
            finish(End::kCircle, -1);
            return false;
        }
        tried_.push_back(state);
        Frame frame{state, {}, 0};
        leave_sector(mesh_, fans_, segment_, state.sector, state.entry, frame.exits);
        steps_.push_back({state.sector, -1, 1.0});
        if (frame.exits.empty()) {
            finish(End::kVisible, -1);
            return true;
        }
        for (const Crossing& exit : frame.exits) {
            const Index surface = fans_.triangles[static_cast<std::size_t>(exit.triangle)].surface;
            if (mesh_.leads_to[static_cast<std::size_t>(surface)] != kBlocks) continue;
            steps_.back() = {state.sector, surface, exit.from.value / (exit.from.value - exit.to.value)};
            finish(End::kBlocked, surface);
            steps_.pop_back();
            return false;
        }
        frames_.push_back(std::move(frame));
        return false;
    }

    bool tried(const State& state) const {
        return std::any_of(tried_.begin(), tried_.end(), [&](const State& other) {
            if (other.sector != state.sector) return false;
            if (!other.entry) return !state.entry || state.entry->from.sign == 0;
            return state.entry && compare(fans_, segment_, *state.entry, *other.entry) == 0;
        });
    }

    // Visible beats blocked, blocked beats a circle, and the first of a kind beats the rest.
    void finish(End end, Index blocker) {
        if (!decided_.empty() && static_cast<int>(end) >= static_cast<int>(end_)) return;
        end_ = end;
        blocker_ = blocker;
        decided_ = steps_;
    }

    const SectorMesh& mesh_;
    const Fans& fans_;
    const Segment segment_;
    std::vector<State> tried_;
    std::vector<Frame> frames_;
    std::vector<Step> steps_, decided_;
    End end_ = End::kCircle;
    Index blocker_ = -1;
};

}  // namespace

void leave_sector(const SectorMesh& mesh, const Fans& fans, const Segment& segment, Index sector,
                  const std::optional<Crossing>& entry, std::vector<Crossing>& exits) {
    exits.clear();
    const auto first = static_cast<std::size_t>(mesh.sector_first[static_cast<std::size_t>(sector)]);
    const auto end = first + static_cast<std::size_t>(mesh.sector_count[static_cast<std::size_t>(sector)]);
    for (Index t = fans.start[first]; t < fans.start[end]; ++t) {
        Crossing found;
        if (!crosses(fans, t, segment, found)) continue;
        if (entry && compare(fans, segment, found, *entry) < 0) continue;
        const int order = exits.empty() ? 0 : compare(fans, segment, found, exits.front());
        if (order > 0) continue;
        if (order < 0) exits.clear();
        const auto surface = fans.triangles[static_cast<std::size_t>(t)].surface;
        if (!exits.empty() && fans.triangles[static_cast<std::size_t>(exits.back().triangle)].surface == surface) continue;
        exits.push_back(found);
    }
}

Verdict search(const SectorMesh& mesh, const Fans& fans, Index sector, const Segment& segment, std::vector<Step>* path) {
    Search run(mesh, fans, segment);
    const Verdict verdict = run.run(sector);
    if (path) *path = run.path();
    return verdict;
}

}  // namespace jk
