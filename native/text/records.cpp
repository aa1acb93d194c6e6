#include "text/records.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "text/words.hpp"

namespace jk {
namespace {

bool is_whole(const Lines& lines, std::size_t i) { return lines.end[i] >= lines.start[i]; }

Words words_of(const Lines& lines, std::size_t i, bool commas) {
    return {lines.text.data() + lines.start[i], lines.text.data() + lines.end[i], commas};
}

// Where one record's values go; undone when the record turns out not to be recognised.
struct Row {
    std::int64_t* ints;
    float* floats;
    std::int64_t* words;
};

class FieldReader {
public:
    FieldReader(const Lines& lines, std::string_view form, bool commas)
        : lines_(lines), tail_(form.ends_with('*')), commas_(commas) {
        form_ = tail_ ? form.substr(0, form.size() - 1) : form;
        if (form_.find_first_not_of("Lihfw") != std::string_view::npos)
            throw std::invalid_argument("unknown letter in form " + std::string(form));
        floats_ = static_cast<std::size_t>(std::count(form_.begin(), form_.end(), 'f'));
        words_ = static_cast<std::size_t>(std::count(form_.begin(), form_.end(), 'w'));
        ints_ = form_.size() - floats_ - words_;
    }

    Fields read() {
        const std::size_t rows = lines_.start.size();
        out_.recognised.assign(rows, 0);
        out_.ints.assign(rows * ints_, 0);
        out_.floats.assign(rows * floats_, 0);
        out_.words.assign(rows * words_ * 2, 0);
        for (std::size_t i = 0; i < rows; ++i) {
            const std::size_t kept = out_.tail.size();
            out_.recognised[i] = is_whole(lines_, i) && row(i);
            if (!out_.recognised[i]) out_.tail.resize(kept);
            out_.tail_start.push_back(static_cast<std::int64_t>(out_.tail.size() / 2));
        }
        return std::move(out_);
    }

private:
    bool row(std::size_t i) {
        Words words = words_of(lines_, i, commas_);
        Row to{out_.ints.data() + i * ints_, out_.floats.data() + i * floats_, out_.words.data() + i * words_ * 2};
        for (const char letter : form_)
            if (!field(letter, words.next(), to)) return false;
        if (!tail_) return words.done();
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            out_.tail.push_back(word.data() - lines_.text.data());
            out_.tail.push_back(word.data() + word.size() - lines_.text.data());
        }
        return true;
    }

    bool field(char letter, std::string_view word, Row& to) {
        std::int32_t number = 0;
        std::uint32_t flags = 0;
        switch (letter) {
            case 'L': if (!read_label(word, number)) return false; *to.ints++ = number; return true;
            case 'i': if (!read_int(word, number)) return false; *to.ints++ = number; return true;
            case 'h': if (!read_hex(word, flags)) return false; *to.ints++ = flags; return true;
            case 'f': return read_float(word, *to.floats++);
            default:
                *to.words++ = word.data() - lines_.text.data();
                *to.words++ = word.data() + word.size() - lines_.text.data();
                return !word.empty();
        }
    }

    const Lines& lines_;
    std::string_view form_;
    bool tail_, commas_;
    std::size_t ints_ = 0, floats_ = 0, words_ = 0;
    Fields out_;
};

constexpr int kSurfaceInts = 9;
constexpr int kLightsPerCorner = 4;  // mono, red, green, blue

class SurfaceReader {
public:
    explicit SurfaceReader(const Lines& lines) : lines_(lines) {}

    SurfaceRecords read() {
        const std::size_t rows = lines_.start.size();
        out_.recognised.assign(rows, 0);
        out_.ints.assign(rows * kSurfaceInts, 0);
        out_.extra_light.assign(rows, 0);
        for (std::size_t i = 0; i < rows; ++i) {
            const std::size_t pairs = out_.pairs.size(), light = out_.light.size();
            out_.recognised[i] = is_whole(lines_, i) && row(i);
            if (!out_.recognised[i]) {
                out_.pairs.resize(pairs);
                out_.light.resize(light);
            }
            out_.corner_start.push_back(static_cast<std::int32_t>(out_.pairs.size() / 2));
            out_.light_start.push_back(static_cast<std::int32_t>(out_.light.size()));
        }
        return std::move(out_);
    }

private:
    bool row(std::size_t i) {
        Words words = words_of(lines_, i, true);
        std::int64_t* to = out_.ints.data() + i * kSurfaceInts;
        std::int32_t number = 0;
        std::uint32_t flags = 0;
        if (!read_label(words.next(), number)) return false;
        *to++ = number;
        if (!read_int(words.next(), number)) return false;
        *to++ = number;
        for (int k = 0; k < 2; ++k) {
            if (!read_hex(words.next(), flags)) return false;
            *to++ = flags;
        }
        for (int k = 0; k < 4; ++k) {
            if (!read_int(words.next(), number)) return false;
            *to++ = number;
        }
        if (!read_float(words.next(), out_.extra_light[i])) return false;
        if (!read_int(words.next(), number) || number < 0) return false;
        *to = number;
        return corners(words, number);
    }

