// Whether a sector holds a point, in plain doubles: not to be trusted near faces, edges and what is straight above them.
#pragma once

#include "geometry/crossing.hpp"

namespace jk {

enum class Place { kOutside, kOn, kInside };

// Counts the triangles [first, end) straight above the point, those that face up less those that face down: as many of
// each around a point outside. On the boundary where one passes through the point. Every sector counts as closed.
Place fast_place(const Fans& fans, Index first, Index end, const double* point);

}  // namespace jk
