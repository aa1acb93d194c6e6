#include "geometry/exact_locate.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/MP_Float.h>
#include <CGAL/Quotient.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <utility>

namespace jk {
namespace {

// CGAL's exact numbers are Boost's where there is no GMP, and those refuse subnormal doubles.
using Usual = CGAL::Exact_predicates_inexact_constructions_kernel;
// For these, lazy numbers over MP_Float, whose exponents have no end.
using Unbounded = CGAL::Simple_cartesian<CGAL::Lazy_exact_nt<CGAL::Quotient<CGAL::MP_Float>>>;

using Triangle = std::array<const double*, 3>;

bool usual(std::span<const double> coordinates) {
    return std::all_of(coordinates.begin(), coordinates.end(),
                       [](double x) { return x == 0 || std::abs(x) > 0x1p-160; });
}

template <typename Kernel>
typename Kernel::Point_3 solid(const double* p) {
    return {p[0], p[1], p[2]};
}

template <typename Kernel>
typename Kernel::Point_2 shadow(const double* p) {
    return {p[0], p[1]};
}

template <typename Kernel>
bool has_area(const Triangle& t) {
    return !CGAL::collinear(solid<Kernel>(t[0]), solid<Kernel>(t[1]), solid<Kernel>(t[2]));
}

// On which side of the line from a to b, seen from above, a place lies that is moved from p along x, and by far less
// along y, by less than any distance.
template <typename Kernel>
CGAL::Orientation beside(const double* a, const double* b, const double* p) {
    const auto side = CGAL::orientation(shadow<Kernel>(a), shadow<Kernel>(b), shadow<Kernel>(p));
    if (side != CGAL::COLLINEAR) return side;
    if (a[1] != b[1]) return a[1] > b[1] ? CGAL::LEFT_TURN : CGAL::RIGHT_TURN;
    return a[0] < b[0] ? CGAL::LEFT_TURN : CGAL::RIGHT_TURN;
}

// 1 where the triangle is straight above the point and faces up, -1 where it faces down, 0 where it is not above. The
// point is not on the triangle.
template <typename Kernel>
int above(const Triangle& t, const double* p) {
    const auto turn = CGAL::orientation(shadow<Kernel>(t[0]), shadow<Kernel>(t[1]), shadow<Kernel>(t[2]));
    if (turn == CGAL::COLLINEAR) return 0;
    for (std::size_t i = 0; i < 3; ++i)
        if (beside<Kernel>(t[i], t[(i + 1) % 3], p) != turn) return 0;
    const auto side = CGAL::orientation(solid<Kernel>(t[0]), solid<Kernel>(t[1]), solid<Kernel>(t[2]), solid<Kernel>(p));
    // A triangle that turns left seen from above has its positive side above it.
    const bool below = side == (turn == CGAL::LEFT_TURN ? CGAL::NEGATIVE : CGAL::POSITIVE);
    return below ? (turn == CGAL::LEFT_TURN ? 1 : -1) : 0;
}

// Whether each edge goes as often one way as the other.
bool is_closed(const std::vector<std::pair<const double*, const double*>>& edges) {
    using Place = std::tuple<double, double, double>;
    const auto place = [](const double* p) { return Place(p[0], p[1], p[2]); };
    std::map<std::pair<Place, Place>, long> count;
    for (const auto& [a, b] : edges) {
        ++count[{place(a), place(b)}];
        --count[{place(b), place(a)}];
    }
    return std::all_of(count.begin(), count.end(), [](const auto& entry) { return entry.second == 0; });
}

}  // namespace

ExactLocator::ExactLocator(const SectorMesh& mesh) : rooms_(mesh.sectors()), usual_(usual(mesh.positions)) {
    for (std::size_t s = 0; s < rooms_.size(); ++s) {
        Room& room = rooms_[s];
        std::vector<std::pair<const double*, const double*>> edges;
        const auto first = static_cast<std::size_t>(mesh.sector_first[s]);
        for (std::size_t surface = first; surface < first + static_cast<std::size_t>(mesh.sector_count[s]); ++surface) {
            std::vector<const double*> corners;
            for (Index c = mesh.surface_start[surface]; c < mesh.surface_start[surface + 1]; ++c)
                corners.push_back(mesh.vertex(mesh.surface_vertex[static_cast<std::size_t>(c)]));
            for (std::size_t i = 0; i < corners.size(); ++i) {
                edges.emplace_back(corners[i], corners[(i + 1) % corners.size()]);
                if (i == 0 || i + 1 == corners.size()) continue;
                const Triangle t{corners[0], corners[i], corners[i + 1]};
                if (usual_ ? has_area<Usual>(t) : has_area<Unbounded>(t)) room.triangles.push_back(t);
            }
            room.corners.insert(room.corners.end(), corners.begin(), corners.end());
        }
        room.closed = is_closed(edges);
    }
}

ExactLocation ExactLocator::locate(const double* point) const {
    return usual_ && usual({point, 3}) ? answer<Usual>(point) : answer<Unbounded>(point);
}

template <typename Kernel>
ExactLocation ExactLocator::answer(const double* point) const {
    ExactLocation found;
    Index beside_first = -1;
    const auto at = solid<Kernel>(point);
    for (std::size_t s = 0; s < rooms_.size(); ++s) {
        const Room& room = rooms_[s];
        const auto within = [&](std::size_t k) {
            const auto [low, high] = std::minmax_element(room.corners.begin(), room.corners.end(),
                                                         [k](const double* a, const double* b) { return a[k] < b[k]; });
            return (*low)[k] <= point[k] && point[k] <= (*high)[k];
        };
        if (room.triangles.empty() || !within(0) || !within(1) || !within(2)) continue;
        bool on = false, behind = false;
        int turns = 0;
        for (const Triangle& t : room.triangles) {
            const typename Kernel::Point_3 a = solid<Kernel>(t[0]), b = solid<Kernel>(t[1]), c = solid<Kernel>(t[2]);
            if (!room.closed) {
                const auto side = CGAL::orientation(a, b, c, at);
                on |= side == CGAL::ZERO;
                behind |= side == CGAL::NEGATIVE;
            } else if (typename Kernel::Triangle_3(a, b, c).has_on(at)) {
                on = true;
            } else {
                turns += above<Kernel>(t, point);
            }
        }
        if (behind || (room.closed && !on && turns == 0)) continue;
        ++(on ? found.touching : found.inside);
        Index& first = on ? beside_first : found.sector;
        if (first < 0) first = static_cast<Index>(s);
    }
    if (found.sector < 0) found.sector = beside_first;
    return found;
}

}  // namespace jk
