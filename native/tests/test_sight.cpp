#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <random>
#include <vector>

#include "geometry/expansion.hpp"
#include "geometry/sight.hpp"
#include "geometry/whole.hpp"

namespace {

using Rational = boost::multiprecision::cpp_rational;

// A grid of boxes, walls on a part of the faces between them.
struct Grid {
    std::vector<double> positions;
    std::vector<jk::Index> surface_start{0}, surface_vertex, leads_to, sector_first, sector_count;

    Grid(int n, double walls, unsigned seed) : n_(n) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> unit(0, 1);
        std::vector<double> planes{0};
        for (int i = 0; i < n; ++i) planes.push_back(planes.back() + 0.25 + unit(random));
        planes_ = planes;
        for (int z = 0; z <= n; ++z)
            for (int y = 0; y <= n; ++y)
                for (int x = 0; x <= n; ++x)
                    positions.insert(positions.end(), {planes[x], planes[y], planes[z]});
        std::vector<bool> solid(static_cast<std::size_t>(3 * n * n * n));
        for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = unit(random) < walls;
        for (int s = 0; s < n * n * n; ++s) add(s, solid);
    }

    jk::SectorMesh mesh() const {
        return jk::make_mesh(positions, surface_start, surface_vertex, leads_to, sector_first, sector_count);
    }

    double plane(int i) const { return planes_[static_cast<std::size_t>(i)]; }

private:
    void add(int sector, const std::vector<bool>& solid) {
        static constexpr int kFaces[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1},
                                             {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
        const int at[3] = {sector % n_, sector / n_ % n_, sector / (n_ * n_)};
        sector_first.push_back(static_cast<jk::Index>(leads_to.size()));
        sector_count.push_back(6);
        for (int face = 0; face < 6; ++face) {
            for (const int corner : kFaces[face])
                surface_vertex.push_back(at[0] + (corner & 1) + (n_ + 1) * (at[1] + (corner >> 1 & 1) +
                                                                            (n_ + 1) * (at[2] + (corner >> 2))));
            surface_start.push_back(static_cast<jk::Index>(surface_vertex.size()));
            const int axis = face / 2, step = face % 2 ? 1 : -1, stride = axis == 0 ? 1 : axis == 1 ? n_ : n_ * n_;
            const int beyond = at[axis] + step;
            const int below = step > 0 ? sector : sector - stride;  // the wall belongs to the lower of the two
            const bool open = beyond >= 0 && beyond < n_ && !solid[static_cast<std::size_t>(3 * below + axis)];
            leads_to.push_back(open ? sector + step * stride : jk::kBlocks);
        }
    }

    int n_;
    std::vector<double> planes_;
};

}  // namespace

TEST_CASE("sight agrees with an AABB tree over the walls of a level without overlaps") {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Triangles = std::vector<Kernel::Triangle_3>;
    using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
    constexpr int kSize = 5;
    for (unsigned seed = 0; seed < 3; ++seed) {
        const Grid grid(kSize, 0.4, seed);
        const jk::Viewer viewer(grid.mesh());
        Triangles walls;
        for (const auto& t : viewer.fans().triangles)
            if (grid.leads_to[static_cast<std::size_t>(t.surface)] == jk::kBlocks)
                walls.emplace_back(Kernel::Point_3(t.a[0], t.a[1], t.a[2]), Kernel::Point_3(t.b[0], t.b[1], t.b[2]),
                                   Kernel::Point_3(t.c[0], t.c[1], t.c[2]));
        CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(walls.begin(), walls.end());
        std::mt19937 random(seed + 100);
        std::uniform_real_distribution<double> anywhere(0.001, grid.plane(kSize) - 0.001);
        std::vector<double> origins, targets;
        for (int i = 0; i < 3 * 4000; ++i) {
            origins.push_back(anywhere(random));
            targets.push_back(anywhere(random));
        }
        const auto sectors = viewer.locate(origins, jk::Tier::kBalanced, 1).sector;
        const auto found = viewer.sight({origins, sectors, targets}, jk::Tier::kBalanced, 1);
        std::size_t differ = 0, visible = 0;
        for (std::size_t i = 0; i < sectors.size(); ++i) {
            const double *a = &origins[3 * i], *b = &targets[3 * i];
            const bool clear = !tree.do_intersect(Kernel::Segment_3({a[0], a[1], a[2]}, {b[0], b[1], b[2]}));
            differ += clear != (found.visible[i] != 0);
            visible += clear;
        }
        CHECK(differ == 0);
        CHECK(visible > 200);  // neither all open nor all closed
        CHECK(visible < 3800);
    }
}

