#include "geometry/convexity.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "geometry/checks.hpp"

namespace jk {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Index = std::int32_t;

struct Plane {
    Point a, b, c;
    Vector normal;  // towards the inside, not normalised
    double length;  // of normal
};

void check(const SectorPolygons& level) {
    if (level.positions.size() % 3 != 0) throw std::invalid_argument("positions must have shape (n, 3)");
    check_finite("position", level.positions);
    const std::size_t vertices = level.positions.size() / 3;
    check_starts("surface_start", level.surface_start, level.surface_vertex.size());
    check_starts("sector_start", level.sector_start, level.sector_vertex.size());
    check_indices("surface_vertex", level.surface_vertex, vertices);
    check_indices("sector_vertex", level.sector_vertex, vertices);
    const std::size_t sectors = level.sector_start.size() - 1;
    if (level.sector_first.size() != sectors)
        throw std::invalid_argument("sector_first and sector_start must have one entry a sector");
    check_ranges("sector_first", level.sector_first, level.sector_count, level.surface_start.size() - 1);
}

// Twice the vector area of the polygon (Newell), which points to the side from which it is counter-clockwise.
Vector vector_area(const std::vector<Point>& polygon) {
    Vector sum(0, 0, 0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum = sum + CGAL::cross_product(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return sum;
}

std::optional<Plane> widest_plane(const std::vector<Point>& polygon) {
    const Vector area = vector_area(polygon);
    std::optional<Plane> best;
    double widest = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        for (std::size_t j = i + 1; j < polygon.size(); ++j)
            for (std::size_t k = j + 1; k < polygon.size(); ++k) {
                const Vector normal = CGAL::cross_product(polygon[j] - polygon[i], polygon[k] - polygon[i]);
                const double squared = normal.squared_length();
                if (squared <= widest || normal * area <= 0) continue;
                if (CGAL::collinear(polygon[i], polygon[j], polygon[k])) continue;
                widest = squared;
                best = Plane{polygon[i], polygon[j], polygon[k], normal, std::sqrt(squared)};
            }
    return best;
}

// The planes of a level's surfaces, each made on first use.
class Planes {
public:
    explicit Planes(const SectorPolygons& level) : level_(level), made_(level.surface_start.size() - 1) {}

    Point point(Index vertex) const { return point_of(level_.positions, static_cast<std::size_t>(vertex)); }

    static Point point_of(std::span<const double> positions, std::size_t i) {
        return Point(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    }

    const std::optional<Plane>& of(Index surface) {
        Made& made = made_[static_cast<std::size_t>(surface)];
        if (!made.done) {
            polygon_.clear();
            for (Index c = level_.surface_start[surface]; c < level_.surface_start[surface + 1]; ++c)
                polygon_.push_back(point(level_.surface_vertex[c]));
            made = {widest_plane(polygon_), true};
        }
        return made.plane;
    }

    // Distance of p behind the surface, or nothing when it is in front, on it, or the surface has no plane.
    std::optional<double> behind(Index surface, const Point& p) {
        const std::optional<Plane>& plane = of(surface);
        if (!plane || CGAL::orientation(plane->a, plane->b, plane->c, p) != CGAL::NEGATIVE) return std::nullopt;
        return std::abs(plane->normal * (p - plane->a)) / plane->length;
    }

private:
    struct Made {
        std::optional<Plane> plane;
        bool done = false;
    };
    const SectorPolygons& level_;
    std::vector<Made> made_;
    std::vector<Point> polygon_;
};

}  // namespace

Convexity sector_convexity(const SectorPolygons& level) {
    check(level);
    const std::size_t sectors = level.sector_start.size() - 1;
    Convexity out{std::vector<Index>(sectors, 0), std::vector<Index>(sectors, -1), std::vector<Index>(sectors, -1),
                  std::vector<double>(sectors, 0.0)};
    Planes planes(level);
    for (std::size_t s = 0; s < sectors; ++s) {
        for (Index f = level.sector_first[s]; f < level.sector_first[s] + level.sector_count[s]; ++f) {
            for (Index c = level.sector_start[s]; c < level.sector_start[s + 1]; ++c) {
                const Index v = level.sector_vertex[c];
                const std::optional<double> distance = planes.behind(f, planes.point(v));
                if (!distance) continue;
                ++out.behind[s];
                if (out.surface[s] >= 0 && *distance <= out.distance[s]) continue;
                out.distance[s] = *distance;
                out.surface[s] = f;
                out.vertex[s] = v;
            }
        }
    }
    return out;
}

Outside points_outside(const SectorPolygons& level, std::span<const double> points, std::span<const Index> sectors) {
    check(level);
    if (points.size() != 3 * sectors.size()) throw std::invalid_argument("points must have shape (n, 3), one sector each");
    check_finite("point", points);
    check_indices("sector of point", sectors, level.sector_first.size());
    Outside out{std::vector<Index>(sectors.size(), -1), std::vector<double>(sectors.size(), 0.0)};
    Planes planes(level);
    for (std::size_t i = 0; i < sectors.size(); ++i) {
        const Point p = Planes::point_of(points, i);
        const Index first = level.sector_first[sectors[i]], count = level.sector_count[sectors[i]];
        for (Index f = first; f < first + count; ++f) {
            const std::optional<double> distance = planes.behind(f, p);
            if (!distance || (out.surface[i] >= 0 && *distance <= out.distance[i])) continue;
            out.surface[i] = f;
            out.distance[i] = *distance;
        }
    }
    return out;
}

}  // namespace jk
