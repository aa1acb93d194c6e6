// How a body's centre moves through the sectors and past the things that carry bodies: straight ways, and falls.
//
// Plain doubles. It is meant for points that lie clear of all edges by far more than a rounding (the ledges choose
// theirs so); native/geometry/ground.hpp answers for any point.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/boxes.hpp"
#include "geometry/locate.hpp"
#include "geometry/mesh.hpp"

namespace jk {

using Point = std::array<double, 3>;

// In place of the sector behind a surface that bodies do not pass; jktools/geometry/drop.py says the same.
inline constexpr Index kFloorHere = -1, kSolidHere = -2, kNothingHere = -3;

enum class Below : std::uint8_t { kFloor, kSolid, kWater, kVoid };

// The faces of things, counter-clockwise seen from outside; face i has the corners
// face_vertex[face_start[i] .. face_start[i + 1]) and belongs to solid face_solid[i].
struct Solids {
    std::vector<double> positions;
    std::vector<Index> face_start{0}, face_vertex, face_solid;
    std::vector<std::uint8_t> face_carries;  // whether bodies stand on it

    std::size_t faces() const { return face_solid.size(); }
    const double* vertex(Index i) const { return positions.data() + 3 * static_cast<std::size_t>(i); }
};

struct Landed {
    Below below;
    Index met;     // the surface that the fall ends at; -1 for none
    Index face;    // the face of a solid that it ends at; -1 for none
    Index sector;  // where it ends, or would end without the solids
    Point normal;  // of the triangle met, not of unit length, facing up
    Point corner;  // of that triangle
};

struct Moved {
    Index sector;   // where the way ends; where it began, if a solid ends it
    Index blocker;  // the surface that ends it too early; -1 for none
    Index face;     // the face of a solid that does; -1 for none

    bool blocked() const { return blocker >= 0 || face >= 0; }
};

// A mesh made ready for strides; `passes_to` is the sector that a body comes into through each surface, or one of the
// three above.
class Strides {
public:
    struct Triangle {
        Point corner, normal;         // the normal is of unit length and points to where bodies are
        std::array<Point, 3> inward;  // in its plane, of unit length, away from each side
        std::array<double, 3> side;   // of each side: inward . p is this on it
        std::array<Point, 3> corners;
        Index surface;  // or the face, for a solid's
    };

    // Throws std::invalid_argument naming the index when an array does not fit the mesh or leads out of it.
    Strides(SectorMesh mesh, std::span<const Index> passes_to, std::span<const std::uint8_t> under_water,
            Solids solids);

    Strides(const Strides&) = delete;  // its parts refer to each other
    Strides& operator=(const Strides&) = delete;

    const SectorMesh& mesh() const { return mesh_; }
    const Solids& solids() const { return solids_; }
    const Locator& locator() const { return locator_; }
    std::span<const std::uint8_t> under_water() const { return under_water_; }
    const Box& box(Index sector) const { return sector_boxes_[static_cast<std::size_t>(sector)]; }
    Index passes_to(Index surface) const { return passes_to_[static_cast<std::size_t>(surface)]; }
    Index sector_of(Index surface) const { return owner_[static_cast<std::size_t>(surface)]; }
    // Whether a body stands on it.
    bool carries(Index surface) const;

private:
    friend class Surroundings;

    void add_triangles(std::span<const double* const> corners, Index surface);
    void check_solids() const;

    SectorMesh mesh_;
    Fans fans_;
    Locator locator_;
    Solids solids_;
    std::vector<Box> sector_boxes_;
    std::vector<Index> passes_to_, owner_, first_;
    std::vector<std::uint8_t> under_water_;
    std::vector<Triangle> triangles_;  // by sector, then those of the solids
    std::vector<BoxTree> tree_;        // of all triangles; one entry, made when they are known
};

// The triangles that a box touches, and the ways among them: they must not leave the box.
class Surroundings {
public:
    // `active` has one entry a solid: those with 0 are not there.
    Surroundings(const Strides& strides, const Box& around, std::span<const std::uint8_t> active);

    // Goes straight; `visited` receives the sectors on the way, the first included.
    Moved go(Index sector, const Point& from, const Point& to, std::vector<Index>& visited) const;

    // Falls straight down.
    Landed fall(Index sector, const Point& from, std::vector<Index>& visited) const;

    const Strides::Triangle& triangle(Index i) const { return strides_.triangles_[static_cast<std::size_t>(i)]; }
    std::span<const Index> of_sector(Index sector) const;
    std::span<const Index> of_solids() const { return of_solids_; }
    bool carries(Index solid_triangle) const;

private:
    const Strides& strides_;
    std::vector<Index> of_sectors_, of_solids_;  // ascending
};

}  // namespace jk
