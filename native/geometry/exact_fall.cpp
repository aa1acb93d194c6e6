#include "geometry/exact_fall.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/MP_Float.h>
#include <CGAL/Quotient.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace jk {
namespace {

// CGAL's kernels of exact predicates, for what is asked of coordinates as written, and of exact constructions. Their
// exact numbers are Boost's where there is no GMP, and those refuse subnormal doubles: with coordinates from 2^-160 on,
// no depth is one.
using Predicates = CGAL::Exact_predicates_inexact_constructions_kernel;
using Constructions = CGAL::Exact_predicates_exact_constructions_kernel;
// For the rest, lazy numbers over MP_Float, whose exponents have no end.
using Unbounded = CGAL::Simple_cartesian<CGAL::Lazy_exact_nt<CGAL::Quotient<CGAL::MP_Float>>>;

bool usual(std::span<const double> coordinates) {
    return std::all_of(coordinates.begin(), coordinates.end(),
                       [](double x) { return x == 0 || std::abs(x) > 0x1p-160; });
}

// Rounds a number that is not negative to the nearest double, ties to even: by halving, since doubles that are not
// negative are in the order of their bits.
template <typename Number>
double round(const Number& x) {
    if (x == 0) return 0;
    CGAL::exact(x);  // a lazy number's bounds are narrow only then
    const auto [least, most] = CGAL::to_interval(x);
    auto low = std::bit_cast<std::uint64_t>(std::max(least, 0.0)), high = std::bit_cast<std::uint64_t>(most);
    while (high - low > 1) {
        const std::uint64_t middle = low + (high - low) / 2;
        (Number(std::bit_cast<double>(middle)) <= x ? low : high) = middle;
    }
    const double below = std::bit_cast<double>(low), above = std::bit_cast<double>(high);
    const Number halfway = (Number(below) + Number(above)) / Number(2);
    return x < halfway || (x == halfway && low % 2 == 0) ? below : above;
}

template <typename Plan, typename Kernel>
class Oracle {
    using Number = typename Kernel::FT;
    using Point = typename Kernel::Point_3;

public:
    Oracle(const Ground& ground, const double* point, double limit)
        : ground_(ground), point_(point), top_(at(point)), limit_(limit) {}

    Landing answer(Index start) {
        if (ground_.under_water[static_cast<std::size_t>(start)]) return {Ending::kWater, -1, start, 0};
        std::vector<std::pair<Index, Number>> ways{{start, Number(0)}};
        std::set<std::pair<Index, Number>> tried(ways.begin(), ways.end());
        while (!ways.empty()) {
            const auto [sector, entry] = ways.back();
            ways.pop_back();
            for (const auto& way : visit(sector, entry))
                if (tried.insert(way).second) ways.push_back(way);
        }
        if (!ends_.empty()) {
            const auto& [depth, ending, met] = ends_.begin()->first;
            return {ending, met, ends_.begin()->second, round(depth)};
        }
        if (!far_.empty()) return {Ending::kFar, -1, *far_.begin(), limit_};
        return {Ending::kNothing, -1, nowhere_.empty() ? start : *nowhere_.begin(), std::numeric_limits<double>::infinity()};
    }

private:
    // Looks for what the fall meets in a sector that it enters at a depth; returns the sectors that it goes on in.
    std::vector<std::pair<Index, Number>> visit(Index sector, const Number& entry) {
        std::map<Number, std::set<Index>> met;
        const Index first = ground_.mesh.sector_first[static_cast<std::size_t>(sector)];
        for (Index s = first; s < first + ground_.mesh.sector_count[static_cast<std::size_t>(sector)]; ++s)
            for (const Number& depth : depths(s))
                if (depth >= entry) met[depth].insert(s);
        if (met.empty()) {
            nowhere_.insert(sector);
            return {};
        }
        const auto& [depth, surfaces] = *met.begin();
        if (round(depth) > limit_) {
            far_.insert(sector);
            return {};
        }
        bool ends = false;
        for (const Index s : surfaces) {
            const Index leads = ground_.passes_to[static_cast<std::size_t>(s)];
            if (leads >= 0) continue;
            ends_.emplace(std::tuple(depth, leads == kCarries ? Ending::kFloor : Ending::kSolid, s), sector);
            ends = true;
        }
        std::vector<std::pair<Index, Number>> onward;
        if (ends) return onward;
        for (const Index s : surfaces) {
            const Index leads = ground_.passes_to[static_cast<std::size_t>(s)];
            if (ground_.under_water[static_cast<std::size_t>(leads)])
                ends_.emplace(std::tuple(depth, Ending::kWater, s), leads);
            else
                onward.emplace_back(leads, depth);
        }
        return onward;
    }

    // How far below the point each triangle of a surface lies that faces up and meets the vertical line down from it.
    std::vector<Number> depths(Index surface) const {
        std::vector<Number> found;
        if (ground_.passes_to[static_cast<std::size_t>(surface)] == kAbsent) return found;
        const Index corner = ground_.mesh.surface_start[static_cast<std::size_t>(surface)];
        const Index end = ground_.mesh.surface_start[static_cast<std::size_t>(surface) + 1];
        const typename Kernel::Line_3 down(top_, typename Kernel::Vector_3(0, 0, -1));
        for (Index i = corner + 1; i + 1 < end; ++i) {
            const double *a = vertex(corner), *b = vertex(i), *c = vertex(i + 1);
            const typename Plan::Triangle_2 shadow(from_above(a), from_above(b), from_above(c));
            if (shadow.orientation() != CGAL::COUNTERCLOCKWISE || shadow.has_on_unbounded_side(from_above(point_)))
                continue;
            const auto met = CGAL::intersection(down, typename Kernel::Plane_3(at(a), at(b), at(c)));
            const Point crossing = boost::get<Point>(*met);
            if (crossing.z() <= top_.z()) found.push_back(top_.z() - crossing.z());
        }
        return found;
    }

    static typename Plan::Point_2 from_above(const double* p) { return {p[0], p[1]}; }
    static Point at(const double* p) { return Point(p[0], p[1], p[2]); }

    const double* vertex(Index corner) const {
        return ground_.mesh.vertex(ground_.mesh.surface_vertex[static_cast<std::size_t>(corner)]);
    }

    const Ground& ground_;
    const double* const point_;
    const Point top_;
    const double limit_;
    std::map<std::tuple<Number, Ending, Index>, Index> ends_;  // the sector of each ending
    std::set<Index> far_, nowhere_;
};

}  // namespace

Landing exact_fall(const Ground& ground, Index sector, const double* point, double limit) {
    if (usual(ground.mesh.positions) && usual({point, 3})) 
        return Oracle<Predicates, Constructions>(ground, point, limit).answer(sector);
    return Oracle<Unbounded, Unbounded>(ground, point, limit).answer(sector);
}

}  // namespace jk
