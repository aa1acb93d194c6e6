#include "geometry/boxes.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace jk {

Box Box::nothing() {
    constexpr double far = std::numeric_limits<double>::infinity();
    return {{far, far, far}, {-far, -far, -far}};
}

void Box::add(const double* point) {
    for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], point[k]);
        high[k] = std::max(high[k], point[k]);
    }
}

void Box::add(const Box& other) {
    add(other.low);
    add(other.high);
}

bool Box::holds(const double* point) const {
    for (int k = 0; k < 3; ++k)
        if (point[k] < low[k] || point[k] > high[k]) return false;
    return true;
}

bool Box::touches(const Box& other) const {
    for (int k = 0; k < 3; ++k)
        if (other.high[k] < low[k] || other.low[k] > high[k]) return false;
    return true;
}

std::vector<Box> sector_boxes(const SectorMesh& mesh) {
    std::vector<Box> boxes(mesh.sectors(), Box::nothing());
    for (std::size_t s = 0; s < boxes.size(); ++s) {
        const Index first = mesh.sector_first[s], end = first + mesh.sector_count[s];
        for (Index c = mesh.surface_start[static_cast<std::size_t>(first)];
             c < mesh.surface_start[static_cast<std::size_t>(end)]; ++c)
            boxes[s].add(mesh.vertex(mesh.surface_vertex[static_cast<std::size_t>(c)]));
    }
    return boxes;
}

BoxTree::BoxTree(const std::vector<Box>& boxes) {
    std::vector<Index> items(boxes.size());
    std::iota(items.begin(), items.end(), 0);
    std::erase_if(items, [&](Index i) { return !(boxes[static_cast<std::size_t>(i)].low[0] <= boxes[static_cast<std::size_t>(i)].high[0]); });
    nodes_.reserve(2 * items.size());
    if (!items.empty()) build(boxes, items.begin(), items.end());
}

// Halves the boxes by their middles along the longest axis: the depth stays below 2 log2 of their number.
Index BoxTree::build(const std::vector<Box>& boxes, std::vector<Index>::iterator first,
                     std::vector<Index>::iterator end) {
    const auto self = static_cast<std::size_t>(nodes_.size());
    nodes_.push_back({Box::nothing(), -1, -1, -1});
    Box box = Box::nothing();
    for (auto i = first; i != end; ++i) box.add(boxes[static_cast<std::size_t>(*i)]);
    nodes_[self].box = box;
    if (end - first == 1) {
        nodes_[self].item = *first;
        return static_cast<Index>(self);
    }
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
    const auto middle = first + (end - first) / 2;
    std::nth_element(first, middle, end, [&](Index i, Index j) {
        const Box &a = boxes[static_cast<std::size_t>(i)], &b = boxes[static_cast<std::size_t>(j)];
        return a.low[axis] + a.high[axis] < b.low[axis] + b.high[axis];
    });
    const Index left = build(boxes, first, middle), right = build(boxes, middle, end);
    nodes_[self].left = left;
    nodes_[self].right = right;
    return static_cast<Index>(self);
}

}  // namespace jk
