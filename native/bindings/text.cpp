// The door to native/text.
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>

#include <string>

#include "arrays.hpp"
#include "text/decimals.hpp"
#include "text/logical_lines.hpp"
#include "text/records.hpp"

namespace nb = nanobind;

namespace {

using Text = jk::Array<std::uint8_t>;
using Offsets = jk::Array<std::int64_t>;

// Lines checked against the text, so that the library may trust them.
jk::Lines lines_of(const Text& text, const Offsets& start, const Offsets& end) {
    if (start.size() != end.size()) throw nb::value_error("start and end must have one entry a line");
    const auto size = static_cast<std::int64_t>(text.size());
    for (std::size_t i = 0; i < start.size(); ++i)
        if (end(i) >= start(i) && (start(i) < 0 || end(i) > size))
            throw nb::value_error(("line " + std::to_string(i) + " lies outside the text").c_str());
    return {{reinterpret_cast<const char*>(text.data()), text.size()}, jk::view(start), jk::view(end)};
}

}  // namespace

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
    m.attr("BLANK") = static_cast<int>(jk::kBlank);
    m.attr("SECTION") = static_cast<int>(jk::kSection);
    m.attr("WORLD") = static_cast<int>(jk::kWorld);
    m.attr("END") = static_cast<int>(jk::kEnd);
    m.attr("SECTOR") = static_cast<int>(jk::kSector);
    m.def(
        "line_kinds",
        [](Text text, Offsets start, Offsets end) {
            return jk::hand_over(jk::line_kinds(lines_of(text, start, end)));
        },
        nb::arg("text"), nb::arg("start"), nb::arg("end"),
        "What each line is at its first word: (n,) uint8 of BLANK, SECTION, WORLD, END, SECTOR or 0.");
    m.def(
        "word_counts",
        [](Text text, Offsets start, Offsets end) {
            return jk::hand_over(jk::word_counts(lines_of(text, start, end)));
        },
        nb::arg("text"), nb::arg("start"), nb::arg("end"), "How many fields each line has: (n,) int32.");
    m.def(
        "read_fields",
        [](Text text, Offsets start, Offsets end, std::string_view form, bool commas) {
            const jk::Lines lines = lines_of(text, start, end);
            jk::Fields f;
            {
                nb::gil_scoped_release release;
                f = jk::read_fields(lines, form, commas);
            }
            return std::make_tuple(jk::hand_over(std::move(f.recognised)), jk::hand_over(std::move(f.ints)),
                                   jk::hand_over(std::move(f.floats)), jk::hand_over(std::move(f.words)),
                                   jk::hand_over(std::move(f.tail_start)), jk::hand_over(std::move(f.tail)));
        },
        nb::arg("text"), nb::arg("start"), nb::arg("end"), nb::arg("form"), nb::arg("commas"),
        "Read records of one form: a letter a field (L label, i whole number, h flags, f number, w word), * a tail.\n\n"
        "Returns (recognised (n,) uint8, ints (n*i,) int64, floats (n*f,) float32, words (2*n*w,) int64 begins and ends,\n"
        "tail_start (n+1,) int64, tail (2*m,) int64). Rows that are not recognised to the letter mean nothing.\n"
        "Raises ValueError for an unknown letter or a line outside the text.");
    m.def(
        "read_surfaces",
        [](Text text, Offsets start, Offsets end) {
            const jk::Lines lines = lines_of(text, start, end);
            jk::SurfaceRecords r;
            {
                nb::gil_scoped_release release;
                r = jk::read_surfaces(lines);
            }
            return std::make_tuple(jk::hand_over(std::move(r.recognised)), jk::hand_over(std::move(r.ints)),
                                   jk::hand_over(std::move(r.extra_light)), jk::hand_over(std::move(r.corner_start)),
                                   jk::hand_over(std::move(r.pairs)), jk::hand_over(std::move(r.light_start)),
                                   jk::hand_over(std::move(r.light)));
        },
        nb::arg("text"), nb::arg("start"), nb::arg("end"),
        "Read surfaces: (recognised, ints (9n,) int64, extra_light, corner_start, pairs, light_start, light).");
    m.def(
        "read_sectors",
        [](Text text, Offsets start, Offsets end) {
            const jk::Lines lines = lines_of(text, start, end);
            jk::SectorRecords r;
            {
                nb::gil_scoped_release release;
                r = jk::read_sectors(lines);
            }
            return std::make_tuple(jk::hand_over(std::move(r.first_line)), jk::hand_over(std::move(r.recognised)),
                                   jk::hand_over(std::move(r.ints)), jk::hand_over(std::move(r.floats)),
                                   jk::hand_over(std::move(r.sound)), jk::hand_over(std::move(r.line_of)),
                                   jk::hand_over(std::move(r.vertex_start)), jk::hand_over(std::move(r.vertex)),
                                   jk::hand_over(std::move(r.vertex_line)));
        },
        nb::arg("text"), nb::arg("start"), nb::arg("end"),
        "Read sectors: (first_line, recognised, ints (4n,), floats (22n,), sound (2n,), line_of (13n,), vertex_start,\n"
        "vertex, vertex_line); the order of the values is that of native/text/records.hpp.");
}
