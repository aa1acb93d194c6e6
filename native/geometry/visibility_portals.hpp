// The portals of a level: its see-through surfaces as windings, and which portal can be crossed after which.
//
// A segment that crosses a surface outward is on the inner side of the crossed triangle, or in its plane, before, and
// strictly behind it after. `ahead` says of a point how far it certainly lies on the inner side of each triangle of
// a portal, or behind each: the triangles' unit normals differ from the portal's by `lean` at most and their corners
// are `bend` at most off its plane, so that for a point x at distance r from the portal's corner the two figures differ
// by bend + lean r.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/boxes.hpp"
#include "geometry/crossing.hpp"
#include "geometry/visibility_windings.hpp"

namespace jk::vis {

struct Portal {
    Winding winding;
    Point normal, corner;  // the normal points into the sector that the portal leaves
    double lean, bend;
    double most_slack;  // of the planes that `before` and `after` give, for any winding of the level
    Index from, to, surface;
    Index twin;  // the portal on the other side, that leads back, -1 where there is none
    bool flat;   // all points in one plane, exactly
    Box box;

    double height(const Point& x) const { return dot(normal, x - corner); }
    // The part of the winding's room that a segment can pass before it crosses the portal, or after.
    HalfSpace before(const Winding& winding, const Precision& precision) const;
    HalfSpace after(const Winding& winding, const Precision& precision) const;

    // False when the winding is certainly behind the portal, all of it.
    bool may_be_before(const Winding& winding) const;
    // The same as clipping by `before` and `after`, and quicker where nothing is cut.
    bool cut_before(Winding& winding, const Precision& precision) const;
    bool cut_after(Winding& winding, const Precision& precision) const;

private:
    double slack(const Winding& winding, const Precision& precision) const;
};

// A row of bits for each of some things.
class Bits {
public:
    using Word = std::uint64_t;

    Bits(std::size_t rows, std::size_t columns)
        : words_((columns + 63) / 64), columns_(columns), data_(rows * words_) {}

    std::size_t words() const { return words_; }
    std::size_t columns() const { return columns_; }
    Word* row(std::size_t i) { return data_.data() + i * words_; }
    const Word* row(std::size_t i) const { return data_.data() + i * words_; }
    bool get(std::size_t i, std::size_t j) const { return row(i)[j / 64] >> j % 64 & 1; }
    void set(std::size_t i, std::size_t j) { row(i)[j / 64] |= Word{1} << j % 64; }
    void clear(std::size_t i, std::size_t j) { row(i)[j / 64] &= ~(Word{1} << j % 64); }
    std::size_t count(std::size_t i) const;

private:
    std::size_t words_, columns_;
    std::vector<Word> data_;
};

struct Portals {
    // `leads_to` as in SectorMesh, what may come to be see-through included.
    Portals(const SectorMesh& mesh, const Fans& fans, std::span<const Index> leads_to);

    // Whether a segment can cross portal q when it has crossed portal p: q has a point behind p, and p has one on the
    // inner side of q, or they touch.
    bool can_follow(std::size_t p, std::size_t q) const;

    // What a flood from portal p reaches through portals that can follow it, p left out.
    void flood(std::size_t p, Bits& reached) const;

    std::vector<Portal> portals;      // in the order of their sectors and surfaces
    std::vector<Index> sector_start;  // sector i is left through [sector_start[i], sector_start[i + 1])
    Precision precision{};

private:
    void find_twins();
    void pair_up(std::size_t first, std::size_t second);
    bool behind(const Portal& plane, const Portal& other, double side) const;
};

}  // namespace jk::vis
