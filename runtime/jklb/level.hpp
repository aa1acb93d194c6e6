// A compiled level: opened, checked once, and read in place.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mapping.hpp"
#include "sections_generated.hpp"

namespace jklb {

// What a damaged file is refused for is told; a file that opens can be read everywhere without another check. The
// checksum is not compared: `jktools inspect --verify` does that.
class Level {
public:
    // Maps a file. Without a level, `error` is one sentence.
    static std::optional<Level> open(const std::string& path, std::string& error) {
        Mapping mapping;
        if (!mapping.open(path, error)) {
            error = "cannot read " + path + ": " + error;
            return std::nullopt;
        }
        const void* data = mapping.data();
        const std::size_t size = mapping.size();
        std::optional<Level> level = from_memory(data, size, error, path);
        if (level) level->mapping_ = std::move(mapping);
        return level;
    }

    // Reads a buffer that starts at a multiple of 8 bytes and outlives the level. `name` is for `error`.
    static std::optional<Level> from_memory(const void* data, std::size_t size, std::string& error,
                                            const std::string& name = "<memory>") {
        Level level;
        error = level.take(static_cast<const unsigned char*>(data), size);
        if (error.empty()) return level;
        error = "cannot read " + name + ": " + error;
        return std::nullopt;
    }

    // The FlatBuffers table, for what has no column: settings, inputs, passes, omissions, world.
    const jktools::Level& root() const { return *root_; }

    const Sections& sections() const { return sections_; }
    const Geometry& geometry() const { return *sections_.geometry; }

    std::size_t size() const { return size_; }
    std::size_t strings() const { return strings_; }

    // A text of the level in UTF-8, by the index that columns hold.
    std::string string(std::size_t index) const {
        if (!has_text()) return root_->strings()->Get(static_cast<unsigned>(index))->str();
        const std::uint8_t* octets = root_->text()->data();
        const std::uint8_t *at = octets + text_.text_start(index), *end = octets + text_.text_start(index + 1);
        if (symbols_.empty()) return {reinterpret_cast<const char*>(at), static_cast<std::size_t>(end - at) - 1};
        std::string text;
        for (; at != end; ++at) {
            if (*at < kFirstSymbol) text += static_cast<char>(*at);
            else if (*at == kEscape) text += static_cast<char>(*++at);
            else text += symbols_[*at - kFirstSymbol];
        }
        return text;
    }

private:
    static constexpr unsigned kFirstSymbol = 0x80, kEscape = 0xff;  // see Level.text in grammars/level.fbs
    static constexpr std::size_t kLongestSymbol = 255;

    bool has_text() const { return root_->format_minor() >= kTextSince; }

    // What is wrong with a buffer, or nothing.
    std::string take(const unsigned char* data, std::size_t size) {
        constexpr flatbuffers::uoffset_t kMostDepth = 16, kMostTables = 10'000'000;
        if (reinterpret_cast<std::uintptr_t>(data) % 8) return "the buffer does not start at a multiple of 8 bytes";
        if (size < 8 || !jktools::LevelBufferHasIdentifier(data)) return "not a compiled level (no JKLB mark)";
        if (size >= FLATBUFFERS_MAX_BUFFER_SIZE) return "the file is cut off or damaged; build it again";
        flatbuffers::Verifier verifier(data, size, kMostDepth, kMostTables);
        if (!jktools::VerifyLevelBuffer(verifier)) return "the file is cut off or damaged; build it again";
        root_ = jktools::GetLevel(data);
        size_ = size;
        if (root_->format_major() != kFormatMajor)
            return "format version " + version() + ", but this reader reads " + std::to_string(kFormatMajor) +
                   ".x; build it again or use another version";
        const std::string fault = check();
        if (fault.empty()) return fault;
        if (root_->format_minor() > kFormatMinor)
            return "it is of format " + version() + ", and this reader reads up to " + std::to_string(kFormatMajor) +
                   "." + std::to_string(kFormatMinor) + " of it; use a newer version (" + fault + ")";
        return "the file is damaged; build it again (" + fault + ")";
    }

    std::string version() const {
        return std::to_string(root_->format_major()) + "." + std::to_string(root_->format_minor());
    }

    std::string check() {
        const unsigned minor = root_->format_minor();
        Checks checks(size_);
        sections_ = Sections(*root_);
        if (!sections_.resources) return "has no resources";
        if (!sections_.geometry) return "has no geometry";
        strings_ = root_->strings()->size();
        if (has_text()) check_text(checks, minor);
        check_sections(checks, sections_, strings_, minor);
        if (checks.fault().empty()) check_surface_ranges(checks);
        if (checks.fault().empty()) check_bases(checks);
        if (has_text() && root_->omissions())
            for (const jktools::Omission* each : *root_->omissions())
                check_omission(checks, Omission(*each, minor), strings_);
        if (checks.fault().empty()) check_visible_rows(checks);
        return checks.fault();
    }

