#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "geometry/convexity.hpp"

namespace {

struct Level {
    std::vector<double> positions;
    std::vector<std::int32_t> surface_start{0}, surface_vertex, sector_first, sector_count, sector_start{0},
        sector_vertex;

    jk::Outside outside(std::vector<double> points, std::vector<std::int32_t> sectors) const {
        return jk::points_outside({positions, surface_start, surface_vertex, sector_first, sector_count,
                                   sector_start, sector_vertex}, points, sectors);
    }

    jk::Convexity convexity() const {
        return jk::sector_convexity({positions, surface_start, surface_vertex, sector_first, sector_count,
                                     sector_start, sector_vertex});
    }
};

// A unit cube with its faces wound counter-clockwise seen from inside.
Level cube() {
    Level level;
    for (int i = 0; i < 8; ++i)
        for (int axis = 0; axis < 3; ++axis) level.positions.push_back((i >> axis) & 1);
    const std::int32_t faces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (const auto& face : faces) {
        level.surface_vertex.insert(level.surface_vertex.end(), face, face + 4);
        level.surface_start.push_back(static_cast<std::int32_t>(level.surface_vertex.size()));
    }
    level.sector_first = {0};
    level.sector_count = {6};
    for (int i = 0; i < 8; ++i) level.sector_vertex.push_back(i);
    level.sector_start.push_back(8);
    return level;
}

}  // namespace

TEST_CASE("a cube is convex") {
    const auto found = cube().convexity();
    CHECK(found.behind[0] == 0);
    CHECK(found.surface[0] == -1);
    CHECK(found.distance[0] == 0.0);
}

TEST_CASE("one unit in the last place outside is behind, one inside is not") {
    Level level = cube();
    level.positions.insert(level.positions.end(), {0.5, 0.5, std::nextafter(1.0, 2.0)});
    level.sector_vertex.push_back(8);
    level.sector_start.back() = 9;
    auto found = level.convexity();
    CHECK(found.behind[0] == 1);
    CHECK(found.surface[0] == 1);
    CHECK(found.vertex[0] == 8);
    level.positions.back() = std::nextafter(1.0, 0.0);
    CHECK(level.convexity().behind[0] == 0);
}

TEST_CASE("the distance is measured in the level's unit") {
    Level level = cube();
    level.positions.insert(level.positions.end(), {0.5, 0.5, 1.25});
    level.sector_vertex.push_back(8);
    level.sector_start.back() = 9;
    CHECK(level.convexity().distance[0] == doctest::Approx(0.25));
}

TEST_CASE("a surface without a plane is passed over") {
    Level level = cube();
    level.surface_vertex[1] = 0;
    level.surface_vertex[2] = 0;
    CHECK(level.convexity().behind[0] == 0);
}

TEST_CASE("bad indices are refused") {
    Level level = cube();
    level.sector_vertex[0] = 8;
    CHECK_THROWS_AS(level.convexity(), std::invalid_argument);
    level = cube();
    level.sector_count[0] = 7;
    CHECK_THROWS_AS(level.convexity(), std::invalid_argument);
    level = cube();
    level.positions[4] = std::nan("");
    CHECK_THROWS_AS(level.convexity(), std::invalid_argument);
}

TEST_CASE("points outside their sector") {
    const Level level = cube();
    const auto found = level.outside({0.5, 0.5, 0.5, 1, 1, 1, 1.5, 0.5, 1.25, -1e-300, 0.5, 0.5}, {0, 0, 0, 0});
    CHECK(found.surface == std::vector<std::int32_t>{-1, -1, 5, 4});
    CHECK(found.distance[2] == doctest::Approx(0.5));
    CHECK_THROWS_AS(level.outside({0, 0, 0}, {1}), std::invalid_argument);
    CHECK_THROWS_AS(level.outside({0, 0, std::nan("")}, {0}), std::invalid_argument);
}
