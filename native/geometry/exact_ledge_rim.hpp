// An edge of a floor as a frame of its own, in doubles for the ways and exact for the places. For exact_ledges.cpp.
#pragma once

#include "geometry/exact_ledge_parts.hpp"
#include "geometry/exact_ledges.hpp"

namespace jk::exact {

inline constexpr double kSlab = 4 * kBeyond;
inline constexpr double kAround = 2 * kSlab;  // JKU: what lies farther from the way is not looked at

std::vector<const double*> surface_corners(const SectorMesh& mesh, Index surface);
std::vector<const double*> face_corners(const Solids& solids, Index face);

class Rim {
public:
    Rim(const Strides& strides, const Edges& edges, std::size_t row, const Gait& gait);

    bool has_length() const { return length_ > kShortest; }
    double length() const { return length_; }
    const Vector& exact_along() const { return exact_along_; }
    // The sector of the floor; -1 for a face of a solid, which may lie in several.
    Index home() const { return home_; }

    // How far above the edge the way up begins.
    double start_up() const { return (home_ < 0 ? kOnFace : 0) + kBeyond * slope_; }

    // How far beyond the edge the places further out lie, JKU.
    double off(int which) const { return (which + 1) * gait_.radius; }

    Point beside(double t, double side, double up) const {
        return {here_[0] + t * along_[0] + side * out_[0], here_[1] + t * along_[1] + side * out_[1],
                here_[2] + t * along_[2] + up};
    }

    Vector exact_beside(const Number& t, double side) const {
        return {exact_here_.x + t * exact_along_.x + Number(side) * exact_out_.x,
                exact_here_.y + t * exact_along_.y + Number(side) * exact_out_.y,
                exact_here_.z + t * exact_along_.z};
    }

    // A corner along the edge, beyond it, above it.
    Vector seen(const double* p) const {
        const Vector away = vector(p) - exact_here_;
        const Number t = (away.x * exact_along_.x + away.y * exact_along_.y) / square_;
        return {t, away.x * exact_out_.x + away.y * exact_out_.y, away.z - t * exact_along_.z};
    }

    // How far outwards a point lies, roughly.
    double off_of(const double* p) const {
        return (p[0] - here_[0]) * out_[0] + (p[1] - here_[1]) * out_[1];
    }
    // How far along the edge a point lies, roughly.
    double along_of(const double* p) const {
        return ((p[0] - here_[0]) * along_[0] + (p[1] - here_[1]) * along_[1]) / (length_ * length_);
    }

    // All that the way over the edge comes past, however high or deep.
    const Box& box() const { return box_; }
    // The same, no higher and no deeper than the edge.
    Box close_box() const;

private:
    double slope(const std::vector<const double*>& corners) const;
    Box box_around() const;

    const Gait& gait_;
    const Index home_;
    Point here_{}, along_{}, out_{};
    double length_ = 0, slope_ = 0;
    Vector exact_here_, exact_along_, exact_out_;
    Number square_;
    Box box_ = Box::nothing();
};

}  // namespace jk::exact
