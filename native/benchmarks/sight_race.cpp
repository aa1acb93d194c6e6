// Times `balanced` and `fast` against CGAL's AABB tree (EPICK) and Embree 3 on one level's queries, on one thread.
//
// The two soups hold every triangle of the surfaces that block, and know nothing of sectors: their disagreement with
// `balanced` is counted, not explained. Reads what benchmarks/bench_sight.py writes; prints one line of JSON a set.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#ifdef JKTOOLS_EMBREE
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>
#include <ctime>

#include "geometry/sight.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Answers = std::vector<std::uint8_t>;

constexpr int kRounds = 7;
constexpr std::size_t kPiece = 20000;  // queries timed at once

template <typename T>
std::vector<T> read(std::ifstream& in) {
    std::int64_t size = 0;
    in.read(reinterpret_cast<char*>(&size), sizeof size);
    std::vector<T> values(static_cast<std::size_t>(size));
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
    return values;
}

struct Set {
    explicit Set(std::ifstream& in)
        : origins(read<double>(in)), sectors(read<jk::Index>(in)), targets(read<double>(in)), aims(read<jk::Index>(in)) {}

    jk::Queries view() const { return {origins, sectors, targets, aims}; }

    std::vector<double> origins;
    std::vector<jk::Index> sectors;
    std::vector<double> targets;
    std::vector<jk::Index> aims;
};

jk::Queries piece_of(const jk::Queries& q, std::size_t first) {
    const std::size_t count = std::min(kPiece, q.rows() - first);
    return {q.origins.subspan(3 * first, 3 * count), q.sectors.subspan(first, count),
            q.targets.subspan(3 * first, 3 * count), q.aims.subspan(first, count)};
}

std::vector<Triangle> walls(const jk::SectorMesh& mesh) {
    const jk::Fans fans(mesh);
    std::vector<Triangle> out;
    for (std::size_t s = 0; s < mesh.sectors(); ++s)
        for (jk::Index f = mesh.sector_first[s]; f < mesh.sector_first[s] + mesh.sector_count[s]; ++f)
            for (jk::Index t = fans.start[f]; mesh.leads_to[f] == jk::kBlocks && t < fans.start[f + 1]; ++t) {
                const auto& k = fans.triangles[t];
                out.emplace_back(Kernel::Point_3(k.a[0], k.a[1], k.a[2]), Kernel::Point_3(k.b[0], k.b[1], k.b[2]),
                                 Kernel::Point_3(k.c[0], k.c[1], k.c[2]));
            }
    return out;
}

Answers by_tree(const Tree& tree, const jk::Queries& q) {
    Answers out(q.rows());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double *a = &q.origins[3 * i], *b = &q.targets[3 * i];
        out[i] = !tree.do_intersect(Kernel::Segment_3({a[0], a[1], a[2]}, {b[0], b[1], b[2]}));
    }
    return out;
}

#ifdef JKTOOLS_EMBREE
class Embree {
public:
    explicit Embree(const std::vector<Triangle>& triangles)
        : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * triangles.size()));
        auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), triangles.size()));
        for (std::size_t i = 0; i < 9 * triangles.size(); ++i)
            vertices[i] = static_cast<float>(triangles[i / 9][static_cast<int>(i / 3 % 3)][static_cast<int>(i % 3)]);
        for (std::size_t i = 0; i < 3 * triangles.size(); ++i) indices[i] = static_cast<unsigned>(i);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        rtcCommitScene(scene_);
    }
    ~Embree() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    Answers answer(const jk::Queries& q) const {
        Answers out(q.rows());
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const double *a = &q.origins[3 * i], *b = &q.targets[3 * i];
            RTCRay ray{};
            ray.org_x = static_cast<float>(a[0]), ray.org_y = static_cast<float>(a[1]);
            ray.org_z = static_cast<float>(a[2]);
            ray.dir_x = static_cast<float>(b[0] - a[0]), ray.dir_y = static_cast<float>(b[1] - a[1]);
            ray.dir_z = static_cast<float>(b[2] - a[2]);
            ray.tfar = 1;
            ray.mask = ~0u;
            rtcOccluded1(scene_, &context, &ray);
            out[i] = ray.tfar >= 0;
        }
        return out;
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};
#endif

