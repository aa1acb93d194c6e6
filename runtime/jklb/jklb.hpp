// Reads compiled levels (.jklb) of jktools and answers questions about them: see README.md.
#pragma once

#include "basins.hpp"
#include "drop.hpp"
#include "ledges.hpp"
#include "level.hpp"
#include "locate.hpp"
#include "mesh.hpp"
#include "sight.hpp"
#include "templates.hpp"
#include "visible.hpp"
