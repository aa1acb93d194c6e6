#include "geometry/visibility_flow.hpp"

#include <algorithm>
#include <bit>

namespace jk::vis {
namespace {

// Chains between two questions whether to stop.
constexpr std::size_t kPatience = 1024;

class Flow {
public:
    Flow(const Known& known, std::size_t start, Bits::Word* row, Stop& stop)
        : known_(known), portals_(known.portals.portals), precision_(known.portals.precision),
          words_(known.might.words()), start_(start), row_(row), stop_(stop), on_chain_(portals_.size()) {}

    bool run() {
        might_ = known_.might_see(start_);
        push(start_, portals_[start_].winding, {});
        std::size_t chains = 0;
        while (depth_) {
            Frame& frame = frames_[depth_ - 1];
            if (frame.next == frame.end) {
                pop();
                continue;
            }
            const auto target = static_cast<std::size_t>(frame.next++);
            if (!bit(might(depth_ - 1), target) || on_chain_[target]) continue;
            if (++chains % kPatience == 0 && stop_.asked()) return false;
            visit(target, chains < kMostChains);
        }
        return chains < kMostChains;
    }

private:
    struct Frame {
        std::size_t portal;
        Index next, end;
        Winding source, pass;
        HalfSpaces reach;  // what a segment can meet after source and pass
    };

    static bool bit(const Bits::Word* words, std::size_t i) { return words[i / 64] >> i % 64 & 1; }
    Bits::Word* might(std::size_t depth) { return might_.data() + depth * words_; }

    // What the chain can still reach beyond the target; false when all of it is seen already.
    bool narrow(std::size_t target) {
        const Bits::Word* beyond = known_.done[target] ? known_.seen.row(target) : known_.might.row(target);
        Bits::Word news = 0;
        for (std::size_t w = 0; w < words_; ++w) {
            might(depth_)[w] = might(depth_ - 1)[w] & beyond[w];
            news |= might(depth_)[w] & ~row_[w];
        }
        return news != 0;
    }

    // Follows the chain to the target; without leave to go deeper, all that it can still reach counts as seen.
    void visit(std::size_t target, bool deeper) {
        if (might_.size() < (depth_ + 1) * words_) might_.resize((depth_ + 1) * words_);
        const bool more = narrow(target);
        if (!more && bit(row_, target)) return;
        const Frame& frame = frames_[depth_ - 1];
        const Portal& portal = portals_[target];
        Winding pass = portal.winding;
        if (!portals_[start_].cut_after(pass, precision_)) return;
        for (const HalfSpace& half : frame.reach)
            if (!clip(pass, half, precision_)) return;
        Winding source = frame.source;
        if (!portal.cut_before(source, precision_)) return;
        row_[target / 64] |= Bits::Word{1} << target % 64;
        if (more && deeper) {
            push(target, std::move(source), std::move(pass));
            if (!drop_unreached()) pop();
            return;
        }
        for (std::size_t w = 0; more && w < words_; ++w) row_[w] |= might(depth_)[w];
    }

    void push(std::size_t portal, Winding source, Winding pass) {
        if (frames_.size() == depth_) frames_.emplace_back();
        Frame& frame = frames_[depth_];
        const auto sector = static_cast<std::size_t>(portals_[portal].to);
        frame.portal = portal;
        frame.next = known_.portals.sector_start[sector], frame.end = known_.portals.sector_start[sector + 1];
        frame.source = std::move(source), frame.pass = std::move(pass);
        frame.reach.clear();
        if (depth_) separators(frame.source, frame.pass, precision_, frame.reach);
        on_chain_[portal] = 1;
        ++depth_;
    }

    // Takes from what the last frame might reach the unseen portals that lie outside; false when no unseen one is left.
    bool drop_unreached() {
        const Frame& frame = frames_[depth_ - 1];
        Bits::Word* own = might(depth_ - 1);
        bool more = false;
        for (std::size_t w = 0; w < words_; ++w)
            for (Bits::Word left = own[w] & ~row_[w]; left; left &= left - 1) {
                const auto bit = static_cast<std::size_t>(std::countr_zero(left));
                if (can_reach(frame, portals_[w * 64 + bit]))
                    more = true;
                else
                    own[w] &= ~(Bits::Word{1} << bit);
            }
        return more;
    }

    // Whether a segment can cross the frame's source, its pass, and some time later the portal: a part of the portal is
    // within reach, and source and pass each have a part before it. Both windings only shrink as the chain grows.
    bool can_reach(const Frame& frame, const Portal& portal) const {
        for (const HalfSpace& half : frame.reach)
            if (!touches(half, portal.box, precision_)) return false;
        return portal.may_be_before(frame.source) && portal.may_be_before(frame.pass);
    }

    void pop() {
        --depth_;
        on_chain_[frames_[depth_].portal] = 0;
    }

    const Known& known_;
    const std::vector<Portal>& portals_;
    const Precision precision_;
    const std::size_t words_, start_;
    Bits::Word* row_;
    Stop& stop_;
    std::vector<std::uint8_t> on_chain_;
    std::vector<Frame> frames_;  // the chain is the first `depth_`; the rest keep their memory
    std::size_t depth_ = 0;
    std::vector<Bits::Word> might_;  // a row for each depth
};

}  // namespace

std::vector<Bits::Word> Known::might_see(std::size_t p) const {
    std::vector<Bits::Word> out(might.row(p), might.row(p) + might.words());
    for (std::size_t q = 0; reversible[p] && q < portals.portals.size(); ++q) {
        if (!(out[q / 64] >> q % 64 & 1)) continue;
        const auto back = static_cast<std::size_t>(portals.portals[q].twin);
        if (done[back] && !seen.get(back, static_cast<std::size_t>(portals.portals[p].twin)))
            out[q / 64] &= ~(Bits::Word{1} << q % 64);
    }
    return out;
}

bool flow(const Known& known, std::size_t p, Bits::Word* row, Stop& stop) { return Flow(known, p, row, stop).run(); }

}  // namespace jk::vis