struct Runner {
    const char* name;
    std::function<Answers(const jk::Queries&)> run;
    Answers answers{};
    double seconds = 0;
};

// The processor time of this thread, which other programs on the machine do not lengthen.
double seconds() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Every contestant answers a piece in turn, so that a busy moment of the machine hits all alike; the best round counts.
void race(std::vector<Runner>& runners, const jk::Queries& queries) {
    for (std::size_t first = 0; first < queries.rows(); first += kPiece) {
        const jk::Queries piece = piece_of(queries, first);
        std::vector<double> best(runners.size(), std::numeric_limits<double>::infinity());
        for (int round = 0; round < kRounds; ++round)
            for (std::size_t r = 0; r < runners.size(); ++r) {
                const double start = seconds();
                const Answers answers = runners[r].run(piece);
                best[r] = std::min(best[r], seconds() - start);
                if (round == 0) runners[r].answers.insert(runners[r].answers.end(), answers.begin(), answers.end());
            }
        for (std::size_t r = 0; r < runners.size(); ++r) runners[r].seconds += best[r];
    }
}

void print(const std::string& set, const std::vector<Runner>& runners) {
    const double rows = static_cast<double>(std::max<std::size_t>(1, runners[0].answers.size()));
    std::printf("{\"set\": \"%s\", \"queries\": %.0f", set.c_str(), rows);
    for (const Runner& runner : runners) {
        std::size_t differ = 0;
        for (std::size_t i = 0; i < runner.answers.size(); ++i) differ += runner.answers[i] != runners[0].answers[i];
        std::printf(", \"%s\": %.2f, \"%s differs\": %.6f", runner.name, 1e9 * runner.seconds / rows, runner.name,
                    static_cast<double>(differ) / rows);
    }
    std::puts("}");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fputs("usage: sight_race FILE\n", stderr), 2;
    std::ifstream in(argv[1], std::ios::binary);
    const auto positions = read<double>(in);
    const auto surface_start = read<jk::Index>(in), surface_vertex = read<jk::Index>(in), leads_to = read<jk::Index>(in),
               sector_first = read<jk::Index>(in), sector_count = read<jk::Index>(in);
    const jk::Viewer viewer(
        jk::make_mesh(positions, surface_start, surface_vertex, leads_to, sector_first, sector_count));
    const std::vector<Triangle> triangles = walls(viewer.mesh());
    Tree tree(triangles.begin(), triangles.end());
    tree.build();
#ifdef JKTOOLS_EMBREE
    const Embree embree(triangles);
#endif
    const auto rows = read<std::uint8_t>(in);
    const jk::VisibleRows known{rows, (viewer.mesh().sectors() + 7) / 8};
    for (const char* set : {"things", "random", "near"}) {
        const Set queries(in), aimed(in);
        const auto ours = [&](jk::Tier tier) {
            return [&, tier](const jk::Queries& q) {
                return viewer.sight({q.origins, q.sectors, q.targets}, tier, 1).visible;
            };
        };
        std::vector<Runner> runners{{"balanced", ours(jk::Tier::kBalanced)},
                                    {"fast", ours(jk::Tier::kFast)},
                                    {"tree", [&](const jk::Queries& q) { return by_tree(tree, q); }}};
        std::vector<Runner> seers{{"walked", [&](const jk::Queries& q) { return viewer.sees(q, {}, 1); }},
                                  {"sees", [&](const jk::Queries& q) { return viewer.sees(q, known, 1); }}};
#ifdef JKTOOLS_EMBREE
        runners.push_back({"embree", [&](const jk::Queries& q) { return embree.answer(q); }});
        seers.push_back({"embree", [&](const jk::Queries& q) { return embree.answer(q); }});
#endif
        race(runners, queries.view());
        race(seers, aimed.view());
        print(set, runners);
        print(set, seers);
    }
}
