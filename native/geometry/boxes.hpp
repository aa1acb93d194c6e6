// The sectors whose boxes hold a point or touch a box, found by a tree of boxes.
#pragma once

#include <vector>

#include "geometry/mesh.hpp"

namespace jk {

struct Box {
    double low[3], high[3];

    static Box nothing();
    void add(const double* point);
    void add(const Box& other);
    bool holds(const double* point) const;
    bool touches(const Box& other) const;
};

// The box of each sector's surfaces; nothing() for a sector without any.
std::vector<Box> sector_boxes(const SectorMesh& mesh);

class BoxTree {
public:
    explicit BoxTree(const std::vector<Box>& boxes);

    // Calls visit(i) for every box i that test(box) accepts, in no particular order; test must accept every box
    // around a box that it accepts.
    template <typename Test, typename Visit>
    void find(const Test& test, const Visit& visit) const {
        if (nodes_.empty()) return;
        Index stack[64];
        int depth = 0;
        stack[depth++] = 0;
        while (depth) {
            const Node& node = nodes_[static_cast<std::size_t>(stack[--depth])];
            if (!test(node.box)) continue;
            if (node.item >= 0) {
                visit(node.item);
                continue;
            }
            stack[depth++] = node.left;
            stack[depth++] = node.right;
        }
    }

    std::size_t memory() const { return nodes_.capacity() * sizeof(Node); }

private:
    struct Node {
        Box box;
        Index left, right, item;  // item -1 but for leaves
    };

    Index build(const std::vector<Box>& boxes, std::vector<Index>::iterator first, std::vector<Index>::iterator end);

    std::vector<Node> nodes_;
};

}  // namespace jk
