// What the compiler found out about a level: which sectors can be seen from which, and where bodies walk and fall.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "mesh.hpp"

namespace jklb {

// Which sectors can be seen from which, walls only, with what COGs may open counted as open. What it denies is certain.
// Of a file without that section, or a sector without a row, nothing is denied.
class VisibleSectors {
public:
    explicit VisibleSectors(const Level& level) : row_of_(level.geometry().sector_flags.rows(), -1) {
        if (!level.sections().visibility) return;
        rows_ = *level.sections().visibility;
        for (std::size_t i = 0; i < rows_.sector.rows(); ++i)
            row_of_[static_cast<std::size_t>(rows_.sector(i))] = static_cast<Index>(i);
    }

    // Whether a segment from the one sector may enter the other. Nothing is seen from or in a sector that does not exist.
    bool operator()(Index from, Index to) const {
        const auto count = static_cast<Index>(row_of_.size());
        if (from < 0 || from >= count || to < 0 || to >= count) return false;
        const Index row = row_of_[static_cast<std::size_t>(from)];
        if (row < 0) return true;
        const std::size_t start = rows_.row_start(static_cast<std::size_t>(row));
        std::size_t left = static_cast<std::size_t>(to) / 8;
        for (std::size_t i = start;; ++i) {
            const unsigned bits = rows_.row(i);
            if (bits == 0) {
                const std::size_t zeros = rows_.row(++i);
                if (left < zeros) return false;
                left -= zeros;
            } else if (left-- == 0) {
                return bits >> to % 8 & 1;
            }
        }
    }

private:
    Visibility rows_;
    std::vector<Index> row_of_;
};

// What a body comes onto beyond an edge; grammars/level.fbs tells more of each.
enum class LedgeKind : std::uint8_t { kLevel, kSeamless, kFall, kWater, kNone, kStep, kLip, kJump, kWall, kUnknown };

struct Ledge {
    float start, end;             // 0 .. 1 along the edge
    LedgeKind kind, other_kind;   // by the file's engine profile, and by the other
    Index below, thing;           // the surface come onto, or that blocks; the thing that makes it unknown; or -1
    float drop_start, drop_end;   // from the edge down, JKU; NaN for none
    std::uint8_t traits;          // 0x1 narrower than the body, 0x2 the engine's AI stops
    Index onto, onto_face;        // the thing come onto, or that blocks, and the face of its model; or -1
};

// The edges of floors, for each body of the file. An edge of a floor, or a part of one, that has no ledge goes on level.
// The edges of things (lifts, bridges) are in the columns alone: the first rows of each body, with surface -1.
class LedgesOf {
public:
    explicit LedgesOf(const Level& level) {
        if (level.sections().ledges) ledges_ = *level.sections().ledges;
    }

    // How many bodies there are; their figures and names are columns of Level::sections().ledges.
    Index bodies() const { return static_cast<Index>(ledges_.body_movesize.rows()); }

    // Whether it is known how high a body floats: of one that it is not, the file has neither ledges nor basins, which
    // says nothing about its edges.
    bool known(Index body) const {
        return body >= 0 && body < bodies() && !std::isnan(ledges_.body_hover(static_cast<std::size_t>(body)));
    }

    // The ledges of the edge that goes from a corner of a floor to the next one, along the edge.
    std::vector<Ledge> at(Index body, Index surface, Index corner) const {
        std::vector<Ledge> found;
        if (body < 0 || body >= bodies()) return found;
        std::size_t low = ledges_.body_ledge_start(static_cast<std::size_t>(body));
        const std::size_t end = ledges_.body_ledge_start(static_cast<std::size_t>(body) + 1);
        for (std::size_t high = end; low < high;) {
            const std::size_t middle = low + (high - low) / 2;
            if (before(middle, surface, corner)) low = middle + 1;
            else high = middle;
        }
        for (; low < end && ledges_.surface(low) == surface && ledges_.corner(low) == corner; ++low)
            found.push_back(ledge(low));
        return found;
    }

    // The first of them that holds a place of the edge, 0 .. 1 along it.
    std::optional<Ledge> at(Index body, Index surface, Index corner, double place) const {
        for (const Ledge& each : at(body, surface, corner))
            if (each.start <= place && place <= each.end) return each;
        return std::nullopt;
    }

private:
    bool before(std::size_t row, Index surface, Index corner) const {
        const Index own = ledges_.surface(row);
        return own < surface || (own == surface && ledges_.corner(row) < corner);
    }

    Ledge ledge(std::size_t row) const {
        return {ledges_.start(row), ledges_.end(row), static_cast<LedgeKind>(ledges_.kind(row)),
                static_cast<LedgeKind>(ledges_.other_kind(row)), ledges_.below(row), ledges_.thing(row),
                ledges_.drop_start(row), ledges_.drop_end(row), ledges_.traits(row),
                since(ledges_.onto, row), since(ledges_.onto_face, row)};
    }

    // Of a column that files of format 1.0 and 1.1 do not have.
    static Index since(const Column<std::int32_t>& column, std::size_t row) {
        return row < column.rows() ? column(row) : -1;
    }

    Ledges ledges_;
};

// Floors that a body can come down to and whose every way out goes up.
struct Basin {
    Index body;
    std::vector<Index> surfaces;
    float shallowest, deepest;     // the least and the greatest height of the edges that lead in, JKU
    std::uint8_t entered;          // 0x1 walk, 0x2 fall, 0x4 jump, 0x8 a player starts there
    std::uint8_t left;             // 0x1 walk, 0x2 jump, 0x4 mover, 0x8 water, 0x10 deadly, 0x20 unknown; 0 inescapable
};

inline std::vector<Basin> basins(const Level& level, Index body) {
    std::vector<Basin> found;
    if (!level.sections().basins) return found;
    const Basins& b = *level.sections().basins;
    for (std::size_t i = 0; i < b.body.rows(); ++i) {
        if (b.body(i) != body) continue;
        found.push_back({body, {}, b.shallowest(i), b.deepest(i), b.entered(i), b.left(i)});
        for (std::size_t k = b.surface_start(i); k < b.surface_start(i + 1); ++k)
            found.back().surfaces.push_back(b.surface(k));
    }
    return found;
}

}  // namespace jklb
