// Times the tiers of drop against CGAL's AABB tree (EPICK, the first triangle that a ray down meets) on one level's
// points, on one thread.
//
// The tree holds every triangle that ends a fall, and knows nothing of sectors nor of water: how often its floor differs
// is counted, not explained. Reads what benchmarks/bench_drop.py writes; prints one line of JSON a set.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "geometry/ground.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Answers = std::vector<jk::Index>;  // the surface that ends the fall, -1 for none

constexpr int kRounds = 5;

template <typename T>
std::vector<T> read(std::ifstream& in) {
    std::int64_t size = 0;
    in.read(reinterpret_cast<char*>(&size), sizeof size);
    std::vector<T> values(static_cast<std::size_t>(size));
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
    return values;
}

struct Soup {
    std::vector<Triangle> triangles;
    std::vector<jk::Index> surface;

    Soup(const jk::Viewer& viewer, const std::vector<jk::Index>& passes_to) {
        for (const auto& t : viewer.fans().triangles) {
            const jk::Index leads = passes_to[static_cast<std::size_t>(t.surface)];
            if (leads != jk::kCarries && leads != jk::kStops) continue;
            triangles.emplace_back(Kernel::Point_3(t.a[0], t.a[1], t.a[2]), Kernel::Point_3(t.b[0], t.b[1], t.b[2]),
                                   Kernel::Point_3(t.c[0], t.c[1], t.c[2]));
            surface.push_back(t.surface);
        }
    }
};

Answers by_tree(const Tree& tree, const Soup& soup, const std::vector<double>& points) {
    Answers out;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        const Kernel::Ray_3 down({points[i], points[i + 1], points[i + 2]}, Kernel::Direction_3(0, 0, -1));
        const auto found = tree.first_intersected_primitive(down);
        out.push_back(found ? soup.surface[static_cast<std::size_t>(*found - soup.triangles.begin())] : -1);
    }
    return out;
}

struct Runner {
    const char* name;
    std::function<Answers()> run;
    Answers answers;
    std::vector<double> seconds;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fputs("usage: drop_race FILE\n", stderr), 2;
    std::ifstream in(argv[1], std::ios::binary);
    const auto positions = read<double>(in);
    const auto surface_start = read<jk::Index>(in), surface_vertex = read<jk::Index>(in), leads_to = read<jk::Index>(in),
               sector_first = read<jk::Index>(in), sector_count = read<jk::Index>(in), passes_to = read<jk::Index>(in);
    const auto under_water = read<std::uint8_t>(in);
    const jk::Viewer viewer(
        jk::make_mesh(positions, surface_start, surface_vertex, leads_to, sector_first, sector_count));
    const jk::Faller faller(viewer.mesh(), viewer.fans(), passes_to, under_water);
    const Soup soup(viewer, passes_to);
    Tree tree(soup.triangles.begin(), soup.triangles.end());
    tree.build();
    for (const char* set : {"things", "random"}) {
        const auto points = read<double>(in);
        const auto sectors = read<jk::Index>(in);
        const std::vector<double> limits(sectors.size(), std::numeric_limits<double>::infinity());
        const auto ours = [&](jk::Tier tier) {
            return [&, tier] { return faller.drop(points, sectors, limits, tier, 1).met; };
        };
        std::vector<Runner> runners{{"balanced", ours(jk::Tier::kBalanced), {}, {}},
                                    {"fast", ours(jk::Tier::kFast), {}, {}},
                                    {"tree", [&] { return by_tree(tree, soup, points); }, {}, {}}};
        for (int round = 0; round < kRounds; ++round)
            for (Runner& runner : runners) {
                const auto start = std::chrono::steady_clock::now();
                runner.answers = runner.run();
                runner.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
            }
        const double rows = static_cast<double>(std::max<std::size_t>(1, sectors.size()));
        std::printf("{\"set\": \"%s\"", set);
        for (Runner& runner : runners) {
            std::size_t differ = 0;
            for (std::size_t i = 0; i < runner.answers.size(); ++i) differ += runner.answers[i] != runners[0].answers[i];
            std::nth_element(runner.seconds.begin(), runner.seconds.begin() + kRounds / 2, runner.seconds.end());
            std::printf(", \"%s\": %.2f, \"%s differs\": %.6f", runner.name, 1e9 * runner.seconds[kRounds / 2] / rows,
                        runner.name, static_cast<double>(differ) / rows);
        }
        std::puts("}");
    }
}
