#include "geometry/sight.hpp"

#include <stdexcept>

#include "geometry/checks.hpp"
#include "geometry/exact_locate.hpp"
#include "geometry/exact_sight.hpp"
#include "geometry/fast_walk.hpp"
#include "geometry/threads.hpp"
#include "geometry/waves.hpp"

namespace jk {
Viewer::Viewer(SectorMesh mesh) : mesh_(std::move(mesh)), fans_(mesh_), rooms_(mesh_, fans_), locator_(mesh_, fans_) {}

void Viewer::check(const Queries& queries) const {
    check_coordinates("origin", queries.origins);
    check_coordinates("target", queries.targets);
    if (queries.origins.size() != 3 * queries.rows() || queries.targets.size() != queries.origins.size())
        throw std::invalid_argument("origins and targets must have shape (n, 3), sectors (n,)");
    check_indices("sector of origin", queries.sectors, mesh_.sectors());
}

Location Viewer::locate(std::span<const double> points, Tier tier, unsigned threads) const {
    check_coordinates("point", points);
    if (tier != Tier::kExact) return locator_.locate(points, tier == Tier::kFast, threads);
    const ExactLocator oracle(mesh_);
    const std::size_t rows = points.size() / 3;
    Location out{std::vector<Index>(rows), std::vector<Index>(rows), std::vector<Index>(rows)};
    share_out(rows, threads, [&](std::size_t row) {
        const ExactLocation found = oracle.locate(&points[3 * row]);
        out.sector[row] = found.sector, out.inside[row] = found.inside, out.touching[row] = found.touching;
    });
    return out;
}

Sight Viewer::sight(const Queries& queries, Tier tier, unsigned threads) const {
    check(queries);
    Sight out(queries.rows());
    if (tier == Tier::kBalanced) {
        share_out_ranges(queries.rows(), kWave, threads, [&](std::size_t first, std::size_t end) {
            walk_waves(mesh_, fans_, rooms_, queries, {}, first, end, out);
        });
        return out;
    }
    share_out(queries.rows(), threads, [&](std::size_t row) {
        const Segment segment = queries.segment(row);
        if (tier == Tier::kFast) return out.tell(row, fast_walk(mesh_, rooms_, queries.sectors[row], segment));
        const ExactVerdict found = exact_sight(mesh_, queries.sectors[row], segment.a, segment.b);
        out.tell(row, {found.visible, found.crossed, found.blocker});
    });
    return out;
}

std::vector<std::uint8_t> Viewer::sees(const Queries& queries, const VisibleRows& known, unsigned threads) const {
    check(queries);
    if (queries.aims.size() != queries.rows()) throw std::invalid_argument("target_sectors must have shape (n,)");
    for (std::size_t row = 0; row < queries.rows(); ++row)
        if (queries.aims[row] < -1 || queries.aims[row] >= static_cast<Index>(mesh_.sectors()))
            refuse("sector of target", row, queries.aims[row]);
    if (!known.rows.empty() &&
        (known.bytes != (mesh_.sectors() + 7) / 8 || known.rows.size() != mesh_.sectors() * known.bytes))
        throw std::invalid_argument("the visible sectors are not those of this mesh");
    Sight out(queries.rows());
    share_out_ranges(queries.rows(), kWave, threads, [&](std::size_t first, std::size_t end) {
        walk_waves(mesh_, fans_, rooms_, queries, known, first, end, out);
    });
    return std::move(out.visible);
}

Verdict Viewer::explain(std::span<const double> origin, Index sector, std::span<const double> target,
                        std::vector<Step>& path) const {
    check({origin, {&sector, 1}, target});
    return search(mesh_, fans_, nullptr, sector, {origin.data(), target.data()}, &path);
}

Doubts Viewer::doubts(const Queries& queries) const {
    check(queries);
    Doubts doubts;
    for (std::size_t row = 0; row < queries.rows(); ++row)
        walk(mesh_, fans_, rooms_, queries.sectors[row], queries.segment(row), doubts);
    return doubts;
}

std::size_t Viewer::memory() const {
    const auto bytes = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
    return bytes(mesh_.positions) + bytes(mesh_.surface_start) + bytes(mesh_.surface_vertex) + bytes(mesh_.leads_to) +
           bytes(mesh_.sector_first) + bytes(mesh_.sector_count) + bytes(fans_.triangles) + bytes(fans_.start) +
           rooms_.memory() + locator_.memory();
}

}  // namespace jk
