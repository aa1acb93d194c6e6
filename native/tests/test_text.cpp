#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "text/decimals.hpp"
#include "text/logical_lines.hpp"

namespace {

std::vector<std::string> lines(std::string_view text, std::size_t buffer = 1024) {
    const jk::LogicalLines cut = jk::logical_lines(text, buffer);
    std::vector<std::string> out;
    for (std::size_t i = 0; i + 1 < cut.line_segment.size(); ++i) {
        std::string line;
        for (auto s = cut.line_segment[i]; s < cut.line_segment[i + 1]; ++s)
            line += text.substr(cut.segment_start[s], cut.segment_end[s] - cut.segment_start[s]);
        out.push_back(line);
    }
    return out;
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("comment and empty lines are skipped, blank ones are not") {
    CHECK(lines("# a\n; b\n\r\n\n  \nx ; y\r\n") == Lines{"  ", "x ; y"});
}

TEST_CASE("a hash cuts the line anywhere") {
    CHECK(lines("0: 1.#QNAN 2\n1: 2 # c\n") == Lines{"0: 1.", "1: 2 "});
    CHECK(jk::logical_lines("0: 1.#QNAN\n", 1024).flags[0] == jk::kCommentInWord);
    CHECK(jk::logical_lines("0: 1 #c\n", 1024).flags[0] == 0);
}

TEST_CASE("a backslash directly before the line feed continues the line") {
    CHECK(lines("a \\\n# skipped\nb\nc") == Lines{"a b", "c"});
    CHECK(lines("a \\\r\nb\n") == Lines{"a \\", "b"});
    CHECK(lines("a\\ # text\nb\n") == Lines{"ab"});
    CHECK(lines("a\\\n") == Lines{"a"});
}

TEST_CASE("a line over the buffer is read in pieces") {
    CHECK(lines("abcdefg\nh\n", 5) == Lines{"abcd", "efg", "h"});
    const auto flags = jk::logical_lines("abcdefg\nh\n", 5).flags;
    CHECK(flags == std::vector<std::uint8_t>{jk::kCut, jk::kTail, 0});
    CHECK_THROWS_AS(jk::logical_lines("a", 1), std::invalid_argument);
}

TEST_CASE("a line that fills the buffer exactly leaves its line feed behind as an empty piece") {
    CHECK(lines("abcd\nx\n", 5) == Lines{"abcd", "x"});
}

TEST_CASE("decimals in every spelling of the game") {
    CHECK(jk::decimals("1 .5 -.5e-3 +1 1e3 5. -0.000000") == std::vector<float>{1, .5f, -.5e-3f, 1, 1000, 5, 0});
    CHECK(jk::decimals("").empty());
    CHECK(std::isnan(jk::decimals("nan")[0]));
    CHECK_THROWS_AS(jk::decimals("1 2x"), std::invalid_argument);
    CHECK_THROWS_AS(jk::decimals("1  2"), std::invalid_argument);
    CHECK_THROWS_AS(jk::decimals("+-1"), std::invalid_argument);
}

TEST_CASE("a decimal is rounded once") {
    // Just above the midpoint of 1 and 1 + 2^-23: to double it becomes that midpoint, and then goes down to even.
    CHECK(jk::decimals("1.00000005960464477539062500001")[0] == std::nextafter(1.0f, 2.0f));
}

TEST_CASE("what float32 cannot hold") {
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK(jk::decimals("1e39 -1e39 1e999 -1e-999 1e-46") == std::vector<float>{infinity, -infinity, infinity, 0, 0});
}
