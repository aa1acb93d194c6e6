// Whether a buffer is a well-formed compiled level.
#pragma once

#include <cstdint>
#include <span>

namespace jk {

// True when the buffer carries the identifier JKLB and every offset of it, followed from the root, stays inside
// the buffer. Says nothing of what the indices in it mean.
bool verify_level(std::span<const std::uint8_t> buffer);

}  // namespace jk
