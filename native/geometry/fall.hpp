// The balanced tier of drop: bounds in doubles, exact arithmetic where they leave a doubt.
#pragma once

#include "geometry/ground.hpp"

namespace jk {

Landing fall(const Ground& ground, const Fans& fans, const Upward& upward, Index sector, const double* point,
             double limit);

}  // namespace jk
