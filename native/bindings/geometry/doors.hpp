// The topics of the geometry module, each bound in a file of its own.
#pragma once

#include <nanobind/nanobind.h>

namespace jk {

void open_ledges(nanobind::module_& m);
void open_drop(nanobind::module_& m);
void open_sight(nanobind::module_& m);
void open_soundness(nanobind::module_& m);
void open_visibility(nanobind::module_& m);

}  // namespace jk