TEST_CASE("volumes have the sign of rational arithmetic") {
    std::mt19937_64 random(1);
    std::uniform_int_distribution<int> small(-2, 2), ulps(-2, 2);
    std::size_t zeros = 0;
    for (int round = 0; round < 6000; ++round) {
        double p[4][3];
        for (auto& point : p)
            for (double& x : point) {
                x = small(random) / 3.0 * std::ldexp(1, round % 5 * 30 - 60);
                for (int k = round % 2 * ulps(random); k > 0; --k) x = std::nextafter(x, 1e300);
                if (round % 11 == 0 && x == 0) x = 5e-324;  // beyond what an Expansion holds
            }
        Rational d[3][3];
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) d[i][k] = Rational(p[i + 1][k]) - Rational(p[0][k]);
        const Rational exact = d[2][0] * (d[0][1] * d[1][2] - d[0][2] * d[1][1]) +
                               d[2][1] * (d[0][2] * d[1][0] - d[0][0] * d[1][2]) +
                               d[2][2] * (d[0][0] * d[1][1] - d[0][1] * d[1][0]);
        const jk::Volume found = jk::volume(p[0], p[1], p[2], p[3]);
        CHECK(found.sign == exact.sign());
        CHECK(abs(exact - Rational(found.value)) <= Rational(found.error));
        zeros += found.sign == 0;
    }
    CHECK(zeros > 100);  // the doubtful ones were among them
}

TEST_CASE("expansions and wholes agree on products of differences") {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int round = 0; round < 500; ++round) {
        double x[6];
        for (double& v : x) v = std::ldexp(unit(random), round % 100 - 50);
        const auto test = [&]<typename Exact>(Exact) {
            const Exact a = Exact::difference(x[0], x[1]), b = Exact::difference(x[2], x[3]),
                        c = Exact::difference(x[4], x[5]);
            const Exact left = (a + b) * (c - a) * b, right = (a * c - a * a + b * c - b * a) * b;
            return std::make_pair((left - right).sign(), left.sign());
        };
        const auto by_parts = test(jk::Expansion());
        CHECK(by_parts == test(jk::Whole::difference(0, 0)));
        CHECK(by_parts.first == 0);
    }
}

TEST_CASE("what an expansion cannot hold is known") {
    CHECK(jk::Expansion::fits(0));
    CHECK(jk::Expansion::fits(0x1p-149));  // the least float32
    CHECK(jk::Expansion::fits(0x1p149));
    CHECK_FALSE(jk::Expansion::fits(0x1p150));
    CHECK_FALSE(jk::Expansion::fits(5e-324));
    CHECK_FALSE(jk::Expansion::fits(std::nextafter(0x1p-125, 1)));
    CHECK_FALSE(jk::Expansion::fits(std::nan("")));
}

TEST_CASE("a long row of rooms is crossed to its end") {
    jk::SectorMesh mesh = Grid(40, 0, 3).mesh();
    const jk::Viewer viewer(std::move(mesh));
    const double far = 1e3;
    const std::vector<double> origin{0.1, 0.1, 0.1}, target{far, 0.1, 0.1};
    const std::vector<jk::Index> sector{0};
    const auto found = viewer.sight({origin, sector, target}, jk::Tier::kBalanced, 1);
    CHECK(found.crossed[0] == 40);
    CHECK(found.visible[0] == 0);
}
