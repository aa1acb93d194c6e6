#include "geometry/ledge_rim.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jk::ledge {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<const double*> ring(const Strides& strides, Index surface, Index face) {
    std::vector<const double*> corners;
    if (surface >= 0) {
        const SectorMesh& mesh = strides.mesh();
        const auto s = static_cast<std::size_t>(surface);
        for (Index c = mesh.surface_start[s]; c < mesh.surface_start[s + 1]; ++c)
            corners.push_back(mesh.vertex(mesh.surface_vertex[static_cast<std::size_t>(c)]));
    } else {
        const Solids& solids = strides.solids();
        const auto f = static_cast<std::size_t>(face);
        for (Index c = solids.face_start[f]; c < solids.face_start[f + 1]; ++c)
            corners.push_back(solids.vertex(solids.face_vertex[static_cast<std::size_t>(c)]));
    }
    return corners;
}

}  // namespace

Rim::Rim(const Strides& strides, const Edges& edges, std::size_t row, const Gait& gait)
    : gait_(gait), home_(edges.surface[row] < 0 ? -1 : strides.sector_of(edges.surface[row])) {
    const auto corners = ring(strides, edges.surface[row], edges.face[row]);
    const auto first = static_cast<std::size_t>(edges.corner[row]);
    const double *a = corners[first], *b = corners[(first + 1) % corners.size()];
    for (std::size_t k = 0; k < 3; ++k) start_[k] = a[k], along_[k] = b[k] - a[k];
    length_ = std::hypot(along_[0], along_[1]);
    if (!has_length()) return;
    out_ = {along_[1] / length_, -along_[0] / length_, 0};
    find_plane(corners);
}

// The plane of the floor, by Newell.
void Rim::find_plane(std::span<const double* const> corners) {
    const double* o = corners.front();
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const double *p = corners[c], *q = corners[(c + 1) % corners.size()];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
            normal_[k] += (p[i] - o[i]) * (q[j] - o[j]) - (p[j] - o[j]) * (q[i] - o[i]);
        }
    }
}

Box Rim::box() const {
    Box box = Box::nothing();
    for (const double t : {0.0, 1.0})
        for (const double side : {-kMargin, std::max(kMargin, 2 * gait_.radius + kMargin)})
            box.add(beside(t, side, 0).data());
    for (int k = 0; k < 2; ++k) box.low[k] -= kMargin, box.high[k] += kMargin;
    box.low[2] = -kInfinity, box.high[2] = kInfinity;
    return box;
}

Box Rim::close_box() const {
    Box around = box();
    around.low[2] = std::min(start_[2], start_[2] + along_[2]) - kMargin;
    around.high[2] = std::max(start_[2], start_[2] + along_[2]) + kMargin;
    return around;
}

}  // namespace jk::ledge
