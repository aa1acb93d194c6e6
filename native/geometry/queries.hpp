// A batch of sight queries and its answers, a row each.
#pragma once

#include <span>
#include <vector>

#include "geometry/crossing.hpp"
#include "geometry/search.hpp"

namespace jk {

// From origins (x y z, JKU) in sectors to targets, and the sectors that the targets lie in where those matter: -1 for
// one that lies in none, empty when no query aims at a sector.
struct Queries {
    std::span<const double> origins;
    std::span<const Index> sectors;
    std::span<const double> targets;
    std::span<const Index> aims{};

    std::size_t rows() const { return sectors.size(); }
    Segment segment(std::size_t row) const { return {origins.data() + 3 * row, targets.data() + 3 * row}; }
    Index aim(std::size_t row) const { return aims.empty() ? kNoAim : aims[row]; }
};

// Which sectors are potentially visible from which: (sectors, bytes), bit b % 8 of byte b / 8 of row a. Empty: all.
struct VisibleRows {
    std::span<const std::uint8_t> rows{};
    std::size_t bytes = 0;

    bool holds(Index a, Index b) const {
        if (rows.empty()) return true;
        return rows[static_cast<std::size_t>(a) * bytes + static_cast<std::size_t>(b) / 8] >> b % 8 & 1;
    }
};

struct Sight {
    explicit Sight(std::size_t rows) : visible(rows), crossed(rows), blocker(rows) {}

    void tell(std::size_t row, const Verdict& found) {
        visible[row] = found.visible && found.reached, crossed[row] = found.crossed, blocker[row] = found.blocker;
    }

    std::vector<std::uint8_t> visible;
    std::vector<Index> crossed, blocker;  // as in Verdict
};

}  // namespace jk
