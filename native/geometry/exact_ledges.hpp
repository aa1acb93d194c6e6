// The oracle of ledges: the places where the answer can change in exact constructions, and what lies between them by
// sight and drop, which are exact (sight.hpp, ground.hpp). Written apart from ledges.cpp and stride.cpp, which use
// neither; they share the definition and the level.
#pragma once

#include "geometry/ledges.hpp"

namespace jk {

// As find_ledges; seconds for a large level.
Ledges find_exact_ledges(const Strides& strides, const Edges& edges, std::span<const std::uint8_t> active,
                         const Gait& gait, unsigned threads);

}  // namespace jk
