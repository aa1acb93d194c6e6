// Words and numbers of one line, told apart exactly as grammars/jkl.lark does.
#pragma once

#include <charconv>
#include <cstdint>
#include <string_view>

namespace jk {

// What parts words: the blanks of the grammar and, for records that the engine reads as fields, commas.
constexpr bool is_separator(char c, bool commas) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v' || (commas && c == ',');
}

// Walks over the words of a line.
class Words {
public:
    Words(const char* begin, const char* end, bool commas) : at_(begin), end_(end), commas_(commas) {}

    // The next word, empty when the line ends.
    std::string_view next() {
        while (at_ < end_ && is_separator(*at_, commas_)) ++at_;
        const char* begin = at_;
        while (at_ < end_ && !is_separator(*at_, commas_)) ++at_;
        return {begin, static_cast<std::size_t>(at_ - begin)};
    }

    bool done() {
        while (at_ < end_ && is_separator(*at_, commas_)) ++at_;
        return at_ == end_;
    }

private:
    const char* at_;
    const char* end_;
    bool commas_;
};

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; }

// Whether a word is a keyword, given in lower case.
inline bool is_keyword(std::string_view word, std::string_view keyword) {
    if (word.size() != keyword.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i)
        if (lower(word[i]) != keyword[i]) return false;
    return true;
}

// Each of these reads a whole word, and answers false for one that the grammar does not take or whose value the
// engine's 32 bits do not hold: such a record goes to the grammar, which tells.

template <typename Integer>
bool read_digits(std::string_view digits, Integer& value, int base) {
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value, base);
    return error == std::errc() && stop == end;
}

// [-+]?[0-9]+
inline bool read_int(std::string_view word, std::int32_t& value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    else if (word.starts_with('-')) return word.size() > 1 && is_digit(word[1]) && read_digits(word, value, 10);
    return !word.empty() && is_digit(word[0]) && read_digits(word, value, 10);
}

// [-+]?[0-9]+:
inline bool read_label(std::string_view word, std::int32_t& value) {
    return word.ends_with(':') && read_int(word.substr(0, word.size() - 1), value);
}

// (0x)?[0-9a-f]+ in any case
inline bool read_hex(std::string_view word, std::uint32_t& value) {
    if (word.size() > 2 && word[0] == '0' && lower(word[1]) == 'x') word.remove_prefix(2);
    return !word.empty() && read_digits(word, value, 16);
}

// [-+]?([0-9]+\.?[0-9]*|\.[0-9]+)(e[-+]?[0-9]+)? in any case, rounded once
inline bool read_float(std::string_view word, float& value) {
    if (word.starts_with('+')) {
        word.remove_prefix(1);
        if (word.starts_with('-')) return false;
    }
    const std::size_t first = word.starts_with('-') ? 1 : 0;
    if (word.size() <= first || !(is_digit(word[first]) || word[first] == '.')) return false;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    return error == std::errc() && stop == end;
}

}  // namespace jk
