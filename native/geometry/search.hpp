// The complete search: sight by its definition, every triangle of every sector on the way, exact.
#pragma once

#include <boost/container/small_vector.hpp>

#include <optional>

#include "geometry/crossing.hpp"

namespace jk {

// What one query found.
struct Verdict {
    bool visible;
    Index crossed;  // sectors on the way that decided, the first and the last included
    Index blocker;  // the surface that blocks, -1 when visible
    bool reached = true;  // whether the sector aimed at, if one is, lies on the way that decided
};

// No sector is aimed at; a segment then reaches it wherever it ends.
inline constexpr Index kNoAim = -2;

// A sector on the way, and the surface through which the segment leaves it (-1: it ends there) at `leave` of the way
// from a to b (1 when it ends), a rounded figure.
struct Step {
    Index sector, surface;
    double leave;
};

struct Rooms;

// The first crossings out of a sector: all those at the least t that is not before the entry, in the order of their
// surfaces, one a surface.
class Exits {
public:
    // Without an entry the segment starts in the sector.
    Exits(const Fans& fans, const Segment& segment, const std::optional<Crossing>& entry)
        : fans_(fans), segment_(segment), entry_(entry) {}

    // Tests every triangle of the sector; with `rooms`, only those that float32 bounds do not exclude.
    void leave(const SectorMesh& mesh, const Rooms* rooms, Index sector);

    using Found = boost::container::small_vector<Crossing, 4>;

    const Found& found() const { return found_; }

private:
    void offer(Index triangle);
    void one_a_surface();

    const Fans& fans_;
    const Segment segment_;
    const std::optional<Crossing> entry_;
    Found found_;
};

// Answers one query by depth-first search over pairs of a sector and the t at which it is entered.
//
// Where the segment leaves through an edge or a vertex that several see-through adjoins share, each is tried in the
// order of the surfaces; visible if one way is. A pair that was tried before is not tried again: sectors that
// overlap can lead in a circle at one point. When no way is visible, the first that meets a blocking surface
// decides; when none meets one, nothing blocks and the answer is visible. `path`, when given, receives the steps of
// the way that decided. `rooms` as in Exits::leave.
Verdict search(const SectorMesh& mesh, const Fans& fans, const Rooms* rooms, Index sector, const Segment& segment,
               std::vector<Step>* path = nullptr);

}  // namespace jk
