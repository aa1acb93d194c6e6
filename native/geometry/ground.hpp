// Falls straight down through a level, in batches: all three tiers behind one call.
#pragma once

#include <span>
#include <vector>

#include "geometry/landing.hpp"
#include "geometry/sight.hpp"

namespace jk {

// What each fall ended at, as in Landing.
struct Drops {
    std::vector<std::uint8_t> ending;
    std::vector<Index> met, sector;
    std::vector<double> distance;
};

// The triangles of each sector that a falling body meets, in the order of their surfaces: sector i has
// [start[i], start[i + 1]) of `triangles`, which count Fans::triangles.
struct Upward {
    std::vector<Index> triangles, start;
};

// A mesh made ready for falls. Keeps no copy of the mesh and its fans, which must outlive it.
class Faller {
public:
    // Throws std::invalid_argument naming the index when an array does not fit the mesh or leads out of it.
    Faller(const SectorMesh& mesh, const Fans& fans, std::span<const Index> passes_to,
           std::span<const std::uint8_t> under_water);

    Faller(const Faller&) = delete;
    Faller& operator=(const Faller&) = delete;

    // Answers one fall a row: from points (x y z, JKU) in sectors, no deeper than `limits` (JKU; one a row). As for
    // Viewer::sight; limits must not be negative or not a number.
    Drops drop(std::span<const double> points, std::span<const Index> sectors, std::span<const double> limits,
               Tier tier, unsigned threads) const;

    // Bytes held, without the mesh.
    std::size_t memory() const;

private:
    Landing answer(const double* point, Index sector, double limit, Tier tier) const;

    const SectorMesh& mesh_;
    const Fans& fans_;
    std::vector<Index> passes_to_;
    std::vector<std::uint8_t> under_water_;
    Upward upward_;
};

}  // namespace jk