    bool corners(Words& words, std::int32_t count) {
        std::int32_t index = 0;
        for (std::int64_t k = 0; k < 2 * std::int64_t{count}; ++k) {
            if (!read_int(words.next(), index)) return false;
            out_.pairs.push_back(index);
        }
        std::int64_t lights = 0;
        float value = 0;
        for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++lights) {
            if (!read_float(word, value)) return false;
            out_.light.push_back(value);
        }
        return lights == count || lights == std::int64_t{count} * kLightsPerCorner;
    }

    const Lines& lines_;
    SurfaceRecords out_;
};

// One sector's lines in the engine's order; `optional` ones may be missing.
struct SectorLine {
    std::string_view first, second;  // keywords; second empty where there is one
    bool optional;
};

constexpr SectorLine kSectorOrder[kSectorLines] = {
    {"sector", "", false},     {"flags", "", false},     {"ambient", "light", false}, {"extra", "light", false},
    {"colormap", "", false},   {"tint", "", true},       {"boundbox", "", false},     {"collidebox", "", true},
    {"sound", "", true},       {"center", "", false},    {"radius", "", false},       {"vertices", "", false},
    {"surfaces", "", false},
};
enum SectorLineIndex { kHead, kFlags, kAmbient, kExtra, kColormap, kTint, kBound, kCollide, kSound, kCenter, kRadius,
                       kVertices, kSurfaces };

class SectorReader {
public:
    explicit SectorReader(const Lines& lines) : lines_(lines) {}

    SectorRecords read() {
        const std::size_t count = lines_.start.size();
        for (std::size_t i = 0; i < count; ++i)
            if (is_whole(lines_, i) && is_keyword(words_of(lines_, i, false).next(), "sector"))
                out_.first_line.push_back(static_cast<std::int64_t>(i));
        const std::size_t sectors = out_.first_line.size();
        out_.first_line.push_back(static_cast<std::int64_t>(count));
        out_.recognised.assign(sectors, 0);
        out_.ints.assign(sectors * kSectorInts, 0);
        out_.floats.assign(sectors * kSectorFloats, 0);
        out_.sound.assign(sectors * 2, -1);
        out_.line_of.assign(sectors * kSectorLines, -1);
        for (std::size_t s = 0; s < sectors; ++s) {
            const std::size_t kept = out_.vertex.size();
            out_.recognised[s] = sector(s);
            if (!out_.recognised[s]) {
                out_.vertex.resize(kept);
                out_.vertex_line.resize(kept);
            }
            out_.vertex_start.push_back(static_cast<std::int32_t>(out_.vertex.size()));
        }
        return std::move(out_);
    }

private:
    bool sector(std::size_t s) {
        ints_ = out_.ints.data() + s * kSectorInts;
        floats_ = out_.floats.data() + s * kSectorFloats;
        std::fill_n(floats_ + kCollideAt, 6, std::numeric_limits<float>::quiet_NaN());
        at_ = static_cast<std::size_t>(out_.first_line[s]);
        last_ = static_cast<std::size_t>(out_.first_line[s + 1]);
        for (int kind = 0; kind < kSectorLines; ++kind) {
            if (at_ == last_) return false;
            Words words = words_of(lines_, at_, false);
            if (!is_whole(lines_, at_)) return false;
            const SectorLine& wanted = kSectorOrder[kind];
            if (!is_keyword(words.next(), wanted.first) ||
                (!wanted.second.empty() && !is_keyword(words.next(), wanted.second))) {
                if (!wanted.optional) return false;
                continue;
            }
            out_.line_of[s * kSectorLines + static_cast<std::size_t>(kind)] = static_cast<std::int32_t>(at_);
            if (!line(kind, words, s) || !words.done()) return false;
            ++at_;
            if (kind == kVertices && !vertices()) return false;
        }
        return at_ == last_;
    }

