// The fast tier of drop: plain doubles, no bounds, one way only.
#pragma once

#include "geometry/ground.hpp"

namespace jk {

Landing fast_fall(const Ground& ground, const Fans& fans, const Upward& upward, Index sector, const double* point,
                  double limit);

}  // namespace jk
