#include "text/decimals.hpp"

#include <charconv>
#include <limits>
#include <stdexcept>
#include <string>

namespace jk {
namespace {

// from_chars leaves the value alone when it is out of float32's range; double's range and the sign of the
// exponent then tell on which side.
float beyond_range(const char* begin, const char* end) {
    double wide = 0;
    if (std::from_chars(begin, end, wide).ec == std::errc()) return static_cast<float>(wide);
    const std::string_view word(begin, static_cast<std::size_t>(end - begin));
    const std::size_t exponent = word.find_first_of("eE");
    const bool tiny = exponent != std::string_view::npos && word.substr(exponent + 1).starts_with('-');
    const float size = tiny ? 0.0f : std::numeric_limits<float>::infinity();
    return word.starts_with('-') ? -size : size;
}

}  // namespace

std::vector<float> decimals(std::string_view text) {
    std::vector<float> out;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at < end) {
        const char* stop = at;
        while (stop < end && *stop != ' ') ++stop;
        const char* const begin = at + (stop - at > 1 && *at == '+' && at[1] != '-');
        float value = 0;
        const auto [read, error] = std::from_chars(begin, stop, value);
        if (error == std::errc::result_out_of_range) {
            value = beyond_range(begin, stop);
        } else if (error != std::errc() || read != stop) {
            throw std::invalid_argument("word " + std::to_string(out.size()) + " is not a number: " +
                                        std::string(at, stop));
        }
        out.push_back(value);
        at = stop + 1;
    }
    return out;
}

}  // namespace jk
