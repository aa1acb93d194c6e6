// A body's way over an edge at one place of it, and what it meets there. For ledges.cpp; plain doubles.
#pragma once

#include <vector>

#include "geometry/ledge_breaks.hpp"

namespace jk::ledge {

// A place further out: whether the body gets there, and the floor below.
struct Further {
    enum State : std::uint8_t { kNotLooked, kStopped, kNoFloor, kFloor } state = kNotLooked;
    Index met = -1, face = -1;
    Plane plane{{0, 0, 1}, {0, 0, 0}};

    bool same(const Further& other) const {
        return state == other.state && met == other.met && face == other.face;
    }
};

struct Found {
    Over over;
    Index met, face, sector, rise;
    Plane plane;
    Further further[2];

    bool same(const Found& other) const {
        return over == other.over && met == other.met && face == other.face && sector == other.sector &&
               rise == other.rise && further[0].same(other.further[0]) && further[1].same(other.further[1]);
    }
};

class Way {
public:
    // `breaks` takes note of the planes that are fallen onto.
    Way(const Strides& strides, const Rim& rim, const Gait& gait, const Surroundings& around, Breaks& breaks);

    // Goes over the edge at a place; `further`: looks at the places further out too.
    Found at(double t, bool further);

    // The sectors that ways came through since `forget`, in any order and more than once.
    std::vector<Index>& visited() { return visited_; }
    void forget() { visited_ = homes_; }

private:
    Index home_of(const Point& p) const;
    Further look_further(Index sector, double t, int which);

    const Strides& strides_;
    const Rim& rim_;
    const Gait& gait_;
    const Surroundings& around_;
    Breaks& breaks_;
    std::vector<Index> homes_, visited_;  // sectors that may hold the edge of a face
};

}  // namespace jk::ledge
