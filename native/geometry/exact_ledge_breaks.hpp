// The places along an edge at which what lies beyond it can change, exactly. For exact_ledges.cpp.
#pragma once

#include <set>
#include <vector>

#include "geometry/exact_ledge_way.hpp"

namespace jk::exact {

class Breaks {
public:
    // Starts with the places that solids make from `from` to `to`; `further`: places further out count too.
    Breaks(const SectorMesh& mesh, const Rim& rim, const Gait& gait, const NearSolids& solids, const Number& from,
           const Number& to, bool further);

    // Adds those of the sectors and planes that are new to it, and gives all in order, each once.
    const std::vector<Number>& with(const std::set<Index>& visited, const std::vector<Plane>& planes);
    // Whether it knows all of them.
    bool has(const std::set<Index>& visited, const std::vector<Plane>& planes) const {
        return gathered_.size() >= visited.size() && compared_ >= planes.size();
    }

private:
    void of_sector(Index sector);
    void of_solids();
    void of_triangle(const Triangle& t);
    void of_side(const Vector& a, const Vector& b);
    void of_crossing(const Triangle& t, const Plane& own, const Plane& plane);
    std::pair<double, double> rough_extent(const Triangle& t) const;
    bool share_extent(const Triangle& a, const Triangle& b) const;
    bool reaches(const Triangle& t, double side) const;
    bool clear_of_way(const Triangle& t) const;
    void cross_at(const Vector& a, const Vector& b, const Number& before, const Number& after);
    void add(const Number& t);

    const SectorMesh& mesh_;
    const Rim& rim_;
    const Gait& gait_;
    const NearSolids& solids_;
    const Number from_, to_;
    const bool further_;
    std::vector<Number> breaks_;
    std::set<Index> gathered_;
    std::size_t compared_ = 0;  // of the planes, how many were set against the faces of solids
};

}  // namespace jk::exact