    // That the strings are cut in order, and either each has a zero byte behind it or all can be read by the symbols.
    void check_text(Checks& checks, unsigned minor) {
        text_ = Text(*root_, minor);
        check_level(checks, text_, minor);
        if (!checks.fault().empty()) return;
        strings_ = text_.text_start.rows() - 1;
        const std::vector<std::uint32_t> start = text_.text_start.all();
        const std::uint8_t* octets = root_->text() ? root_->text()->data() : nullptr;
        if (text_.symbols.rows()) return check_coded(checks, octets, start);
        bool good = strings_ == 0 || octets;
        for (std::size_t i = 0; good && i < strings_; ++i)
            good = start[i] < start[i + 1] && octets[start[i + 1] - 1] == 0;
        if (!good) checks.refuse("level.text should have a zero byte behind each string, but has not");
    }

    void check_coded(Checks& checks, const std::uint8_t* octets, const std::vector<std::uint32_t>& start) {
        if (!take_symbols())
            return checks.refuse("level.symbols should be up to 127 of up to 255 bytes, each with a zero byte behind it");
        const unsigned beyond = kFirstSymbol + static_cast<unsigned>(symbols_.size());
        for (std::size_t i = 0; i < strings_; ++i)
            for (std::size_t k = start[i]; k < start[i + 1]; ++k) {
                const unsigned code = octets[k];
                if (code < beyond) continue;
                if (code == kEscape && ++k < start[i + 1]) continue;
                return checks.refuse("level.text " + std::to_string(i) + " has the code " + std::to_string(code) +
                                     (code == kEscape ? ", but nothing behind it"
                                                      : ", but there are " + std::to_string(symbols_.size()) + " symbols"));
            }
    }

    // Cuts the symbols; whether they are sound.
    bool take_symbols() {
        const char* at = reinterpret_cast<const char*>(root_->symbols()->data());
        const char* end = at + root_->symbols()->size();
        while (at != end) {
            const void* zero = std::memchr(at, 0, static_cast<std::size_t>(end - at));
            const auto length = zero ? static_cast<std::size_t>(static_cast<const char*>(zero) - at) : 0;
            if (length == 0 || length > kLongestSymbol || symbols_.size() == kEscape - kFirstSymbol) return false;
            symbols_.emplace_back(at, length);
            at += length + 1;
        }
        return true;
    }

    // That every template rests on one before it, so that the way from base to base ends.
    void check_bases(Checks& checks) const {
        if (!sections_.templates) return;
        const Templates& t = *sections_.templates;
        for (std::size_t i = 0; i < t.base.rows(); ++i)
            if (t.base(i) >= static_cast<std::int64_t>(i))
                return checks.refuse("templates.base " + std::to_string(i) + " is " + std::to_string(t.base(i)) +
                                     ", which does not come before it");
    }

    void check_surface_ranges(Checks& checks) const {
        const Geometry& g = geometry();
        const auto there = static_cast<std::int64_t>(g.surface_flags.rows());
        for (std::size_t i = 0; i < g.sector_flags.rows(); ++i) {
            const std::int64_t first = g.sector_first_surface(i), count = g.sector_surface_count(i);
            if (first >= 0 && count >= 0 && first + count <= there) continue;
            return checks.refuse("geometry.sector_first_surface " + std::to_string(i) + " claims " +
                                 std::to_string(count) + " surfaces from " + std::to_string(first) +
                                 ", but there are " + std::to_string(there));
        }
    }

    // That every row of visible sectors expands to a bit for each sector.
    void check_visible_rows(Checks& checks) const {
        if (!sections_.visibility) return;
        const Visibility& v = *sections_.visibility;
        const std::size_t wanted = (geometry().sector_flags.rows() + 7) / 8;
        const std::vector<std::uint32_t> start = v.row_start.all();
        std::vector<std::uint8_t> made;
        const std::uint8_t* octets = v.row.plain();
        if (!octets) made = v.row.all(), octets = made.data();
        for (std::size_t i = 0; i < v.sector.rows(); ++i)
            if (!expands(octets + start[i], octets + start[i + 1], wanted))
                return checks.refuse("visibility.row " + std::to_string(i) + " does not expand to " +
                                     std::to_string(wanted) + " bytes");
    }

    // Whether a row of visible sectors stands for so many bytes: a zero is followed by how many zeros it stands for.
    static bool expands(const std::uint8_t* at, const std::uint8_t* end, std::size_t wanted) {
        std::size_t bytes = 0, run = 0;  // of the zeros before
        for (; at != end; ++at) {
            if (*at != 0) {
                ++bytes;
                run = 0;
                continue;
            }
            // A run that could be longer ends in 255; no run of none.
            if (++at == end || *at == 0 || (run != 0 && run != 255)) return false;
            bytes += run = *at;
        }
        return bytes == wanted;
    }

    Mapping mapping_;
    const jktools::Level* root_ = nullptr;
    std::size_t size_ = 0, strings_ = 0;
    Text text_;
    std::vector<std::string_view> symbols_;  // of the file
    Sections sections_;
};

}  // namespace jklb
