// Where the columns of a compiled level lie in its buffer, and whether they can be read.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace jk {

// What is wrong with a buffer as the runtime's reader tells it (runtime/jklb), in one sentence; empty for a compiled
// level that can be read everywhere. The buffer must start at a multiple of 8 bytes.
std::string level_fault(std::span<const std::uint8_t> buffer);

// A column that is asked for: the offset in the table's vtable of its section (0: the level itself), of its plain
// vector, and of its packed form (0: it has none).
struct Wanted {
    std::uint16_t section, plain, packed;
};

// How many numbers tell of one column; see `parts_of`.
constexpr std::size_t kPart = 10;

// For each column, of a buffer without a fault: form, place, length, index size, index place, index length, count,
// first, origin place, origin length. Form: -2 the section is absent, -1 the column is, 0 it is plain, 1 packed without
// values, 2 .. 9 packed with the values of the vector i8 u8 i16 u16 i32 u32 f32 f64. Places count bytes of the buffer,
// lengths numbers, the index size its bytes a number. `steps` has the step of each grid, else 0.
std::vector<std::int64_t> parts_of(std::span<const std::uint8_t> buffer, std::span<const Wanted> columns,
                                   std::vector<double>& steps);

}  // namespace jk
