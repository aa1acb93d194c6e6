// Checks of what callers hand in. Each throws std::invalid_argument that names the index at fault.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace jk {

// Throws: "WHAT INDEX is out of bounds: VALUE".
[[noreturn]] void refuse(const char* what, std::size_t index, std::int64_t value);

// Rising offsets into an array of `size` entries, the first 0.
void check_starts(const char* what, std::span<const std::int32_t> starts, std::size_t size);

// Every index in [0, count).
void check_indices(const char* what, std::span<const std::int32_t> indices, std::size_t count);

// Every range [first[i], first[i] + count[i]) within [0, size).
void check_ranges(const char* what, std::span<const std::int32_t> first, std::span<const std::int32_t> count,
                  std::size_t size);

// Triples of finite numbers; names the triple.
void check_finite(const char* what, std::span<const double> coordinates);

// Products of six differences of coordinates below this, JKU, do not overflow a double.
inline constexpr double kGreatestCoordinate = 0x1p150;

// Whole triples of finite numbers below kGreatestCoordinate; names the triple.
void check_coordinates(const char* what, std::span<const double> coordinates);

}  // namespace jk
