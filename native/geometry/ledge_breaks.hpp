// The places along an edge at which what lies beyond it can change. For ledges.cpp; plain doubles.
#pragma once

#include <vector>

#include "geometry/ledge_rim.hpp"

namespace jk::ledge {

class Breaks {
public:
    Breaks(const Rim& rim, const Gait& gait, const Surroundings& around);

    // Starts anew with the places that solids make from `from` to `to`; `further`: places further out count too.
    void begin(double from, double to, bool further);
    // Adds those of the sectors visited and the planes remembered since; tells whether there were any to add.
    bool gather(std::vector<Index>& visited);
    // Takes note of the plane of a surface fallen onto: the faces of solids may cross it.
    void remember(const Plane& plane);
    // Those found so far, in order, between the two ends.
    const std::vector<double>& sorted();

private:
    using Extent = std::array<double, 2>;

    void of_solids();
    void pierced(const Strides::Triangle& t, const Point& from);
    Extent extent(const Strides::Triangle& t) const;
    bool meets(const Strides::Triangle& t, const Plane& plane, const Extent& of_plane);
    void of_triangle(const Strides::Triangle& t);
    void of_side(const Seen& a, const Seen& b);
    void cross(const Seen& a, const Seen& b, double before, double after);
    void add(double t);

    const Rim& rim_;
    const Gait& gait_;
    const Surroundings& around_;
    std::vector<Index> gathered_;
    std::vector<double> breaks_;
    double from_ = 0, to_ = 1;   // between which they are looked for
    std::vector<Plane> planes_;  // of the surfaces fallen onto
    std::size_t compared_ = 0;   // of these, how many were set against the faces of solids
    bool further_ = false;
};

}  // namespace jk::ledge
