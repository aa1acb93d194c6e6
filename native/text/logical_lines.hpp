// Logical lines of a game text file, cut as the engine's configuration reader cuts them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace jk {

// What was noticed about a logical line, as bits.
enum LineFlag : std::uint8_t {
    kContinued = 1,      // joined from several physical lines by a backslash
    kCut = 2,            // the head of a physical line longer than the engine's buffer
    kTail = 4,           // the rest of such a line, which the engine reads as a line of its own
    kCommentInWord = 8,  // a '#' directly behind a character of a word, as in 1.#QNAN
};

// Logical line i is the concatenation of the segments line_segment[i] .. line_segment[i + 1] - 1, each a
// half-open range [segment_start, segment_end) of byte offsets. Comments and line ends lie outside.
struct LogicalLines {
    std::vector<std::int64_t> line_segment{0};
    std::vector<std::int64_t> segment_start;
    std::vector<std::int64_t> segment_end;
    std::vector<std::uint8_t> flags;
};

// Cuts a text into logical lines. buffer_size is the engine's line buffer in bytes (1024 in Jedi Knight, 2048
// in Mysteries of the Sith): one physical line is fetched in pieces of at most buffer_size - 1 bytes.
//
//   first byte of a piece is ';' '#' CR or LF   the piece is skipped
//   '#' anywhere                                the rest of the piece is cut
//   '\' two bytes before the end of what is left   the next piece that is not skipped is appended over it
//
// Throws std::invalid_argument when buffer_size < 2.
LogicalLines logical_lines(std::string_view text, std::size_t buffer_size);

}  // namespace jk
