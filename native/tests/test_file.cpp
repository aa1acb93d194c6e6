#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "file/verify.hpp"

TEST_CASE("what is no compiled level is refused") {
    CHECK_FALSE(jk::verify_level({}));
    CHECK_FALSE(jk::verify_level(std::vector<std::uint8_t>(7, 0)));
    std::vector<std::uint8_t> wild(64, 0xff);
    for (int i = 0; i < 4; ++i) wild[4 + i] = static_cast<std::uint8_t>("JKLB"[i]);
    CHECK_FALSE(jk::verify_level(wild));
}
