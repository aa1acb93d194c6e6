// How a body's centre moves through the sectors: straight ways, and falls, through what lets bodies pass.
//
// Plain doubles. It is meant for points that lie clear of all edges by far more than a rounding (the ledges choose
// theirs so); native/geometry/ground.hpp answers for any point.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/mesh.hpp"

namespace jk {

using Point = std::array<double, 3>;

// In place of the sector behind a surface that bodies do not pass; jktools/geometry/drop.py says the same.
inline constexpr Index kFloorHere = -1, kSolidHere = -2, kNothingHere = -3;

enum class Below : std::uint8_t { kFloor, kSolid, kWater, kVoid };

struct Landed {
    Below below;
    Index met;     // the surface that the fall ends at; -1 for none
    Index sector;  // where it ends
    Point normal;  // of the triangle met, not of unit length, facing up
    Point corner;  // of that triangle
};

struct Moved {
    Index sector;   // where the way ends
    Index blocker;  // the surface that ends it too early; -1 for none
};

// A mesh made ready for strides; `passes_to` is the sector that a body comes into through each surface, or one of the
// three above.
class Strides {
public:
    // Throws std::invalid_argument naming the index when an array does not fit the mesh or leads out of it.
    Strides(SectorMesh mesh, std::span<const Index> passes_to, std::span<const std::uint8_t> under_water);

    // Goes straight; `visited` receives the sectors on the way, the first included.
    Moved go(Index sector, const Point& from, const Point& to, std::vector<Index>& visited) const;

    // Falls straight down.
    Landed fall(Index sector, const Point& from, std::vector<Index>& visited) const;

    const SectorMesh& mesh() const { return mesh_; }
    Index passes_to(Index surface) const { return passes_to_[static_cast<std::size_t>(surface)]; }
    Index sector_of(Index surface) const { return owner_[static_cast<std::size_t>(surface)]; }
    // Whether a body stands on it.
    bool carries(Index surface) const;

private:
    struct Triangle {
        Point corner, normal;         // the normal is of unit length and points into the sector
        std::array<Point, 3> inward;  // in its plane, of unit length, away from each side
        std::array<double, 3> side;   // of each side: inward . p is this on it
        Index surface;
    };

    void add_triangles(Index surface);

    SectorMesh mesh_;
    std::vector<Index> passes_to_, owner_, first_;
    std::vector<std::uint8_t> under_water_;
    std::vector<Triangle> triangles_;
};

}  // namespace jk
