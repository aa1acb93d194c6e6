// Floors that a body can come down to and whose every way out goes up, as the compiler found them.
#pragma once

#include <cstdint>
#include <optional>

#include "mesh.hpp"

namespace jklb {

struct Basin {
    Index body;
    Index first, count;         // its floors: BasinsOf::floor(first), ... of as many
    float shallowest, deepest;  // the least and the greatest height of the edges that lead in, JKU
    std::uint8_t entered;       // 0x1 walk, 0x2 fall, 0x4 jump, 0x8 a player starts there
    std::uint8_t left;          // 0x1 walk, 0x2 jump, 0x4 mover, 0x8 water, 0x10 deadly, 0x20 unknown; 0 inescapable
};

// The basins of a level, for each of its bodies. Nothing is allocated by any question.
class BasinsOf {
public:
    explicit BasinsOf(const Level& level) {
        if (level.sections().basins) basins_ = *level.sections().basins;
    }

    // How many there are, of all bodies, in the order of the bodies.
    Index size() const { return static_cast<Index>(basins_.body.rows()); }

    Basin operator[](Index i) const {
        const auto row = static_cast<std::size_t>(i);
        const auto first = static_cast<Index>(basins_.surface_start(row));
        const auto end = static_cast<Index>(basins_.surface_start(row + 1));
        return {basins_.body(row), first, end - first, basins_.shallowest(row), basins_.deepest(row), basins_.entered(row),
                basins_.left(row)};
    }

    // The surface that is a floor of a basin.
    Index floor(Index i) const { return basins_.surface(static_cast<std::size_t>(i)); }

    // The basin of a body that holds a surface. Looks at all floors of its basins.
    std::optional<Basin> at(Index body, Index surface) const {
        for (Index i = 0; i < size(); ++i) {
            if (basins_.body(static_cast<std::size_t>(i)) != body) continue;
            const Basin basin = (*this)[i];
            for (Index k = basin.first; k < basin.first + basin.count; ++k)
                if (floor(k) == surface) return basin;
        }
        return std::nullopt;
    }

private:
    Basins basins_;
};

}  // namespace jklb
