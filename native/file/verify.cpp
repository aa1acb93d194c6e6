#include "file/verify.hpp"

#include "level_generated.h"

namespace jk {
namespace {

// A level is a handful of tables deep; a vector of tables holds at most a template or a thing each.
constexpr flatbuffers::uoffset_t kMostDepth = 16;
constexpr flatbuffers::uoffset_t kMostTables = 10'000'000;

// Length of the smallest buffer that holds a root offset and an identifier, bytes.
constexpr std::size_t kLeastSize = 8;

}  // namespace

bool verify_level(std::span<const std::uint8_t> buffer) {
    if (buffer.size() < kLeastSize) return false;
    flatbuffers::Verifier verifier(buffer.data(), buffer.size(), kMostDepth, kMostTables);
    return jktools::VerifyLevelBuffer(verifier);
}

}  // namespace jk
