#include "geometry/sight.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>

#include "geometry/checks.hpp"
#include "geometry/exact_sight.hpp"

namespace jk {
namespace {

// Rows that a thread takes at a time: enough to hide the taking, few enough to share out a small batch.
constexpr std::size_t kChunk = 512;

template <typename Work>
void share_out(std::size_t rows, unsigned threads, const Work& work) {
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
    threads = static_cast<unsigned>(std::min<std::size_t>(threads, (rows + kChunk - 1) / kChunk));
    std::atomic<std::size_t> next{0};
    const auto run = [&] {
        for (std::size_t first; (first = next.fetch_add(kChunk)) < rows;)
            for (std::size_t row = first; row < std::min(rows, first + kChunk); ++row) work(row);
    };
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < threads; ++i) others.emplace_back(run);
    run();
}

}  // namespace

Viewer::Viewer(SectorMesh mesh) : mesh_(std::move(mesh)), fans_(mesh_), rooms_(mesh_, fans_) {}

void Viewer::check(std::span<const double> origins, std::span<const Index> sectors,
                   std::span<const double> targets) const {
    check_coordinates("origin", origins);
    check_coordinates("target", targets);
    if (origins.size() != 3 * sectors.size() || targets.size() != origins.size())
        throw std::invalid_argument("origins and targets must have shape (n, 3), sectors (n,)");
    check_indices("sector of origin", sectors, mesh_.sectors());
}

Sight Viewer::sight(std::span<const double> origins, std::span<const Index> sectors, std::span<const double> targets,
                    Tier tier, unsigned threads) const {
    check(origins, sectors, targets);
    Sight out{std::vector<std::uint8_t>(sectors.size()), std::vector<Index>(sectors.size()),
              std::vector<Index>(sectors.size())};
    share_out(sectors.size(), threads,
              [&](std::size_t row) { answer(row, origins, sectors, targets, tier, out); });
    return out;
}

void Viewer::answer(std::size_t row, std::span<const double> origins, std::span<const Index> sectors,
                    std::span<const double> targets, Tier tier, Sight& out) const {
    const Segment segment{origins.data() + 3 * row, targets.data() + 3 * row};
    if (tier == Tier::kExact) {
        const ExactVerdict found = exact_sight(mesh_, sectors[row], segment.a, segment.b);
        out.visible[row] = found.visible, out.crossed[row] = found.crossed, out.blocker[row] = found.blocker;
        return;
    }
    Doubts doubts;
    const Verdict found = walk(mesh_, fans_, rooms_, sectors[row], segment, doubts);
    out.visible[row] = found.visible, out.crossed[row] = found.crossed, out.blocker[row] = found.blocker;
}

Verdict Viewer::explain(std::span<const double> origin, Index sector, std::span<const double> target,
                        std::vector<Step>& path) const {
    check(origin, {&sector, 1}, target);
    return search(mesh_, fans_, nullptr, sector, {origin.data(), target.data()}, &path);
}

Doubts Viewer::doubts(std::span<const double> origins, std::span<const Index> sectors,
                      std::span<const double> targets) const {
    check(origins, sectors, targets);
    Doubts doubts;
    for (std::size_t row = 0; row < sectors.size(); ++row)
        walk(mesh_, fans_, rooms_, sectors[row], {origins.data() + 3 * row, targets.data() + 3 * row}, doubts);
    return doubts;
}

std::size_t Viewer::memory() const {
    const auto bytes = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
    return bytes(mesh_.positions) + bytes(mesh_.surface_start) + bytes(mesh_.surface_vertex) + bytes(mesh_.leads_to) +
           bytes(mesh_.sector_first) + bytes(mesh_.sector_count) + bytes(fans_.triangles) + bytes(fans_.start) +
           rooms_.memory();
}

}  // namespace jk
