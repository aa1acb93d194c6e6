#include "geometry/search.hpp"

#include <algorithm>

#include "geometry/glance.hpp"

namespace jk {
namespace {

struct State {
    Index sector;
    std::optional<Crossing> entry;
};

enum class End { kVisible, kBlocked, kCircle };

class Search {
public:
    Search(const SectorMesh& mesh, const Fans& fans, const Rooms* rooms, const Segment& segment)
        : mesh_(mesh), fans_(fans), rooms_(rooms), segment_(segment) {}

    Verdict run(Index sector) {
        walk({sector, std::nullopt});
        return {end_ != End::kBlocked, static_cast<Index>(decided_.size()), blocker_};
    }

    const std::vector<Step>& path() const { return decided_; }

private:
    // An explicit stack, since a way can be as long as the level has sectors.
    struct Frame {
        State state;
        Exits::Found exits;
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
        Exits exits(fans_, segment_, state.entry);
        exits.leave(mesh_, rooms_, state.sector);
        Frame frame{state, exits.found(), 0};
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
    const Rooms* rooms_;
    const Segment segment_;
    std::vector<State> tried_;
    std::vector<Frame> frames_;
    std::vector<Step> steps_, decided_;
    End end_ = End::kCircle;
    Index blocker_ = -1;
};

}  // namespace

void Exits::offer(Index triangle) {
    Crossing crossing;
    if (!crosses(fans_, triangle, segment_, crossing)) return;
    if (entry_ && compare(fans_, segment_, crossing, *entry_) < 0) return;
    const int order = found_.empty() ? 0 : compare(fans_, segment_, crossing, found_.front());
    if (order > 0) return;
    if (order < 0) found_.clear();
    found_.push_back(crossing);
}

void Exits::one_a_surface() {
    const auto surface = [&](const Crossing& c) { return fans_.triangles[static_cast<std::size_t>(c.triangle)].surface; };
    std::sort(found_.begin(), found_.end(), [&](const Crossing& a, const Crossing& b) { return a.triangle < b.triangle; });
    const auto same = [&](const Crossing& a, const Crossing& b) { return surface(a) == surface(b); };
    found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
}

void Exits::leave(const SectorMesh& mesh, const Rooms* rooms, Index sector) {
    if (rooms) {
        Triangles possible;
        possible_exits(mesh, *rooms, fans_, sector, segment_, possible);
        for (const Index triangle : possible) offer(triangle);
        return one_a_surface();
    }
    const auto first = static_cast<std::size_t>(mesh.sector_first[static_cast<std::size_t>(sector)]);
    const auto end = first + static_cast<std::size_t>(mesh.sector_count[static_cast<std::size_t>(sector)]);
    for (Index t = fans_.start[first]; t < fans_.start[end]; ++t) offer(t);
    one_a_surface();
}

Verdict search(const SectorMesh& mesh, const Fans& fans, const Rooms* rooms, Index sector, const Segment& segment,
               std::vector<Step>* path) {
    Search run(mesh, fans, rooms, segment);
    const Verdict verdict = run.run(sector);
    if (path) *path = run.path();
    return verdict;
}

}  // namespace jk