    static constexpr int kAmbientAt = 0, kExtraAt = 1, kTintAt = 2, kBoundAt = 5, kCollideAt = 11, kVolumeAt = 17,
                         kCenterAt = 18, kRadiusAt = 21;

    bool line(int kind, Words& words, std::size_t s) {
        std::int32_t number = 0;
        std::uint32_t flags = 0;
        switch (kind) {
            case kHead: return read_int(words.next(), number);
            case kFlags: if (!read_hex(words.next(), flags)) return false; ints_[0] = flags; return true;
            case kAmbient: return numbers(words, kAmbientAt, 1);
            case kExtra: return numbers(words, kExtraAt, 1);
            case kColormap: return whole(words, 1);
            case kTint: return numbers(words, kTintAt, 3);
            case kBound: return numbers(words, kBoundAt, 6);
            case kCollide: return numbers(words, kCollideAt, 6);
            case kSound: return sound(words, s);
            case kCenter: return numbers(words, kCenterAt, 3);
            case kRadius: return numbers(words, kRadiusAt, 1);
            case kVertices: return read_int(words.next(), announced_);
            default: return whole(words, 2) && whole(words, 3);
        }
    }

    bool numbers(Words& words, int at, int count) {
        for (int k = 0; k < count; ++k)
            if (!read_float(words.next(), floats_[at + k])) return false;
        return true;
    }

    bool whole(Words& words, int at) {
        std::int32_t number = 0;
        if (!read_int(words.next(), number)) return false;
        ints_[at] = number;
        return true;
    }

    // The one line of a sector that the engine does not take with a blank before it.
    bool sound(Words& words, std::size_t s) {
        if (is_separator(lines_.text[static_cast<std::size_t>(lines_.start[at_])], false)) return false;
        const std::string_view name = words.next();
        if (name.empty()) return false;
        out_.sound[2 * s] = name.data() - lines_.text.data();
        out_.sound[2 * s + 1] = name.data() + name.size() - lines_.text.data();
        return numbers(words, kVolumeAt, 1);
    }

    bool vertices() {
        std::int32_t label = 0, index = 0;
        for (std::int32_t k = 0; k < announced_; ++k, ++at_) {
            if (at_ == last_ || !is_whole(lines_, at_)) return false;
            Words words = words_of(lines_, at_, false);
            if (!read_label(words.next(), label) || !read_int(words.next(), index) || !words.done()) return false;
            out_.vertex.push_back(index);
            out_.vertex_line.push_back(static_cast<std::int32_t>(at_));
        }
        return announced_ >= 0;
    }

    const Lines& lines_;
    SectorRecords out_;
    std::int64_t* ints_ = nullptr;
    float* floats_ = nullptr;
    std::size_t at_ = 0, last_ = 0;
    std::int32_t announced_ = 0;
};

}  // namespace

std::vector<std::uint8_t> line_kinds(const Lines& lines) {
    std::vector<std::uint8_t> kinds(lines.start.size(), 0);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        if (!is_whole(lines, i)) continue;
        Words words = words_of(lines, i, true);
        const std::string_view word = words.next();
        std::uint8_t kind = 0;
        if (word.empty()) kind = kBlank;
        else if (word.size() >= 8 && is_keyword(word.substr(0, 8), "section:")) kind = kSection;
        else if (is_keyword(word, "world") && !words.done()) kind = kWorld;
        else if (is_keyword(word, "end")) kind = kEnd;
        else if (is_keyword(word, "sector")) kind = kSector;
        kinds[i] = kind;
    }
    return kinds;
}

std::vector<std::int32_t> word_counts(const Lines& lines) {
    std::vector<std::int32_t> counts(lines.start.size(), 0);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (!is_whole(lines, i)) continue;
        Words words = words_of(lines, i, true);
        while (!words.next().empty()) ++counts[i];
    }
    return counts;
}

Fields read_fields(const Lines& lines, std::string_view form, bool commas) {
    return FieldReader(lines, form, commas).read();
}

SurfaceRecords read_surfaces(const Lines& lines) { return SurfaceReader(lines).read(); }

SectorRecords read_sectors(const Lines& lines) { return SectorReader(lines).read(); }

}  // namespace jk
