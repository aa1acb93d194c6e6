#include "geometry/exact_sight.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/MP_Float.h>
#include <CGAL/Quotient.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>

#include <set>
#include <span>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace jk {
namespace {

// CGAL's kernel of exact constructions; its exact numbers are Boost's where there is no GMP, and those refuse
// subnormal doubles.
using Usual = CGAL::Exact_predicates_exact_constructions_kernel;
// For these, lazy numbers over MP_Float, whose exponents have no end: four times slower.
using Unbounded = CGAL::Simple_cartesian<CGAL::Lazy_exact_nt<CGAL::Quotient<CGAL::MP_Float>>>;

bool usual(std::span<const double> coordinates) {
    return std::all_of(coordinates.begin(), coordinates.end(),
                       [](double x) { return x == 0 || std::abs(x) > 0x1p-300; });
}

template <typename Kernel>
class Oracle {
    using Number = typename Kernel::FT;
    using Point = typename Kernel::Point_3;

public:
    Oracle(const SectorMesh& mesh, const double* a, const double* b) : mesh_(mesh), a_(point(a)), b_(point(b)) {}

    ExactVerdict answer(Index sector) {
        visit(sector, Number(0), 1);
        if (visible_) return {true, visible_, -1};
        if (blocked_) return {false, blocked_, blocker_};
        return {true, circle_, -1};
    }

private:
    // Follows the segment through a sector entered at t, the `depth`-th on its way. Each ending found first is kept.
    void visit(Index sector, const Number& t, Index depth) {
        if (!tried_.emplace(sector, t).second) {
            if (!circle_) circle_ = depth - 1;
            return;
        }
        const auto [exit, surfaces] = exits(sector, t);
        if (surfaces.empty()) {
            visible_ = depth;
            return;
        }
        for (const Index surface : surfaces)
            if (mesh_.leads_to[static_cast<std::size_t>(surface)] == kBlocks) {
                if (!blocked_) {
                    blocked_ = depth;
                    blocker_ = surface;
                }
                return;
            }
        for (const Index surface : surfaces)
            if (!visible_) visit(mesh_.leads_to[static_cast<std::size_t>(surface)], exit, depth + 1);
    }

    // The least t, not before `entry`, at which the segment leaves the sector, and the surfaces that it leaves through.
    std::pair<Number, std::set<Index>> exits(Index sector, const Number& entry) const {
        std::pair<Number, std::set<Index>> found{1, {}};
        const Index first = mesh_.sector_first[static_cast<std::size_t>(sector)];
        for (Index s = first; s < first + mesh_.sector_count[static_cast<std::size_t>(sector)]; ++s) {
            const Index corner = mesh_.surface_start[static_cast<std::size_t>(s)];
            const Index end = mesh_.surface_start[static_cast<std::size_t>(s) + 1];
            for (Index i = corner + 1; i + 1 < end; ++i) {
                const auto t = leaves_at(vertex(corner), vertex(i), vertex(i + 1));
                if (!t || *t < entry || (!found.second.empty() && *t > found.first)) continue;
                if (*t < found.first) found.second.clear();
                found.first = *t;
                found.second.insert(s);
            }
        }
        return found;
    }

    std::optional<Number> leaves_at(const Point& v0, const Point& v1, const Point& v2) const {
        if (CGAL::collinear(v0, v1, v2)) return std::nullopt;
        const typename Kernel::Plane_3 plane(v0, v1, v2);
        if (plane.has_on_negative_side(a_) || !plane.has_on_negative_side(b_)) return std::nullopt;
        const auto met = CGAL::intersection(typename Kernel::Line_3(a_, b_), plane);
        const Point crossing = boost::get<Point>(*met);
        if (!typename Kernel::Triangle_3(v0, v1, v2).has_on(crossing)) return std::nullopt;
        const typename Kernel::Vector_3 along = b_ - a_;
        return Number((crossing - a_) * along / along.squared_length());
    }

    static Point point(const double* p) { return Point(p[0], p[1], p[2]); }

    Point vertex(Index corner) const {
        return point(mesh_.vertex(mesh_.surface_vertex[static_cast<std::size_t>(corner)]));
    }

    const SectorMesh& mesh_;
    const Point a_, b_;
    std::set<std::pair<Index, Number>> tried_;
    Index visible_ = 0, blocked_ = 0, circle_ = 0, blocker_ = -1;
};

}  // namespace

ExactVerdict exact_sight(const SectorMesh& mesh, Index sector, const double* a, const double* b) {
    if (usual(mesh.positions) && usual({a, 3}) && usual({b, 3})) return Oracle<Usual>(mesh, a, b).answer(sector);
    return Oracle<Unbounded>(mesh, a, b).answer(sector);
}

}  // namespace jk
