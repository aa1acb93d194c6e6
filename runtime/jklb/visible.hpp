// Which sectors can be seen from which, as the compiler found it.
#pragma once

#include <cstddef>
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

}  // namespace jklb
