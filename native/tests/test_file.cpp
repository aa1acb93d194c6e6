#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "file/parts.hpp"

TEST_CASE("what is no compiled level is refused") {
    CHECK(jk::level_fault({}) == "not a compiled level (no JKLB mark)");
    alignas(8) std::uint8_t wild[64];
    for (auto& octet : wild) octet = 0xff;
    CHECK(jk::level_fault({wild, 7}) == "not a compiled level (no JKLB mark)");
    for (int i = 0; i < 4; ++i) wild[4 + i] = static_cast<std::uint8_t>("JKLB"[i]);
    CHECK(jk::level_fault(wild) == "the file is cut off or damaged; build it again");
    CHECK(jk::level_fault({wild + 1, 63}) == "the buffer does not start at a multiple of 8 bytes");
}
