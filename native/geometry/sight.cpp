#include "geometry/sight.hpp"

#include <stdexcept>

#include "geometry/checks.hpp"
#include "geometry/exact_sight.hpp"
#include "geometry/fast_walk.hpp"
#include "geometry/threads.hpp"

namespace jk {
Viewer::Viewer(SectorMesh mesh) : mesh_(std::move(mesh)), fans_(mesh_), rooms_(mesh_, fans_), locator_(mesh_, fans_) {}

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
    const Verdict found = tier == Tier::kFast ? fast_walk(mesh_, rooms_, sectors[row], segment)
                                              : walk(mesh_, fans_, rooms_, sectors[row], segment, doubts);
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
           rooms_.memory() + locator_.memory();
}

}  // namespace jk
