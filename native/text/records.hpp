// The well-formed records of a JKL straight into columns.
//
// A record that is not recognised to the letter is marked and left to the Lark grammar, which is the authority: these
// readers never guess, and what they take the grammar reads to the same values (a differential test holds them to it).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace jk {

// Lines of a text as half-open byte ranges; a line with end < start is joined from several physical lines and is
// never recognised.
struct Lines {
    std::string_view text;
    std::span<const std::int64_t> start, end;
};

// What a line is at its first word, as bits.
enum LineKind : std::uint8_t {
    kBlank = 1,    // nothing but separators of fields
    kSection = 2,  // section:
    kWorld = 4,    // world ...
    kEnd = 8,      // end
    kSector = 16,  // sector ...
};

std::vector<std::uint8_t> line_kinds(const Lines& lines);

// How many fields each line has, commas parting them.
std::vector<std::int32_t> word_counts(const Lines& lines);

// Fields of records of one form. Columns are row-major; rows that are not recognised hold zeros.
struct Fields {
    std::vector<std::uint8_t> recognised;
    std::vector<std::int64_t> ints;    // labels, whole numbers and flags, in the order of the form
    std::vector<float> floats;
    std::vector<std::int64_t> words;   // begin and end of each word
    std::vector<std::int64_t> tail_start{0}, tail;  // begin and end of each word behind the form
};

// Reads records of a form: one letter a field, L label, i whole number, h flags, f number, w word; a final * takes
// any number of words, and without it nothing may follow. commas: whether commas part fields.
// Throws std::invalid_argument on another letter.
Fields read_fields(const Lines& lines, std::string_view form, bool commas);

// Surfaces: nine whole numbers (label, material, surface flags, face flags, geometry, light and texture mode, adjoin,
// vertex count), extra light, the index pairs of the corners and one or four intensities a corner.
struct SurfaceRecords {
    std::vector<std::uint8_t> recognised;
    std::vector<std::int64_t> ints;
    std::vector<float> extra_light;
    std::vector<std::int32_t> corner_start{0}, pairs;
    std::vector<std::int32_t> light_start{0};
    std::vector<float> light;
};

SurfaceRecords read_surfaces(const Lines& lines);

// Sectors, each of its lines in the engine's order. Rows of `floats`: ambient light, extra light, tint (3), bound box
// (6), collide box (6, NaN where absent), sound volume, center (3), radius. Rows of `ints`: flags, colormap, first
// surface, surface count. `line_of` holds for each of the 13 kinds of line its index, -1 where absent.
struct SectorRecords {
    std::vector<std::int64_t> first_line;  // of each sector, and one past the last
    std::vector<std::uint8_t> recognised;
    std::vector<std::int64_t> ints;
    std::vector<float> floats;
    std::vector<std::int64_t> sound;  // begin and end of the name, -1 -1 where there is none
    std::vector<std::int32_t> line_of;
    std::vector<std::int32_t> vertex_start{0}, vertex, vertex_line;
};

constexpr int kSectorInts = 4, kSectorFloats = 22, kSectorLines = 13;

// Reads all lines as sectors; the first must be a `sector` line.
SectorRecords read_sectors(const Lines& lines);

}  // namespace jk
