// The names of the tiers.
#pragma once

#include <stdexcept>
#include <string>

#include "geometry/sight.hpp"

namespace jk {

inline Tier tier_of(const std::string& name) {
    if (name == "fast") return Tier::kFast;
    if (name == "balanced") return Tier::kBalanced;
    if (name == "exact") return Tier::kExact;
    throw std::invalid_argument("accuracy must be fast, balanced or exact, not " + name);
}

}  // namespace jk
