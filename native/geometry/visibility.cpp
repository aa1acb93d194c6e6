#include "geometry/visibility.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "geometry/checks.hpp"
#include "geometry/exact_visibility.hpp"
#include "geometry/visibility_flow.hpp"

namespace jk {
namespace {

using vis::Bits;

// Portals that are worked on together: each knows what was finished before its batch, whichever thread did it.
constexpr std::size_t kBatch = 8;

// Shares rows out as they come free; the calling thread alone is watched.
class Crew {
public:
    Crew(unsigned threads, const Watch& watch, std::size_t all)
        : threads_(threads ? threads : std::max(1u, std::thread::hardware_concurrency())), watch_(watch), all_(all) {}

    // False when the work was stopped.
    template <typename Work>
    bool run(std::size_t rows, const Work& work) {
        std::atomic<std::size_t> next{0};
        const auto take = [&](vis::Stop& stop) {
            for (std::size_t row; !stopped_ && (row = next.fetch_add(1)) < rows;) {
                work(row, stop);
                ++done_;
                stop.asked();
            }
        };
        std::vector<std::jthread> others;
        for (unsigned i = 1; i < std::min<std::size_t>(threads_, rows); ++i)
            others.emplace_back([&] {
                Other other(*this);
                take(other);
            });
        Watched own(*this);
        take(own);
        others.clear();
        return !stopped_;
    }

private:
    struct Other : vis::Stop {
        explicit Other(Crew& crew) : crew_(crew) {}
        bool asked() override { return crew_.stopped_; }
        Crew& crew_;
    };
    struct Watched : Other {
        using Other::Other;
        bool asked() override {
            if (crew_.watch_ && !crew_.stopped_ && !crew_.watch_(crew_.done_, crew_.all_)) crew_.stopped_ = true;
            return crew_.stopped_;
        }
    };

    const unsigned threads_;
    const Watch& watch_;
    const std::size_t all_;
    std::atomic<std::size_t> done_{0};
    std::atomic<bool> stopped_{false};
};

// Few first: what they see is known when those that see much are worked on.
std::vector<std::size_t> by_size(const Bits& might, std::size_t portals) {
    std::vector<std::size_t> order(portals), size(portals);
    for (std::size_t p = 0; p < portals; ++p) size[p] = might.count(p);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) { return size[p] < size[q]; });
    return order;
}

// The portals that have a twin, as have all that can follow them: every chain from them can be gone backwards.
std::vector<std::uint8_t> reversible_ones(const vis::Portals& portals, const Bits& follow) {
    const std::size_t count = portals.portals.size();
    std::vector<std::uint8_t> out(count);
    for (std::size_t p = 0; p < count; ++p) {
        out[p] = portals.portals[p].twin >= 0;
        for (std::size_t q = 0; out[p] && q < count; ++q) out[p] = portals.portals[q].twin >= 0 || !follow.get(p, q);
    }
    return out;
}

// Keeps what is seen both ways: a segment that crosses p and then q crosses their twins the other way.
void keep_mutual(const vis::Portals& portals, const std::vector<std::uint8_t>& reversible, Bits& seen) {
    const Bits before = seen;
    for (std::size_t p = 0; p < portals.portals.size(); ++p)
        for (std::size_t q = 0; reversible[p] && q < portals.portals.size(); ++q)
            if (before.get(p, q) && !before.get(static_cast<std::size_t>(portals.portals[q].twin),
                                                static_cast<std::size_t>(portals.portals[p].twin)))
                seen.clear(p, q);
}

using Flow = bool (*)(const vis::Known&, std::size_t, Bits::Word*, vis::Stop&);

// Replaces what each portal sees by what the flow leaves of it, and counts the portals whose chains were cut short.
// False when the work was stopped.
bool tighten(const vis::Portals& portals, const std::vector<std::uint8_t>& reversible, Flow flow, Crew& crew, Bits& seen, std::size_t& cut_short) {
    const std::size_t count = portals.portals.size();
    const Bits might = seen;
    seen = Bits(count, count);
    std::vector<std::uint8_t> done(count);
    const std::vector<std::size_t> order = by_size(might, count);
    std::atomic<std::size_t> short_ones{0};
    const vis::Known known{portals, might, seen, done, reversible};
    for (std::size_t first = 0; first < count; first += kBatch) {
        const std::size_t end = std::min(count, first + kBatch);
        const bool finished = crew.run(end - first, [&](std::size_t i, vis::Stop& stop) {
            if (!flow(known, order[first + i], seen.row(order[first + i]), stop)) ++short_ones;
        });
        if (!finished) return false;
        for (std::size_t i = first; i < end; ++i) done[order[i]] = 1;
    }
    keep_mutual(portals, reversible, seen);
    cut_short = short_ones;
    return true;
}

Visibility by_sector(const vis::Portals& portals, const Bits& seen) {
    const std::size_t sectors = portals.sector_start.size() - 1, bytes = (sectors + 7) / 8;
    Visibility out{std::vector<std::uint8_t>(sectors * bytes), portals.portals.size()};
    const auto set = [&](std::size_t a, Index b) {
        out.rows[a * bytes + static_cast<std::size_t>(b) / 8] |= static_cast<std::uint8_t>(1u << b % 8);
    };
    for (std::size_t a = 0; a < sectors; ++a) {
        set(a, static_cast<Index>(a));
        for (auto p = static_cast<std::size_t>(portals.sector_start[a]);
             p < static_cast<std::size_t>(portals.sector_start[a + 1]); ++p) {
            set(a, portals.portals[p].to);
            for (std::size_t q = 0; q < portals.portals.size(); ++q)
                if (seen.get(p, q)) set(a, portals.portals[q].to);
        }
    }
    return out;
}

}  // namespace

Visibility visibility(const Viewer& viewer, std::span<const Index> leads_to, Tier tier, unsigned threads,
                      const Watch& watch) {
    const SectorMesh& mesh = viewer.mesh();
    if (leads_to.size() != mesh.surfaces()) throw std::invalid_argument("leads_to must have one entry a surface");
    for (std::size_t s = 0; s < leads_to.size(); ++s)
        if (leads_to[s] < kBlocks || leads_to[s] >= static_cast<Index>(mesh.sectors())) refuse("leads_to", s, leads_to[s]);
    const vis::Portals portals(mesh, viewer.fans(), leads_to);
    const std::size_t count = portals.portals.size();
    Crew crew(threads, watch, count * (1 + static_cast<std::size_t>(tier)));
    Bits seen(count, count);
    if (!crew.run(count, [&](std::size_t p, vis::Stop&) { portals.flood(p, seen); })) return {};
    const std::vector<std::uint8_t> reversible = reversible_ones(portals, seen);
    keep_mutual(portals, reversible, seen);
    std::size_t cut_short = 0;
    // Each tier starts from what the one before it leaves.
    if (tier != Tier::kFast && !tighten(portals, reversible, vis::flow, crew, seen, cut_short)) return {};
    if (tier == Tier::kExact && !tighten(portals, reversible, exact_flow, crew, seen, cut_short)) return {};
    Visibility out = by_sector(portals, seen);
    out.cut_short = cut_short;
    return out;
}

}  // namespace jk
