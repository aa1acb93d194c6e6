// A batch of sight queries and its answers, a row each.
#pragma once

#include <span>
#include <vector>

#include "geometry/crossing.hpp"
#include "geometry/search.hpp"

namespace jk {

// From origins (x y z, JKU) in sectors to targets.
struct Queries {
    std::span<const double> origins;
    std::span<const Index> sectors;
    std::span<const double> targets;

    std::size_t rows() const { return sectors.size(); }
    Segment segment(std::size_t row) const { return {origins.data() + 3 * row, targets.data() + 3 * row}; }
};

struct Sight {
    explicit Sight(std::size_t rows) : visible(rows), crossed(rows), blocker(rows) {}

    void tell(std::size_t row, const Verdict& found) {
        visible[row] = found.visible, crossed[row] = found.crossed, blocker[row] = found.blocker;
    }

    std::vector<std::uint8_t> visible;
    std::vector<Index> crossed, blocker;  // as in Verdict
};

}  // namespace jk
