#include "geometry/exact_ledge_rim.hpp"

#include <algorithm>
#include <limits>

namespace jk::exact {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<const double*> surface_corners(const SectorMesh& mesh, Index surface) {
    std::vector<const double*> corners;
    const auto s = static_cast<std::size_t>(surface);
    for (Index c = mesh.surface_start[s]; c < mesh.surface_start[s + 1]; ++c)
        corners.push_back(mesh.vertex(mesh.surface_vertex[static_cast<std::size_t>(c)]));
    return corners;
}

std::vector<const double*> face_corners(const Solids& solids, Index face) {
    std::vector<const double*> corners;
    const auto f = static_cast<std::size_t>(face);
    for (Index c = solids.face_start[f]; c < solids.face_start[f + 1]; ++c)
        corners.push_back(solids.vertex(solids.face_vertex[static_cast<std::size_t>(c)]));
    return corners;
}

Rim::Rim(const Strides& strides, const Edges& edges, std::size_t row, const Gait& gait)
    : gait_(gait), home_(edges.surface[row] < 0 ? -1 : strides.sector_of(edges.surface[row])) {
    const auto corners = edges.surface[row] >= 0 ? surface_corners(strides.mesh(), edges.surface[row])
                                                 : face_corners(strides.solids(), edges.face[row]);
    const auto first = static_cast<std::size_t>(edges.corner[row]);
    here_ = {corners[first][0], corners[first][1], corners[first][2]};
    const double* there = corners[(first + 1) % corners.size()];
    for (std::size_t k = 0; k < 3; ++k) along_[k] = there[k] - here_[k];
    length_ = std::hypot(along_[0], along_[1]);
    if (!has_length()) return;
    out_ = {along_[1] / length_, -along_[0] / length_, 0};
    slope_ = slope(corners);
    exact_here_ = vector(here_.data()), exact_along_ = vector(along_.data()), exact_out_ = vector(out_.data());
    square_ = exact_along_.x * exact_along_.x + exact_along_.y * exact_along_.y;
    box_ = box_around();
}

// How the floor rises inwards from the edge, JKU a JKU.
double Rim::slope(const std::vector<const double*>& corners) const {
    double normal[3] = {};
    for (std::size_t c = 0; c < corners.size(); ++c) {
        double p[3], q[3];
        for (int k = 0; k < 3; ++k)
            p[k] = corners[c][k] - corners[0][k], q[k] = corners[(c + 1) % corners.size()][k] - corners[0][k];
        normal[0] += p[1] * q[2] - p[2] * q[1];
        normal[1] += p[2] * q[0] - p[0] * q[2];
        normal[2] += p[0] * q[1] - p[1] * q[0];
    }
    return (normal[0] * out_[0] + normal[1] * out_[1]) / normal[2];
}

Box Rim::box_around() const {
    Box box = Box::nothing();
    for (const double t : {0.0, 1.0})
        for (const double side : {-kAround, std::max(0.0, 2 * gait_.radius) + kAround})
            box.add(beside(t, side, 0).data());
    for (int k = 0; k < 2; ++k) box.low[k] -= kAround, box.high[k] += kAround;
    box.low[2] = -kInfinity, box.high[2] = kInfinity;
    return box;
}

Box Rim::close_box() const {
    Box around = box_;
    around.low[2] = std::min(here_[2], here_[2] + along_[2]) - kAround;
    around.high[2] = std::max(here_[2], here_[2] + along_[2]) + kAround;
    return around;
}

}  // namespace jk::exact
