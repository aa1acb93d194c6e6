#include "geometry/ground.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/checks.hpp"
#include "geometry/exact_fall.hpp"
#include "geometry/fall.hpp"
#include "geometry/fast_fall.hpp"
#include "geometry/plumb.hpp"
#include "geometry/threads.hpp"

namespace jk {
namespace {

Upward upward_triangles(const SectorMesh& mesh, const Fans& fans, std::span<const Index> passes_to) {
    Upward out;
    out.start.push_back(0);
    for (std::size_t s = 0; s < mesh.sectors(); ++s) {
        const auto first = static_cast<std::size_t>(mesh.sector_first[s]);
        const auto end = first + static_cast<std::size_t>(mesh.sector_count[s]);
        for (Index t = fans.start[first]; t < fans.start[end]; ++t) {
            const Fans::Triangle& k = fans.triangles[static_cast<std::size_t>(t)];
            if (passes_to[static_cast<std::size_t>(k.surface)] == kAbsent || turn(k.a, k.b, k.c) <= 0) continue;
            out.triangles.push_back(t);
        }
        out.start.push_back(static_cast<Index>(out.triangles.size()));
    }
    out.triangles.shrink_to_fit();
    return out;
}

void check_limits(std::span<const double> limits) {
    for (std::size_t i = 0; i < limits.size(); ++i)
        if (!(limits[i] >= 0))
            throw std::invalid_argument("max_distance " + std::to_string(i) + " is negative or not a number");
}

}  // namespace

Faller::Faller(const SectorMesh& mesh, const Fans& fans, std::span<const Index> passes_to,
               std::span<const std::uint8_t> under_water)
    : mesh_(mesh), fans_(fans), passes_to_(passes_to.begin(), passes_to.end()),
      under_water_(under_water.begin(), under_water.end()) {
    if (passes_to.size() != mesh.surfaces()) throw std::invalid_argument("passes_to must have one entry a surface");
    if (under_water.size() != mesh.sectors()) throw std::invalid_argument("under_water must have one entry a sector");
    for (std::size_t i = 0; i < passes_to.size(); ++i)
        if (passes_to[i] < kAbsent || passes_to[i] >= static_cast<Index>(mesh.sectors()))
            refuse("passes_to", i, passes_to[i]);
    upward_ = upward_triangles(mesh, fans, passes_to);
}

Drops Faller::drop(std::span<const double> points, std::span<const Index> sectors, std::span<const double> limits,
                   Tier tier, unsigned threads) const {
    check_coordinates("point", points);
    if (points.size() != 3 * sectors.size() || limits.size() != sectors.size())
        throw std::invalid_argument("points must have shape (n, 3), sectors and max_distance (n,)");
    check_indices("sector of point", sectors, mesh_.sectors());
    check_limits(limits);
    const std::size_t rows = sectors.size();
    Drops out{std::vector<std::uint8_t>(rows), std::vector<Index>(rows), std::vector<Index>(rows),
              std::vector<double>(rows)};
    share_out(rows, threads, [&](std::size_t row) {
        const Landing found = answer(points.data() + 3 * row, sectors[row], limits[row], tier);
        out.ending[row] = static_cast<std::uint8_t>(found.ending);
        out.met[row] = found.met, out.sector[row] = found.sector, out.distance[row] = found.distance;
    });
    return out;
}

Landing Faller::answer(const double* point, Index sector, double limit, Tier tier) const {
    const Ground ground{mesh_, passes_to_, under_water_};
    if (tier == Tier::kExact) return exact_fall(ground, sector, point, limit);
    return (tier == Tier::kFast ? fast_fall : fall)(ground, fans_, upward_, sector, point, limit);
}

std::size_t Faller::memory() const {
    return sizeof(Index) * (passes_to_.capacity() + upward_.triangles.capacity() + upward_.start.capacity()) +
           under_water_.capacity();
}

}  // namespace jk
