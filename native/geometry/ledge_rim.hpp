// An edge of a floor as a frame of its own: along it, beyond it, above it. For ledges.cpp; plain doubles.
#pragma once

#include <vector>

#include "geometry/ledges.hpp"

namespace jk::ledge {

inline constexpr double kSlab = 4 * kBeyond;
inline constexpr double kMargin = 2 * kBeyond;  // JKU around the way in which triangles are looked for

struct Plane {
    Point normal, corner;

    double height(const Point& p) const {
        return corner[2] - (normal[0] * (p[0] - corner[0]) + normal[1] * (p[1] - corner[1])) / normal[2];
    }
};

// A corner as the edge sees it: along the edge, beyond it, above it.
struct Seen {
    double t, off, up;
};

class Rim {
public:
    Rim(const Strides& strides, const Edges& edges, std::size_t row, const Gait& gait);

    bool has_length() const { return length_ > kShortest; }
    bool is_short(double from, double to) const { return (to - from) * length_ < kShortest; }
    double length() const { return length_; }
    const Point& along() const { return along_; }
    bool of_face() const { return home_ < 0; }
    // The sector of the floor; -1 for a face of a solid, which may lie in several.
    Index home() const { return home_; }
    // How far beyond the edge the places further out lie, JKU.
    double off(int which) const { return (which + 1) * gait_.radius; }

    // Over a place beside the edge, `up` above the edge.
    Point beside(double t, double off, double up) const {
        return {start_[0] + t * along_[0] + off * out_[0], start_[1] + t * along_[1] + off * out_[1],
                start_[2] + t * along_[2] + up};
    }

    // Where the way up begins.
    Point inner(double t) const {
        const double rises = (normal_[0] * out_[0] + normal_[1] * out_[1]) / normal_[2];
        return beside(t, -kBeyond, (home_ < 0 ? kOnFace : 0) + kBeyond * rises);
    }

    Seen seen(const Point& p) const {
        const double x = p[0] - start_[0], y = p[1] - start_[1];
        const double t = (x * along_[0] + y * along_[1]) / (length_ * length_);
        return {t, x * out_[0] + y * out_[1], p[2] - start_[2] - t * along_[2]};
    }

    // All that the way over the edge comes past, however high or deep.
    Box box() const;
    // The same, no higher and no deeper than the edge.
    Box close_box() const;

private:
    void find_plane(std::span<const double* const> corners);

    const Gait& gait_;
    const Index home_;
    Point start_{}, along_{}, out_{}, normal_{};
    double length_ = 0;
};

}  // namespace jk::ledge
