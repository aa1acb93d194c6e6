// Which sectors are convex, and which points lie outside theirs, decided by exact predicates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace jk {

// A level's polygons, flat. Surface i has the vertices surface_vertex[surface_start[i] .. surface_start[i + 1]),
// counter-clockwise seen from inside its sector. Sector i owns the surfaces
// [sector_first[i], sector_first[i] + sector_count[i]) and lists the vertices
// sector_vertex[sector_start[i] .. sector_start[i + 1]).
struct SectorPolygons {
    std::span<const double> positions;  // x y z of each vertex, JKU
    std::span<const std::int32_t> surface_start, surface_vertex;
    std::span<const std::int32_t> sector_first, sector_count;
    std::span<const std::int32_t> sector_start, sector_vertex;
};

// Per sector: how many (surface, vertex) pairs have the vertex strictly behind the surface, and the pair that is
// farthest behind, with its distance in JKU. surface and vertex are -1 and distance 0 for a convex sector.
struct Convexity {
    std::vector<std::int32_t> behind, surface, vertex;
    std::vector<double> distance;
};

// Per point: the surface of its sector that it is farthest behind, with the distance in JKU; -1 and 0 for a point
// that is strictly behind none.
struct Outside {
    std::vector<std::int32_t> surface;
    std::vector<double> distance;
};

// Tests every vertex of each sector against the plane of each of its surfaces. The side is exact (orientation of
// four points with the coordinates as given); the distance is its rounded measure.
//
// In all functions a surface's plane is that of the widest triangle of its vertices that is wound like the whole polygon, so that
// a slightly bent surface is judged by its best-conditioned plane. A surface without such a triangle (all
// vertices on one line) has no plane and is passed over.
//
// Throws std::invalid_argument naming the index when a range or a vertex index is out of bounds or a position is
// not finite.
Convexity sector_convexity(const SectorPolygons& level);

// Tests each point (x y z, JKU) against the surfaces of its sector. Throws as above, and when a sector index is out
// of bounds.
Outside points_outside(const SectorPolygons& level, std::span<const double> points,
                       std::span<const std::int32_t> sectors);

}  // namespace jk
