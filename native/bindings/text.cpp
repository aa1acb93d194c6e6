// The door to native/text.
#include <nanobind/stl/tuple.h>

#include "arrays.hpp"
#include "text/decimals.hpp"
#include "text/logical_lines.hpp"

namespace nb = nanobind;

NB_MODULE(_native_text, m) {
    m.doc() = "Native reading of game text; only jktools.syntax imports it.";
    m.attr("CONTINUED") = static_cast<int>(jk::kContinued);
    m.attr("CUT") = static_cast<int>(jk::kCut);
    m.attr("TAIL") = static_cast<int>(jk::kTail);
    m.attr("COMMENT_IN_WORD") = static_cast<int>(jk::kCommentInWord);
    m.def(
        "logical_lines",
        [](jk::Array<std::uint8_t> text, std::size_t buffer_size) {
            jk::LogicalLines lines;
            {
                nb::gil_scoped_release release;
                lines = jk::logical_lines({reinterpret_cast<const char*>(text.data()), text.size()}, buffer_size);
            }
            return std::make_tuple(jk::hand_over(std::move(lines.line_segment)),
                                   jk::hand_over(std::move(lines.segment_start)),
                                   jk::hand_over(std::move(lines.segment_end)), jk::hand_over(std::move(lines.flags)));
        },
        nb::arg("text"), nb::arg("buffer_size"),
        "Cut a text into logical lines as the engine does.\n\n"
        "Returns (line_segment (n+1,) int64, segment_start (m,) int64, segment_end (m,) int64, flags (n,) uint8):\n"
        "line i is the concatenation of the byte ranges segment_start[k]:segment_end[k] for k in\n"
        "line_segment[i]:line_segment[i+1]. Raises ValueError when buffer_size is below 2.");
    m.def(
        "decimals",
        [](jk::Array<std::uint8_t> text) {
            std::vector<float> values;
            {
                nb::gil_scoped_release release;
                values = jk::decimals({reinterpret_cast<const char*>(text.data()), text.size()});
            }
            return jk::hand_over(std::move(values));
        },
        nb::arg("text"),
        "Read numbers parted by single blanks, each rounded once to float32.\n\n"
        "Returns (n,) float32; too large becomes infinity. Raises ValueError naming the word that is no number.");
}
