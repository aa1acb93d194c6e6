#include "geometry/checks.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace jk {

void refuse(const char* what, std::size_t index, std::int64_t value) {
    throw std::invalid_argument(std::string(what) + " " + std::to_string(index) + " is out of bounds: " +
                                std::to_string(value));
}

void check_starts(const char* what, std::span<const std::int32_t> starts, std::size_t size) {
    if (starts.empty() || starts.front() != 0) refuse(what, 0, starts.empty() ? -1 : starts.front());
    for (std::size_t i = 1; i < starts.size(); ++i)
        if (starts[i] < starts[i - 1]) refuse(what, i, starts[i]);
    if (static_cast<std::size_t>(starts.back()) > size) refuse(what, starts.size() - 1, starts.back());
}

void check_indices(const char* what, std::span<const std::int32_t> indices, std::size_t count) {
    for (std::size_t i = 0; i < indices.size(); ++i)
        if (indices[i] < 0 || static_cast<std::size_t>(indices[i]) >= count) refuse(what, i, indices[i]);
}

void check_ranges(const char* what, std::span<const std::int32_t> first, std::span<const std::int32_t> count,
                  std::size_t size) {
    if (first.size() != count.size())
        throw std::invalid_argument(std::string(what) + " and its counts differ in length");
    for (std::size_t i = 0; i < first.size(); ++i) {
        const std::int64_t from = first[i], length = count[i];
        if (from < 0 || length < 0 || from + length > static_cast<std::int64_t>(size)) refuse(what, i, from);
    }
}

void check_finite(const char* what, std::span<const double> coordinates) {
    for (std::size_t i = 0; i < coordinates.size(); ++i)
        if (!std::isfinite(coordinates[i]))
            throw std::invalid_argument(std::string(what) + " " + std::to_string(i / 3) + " is not finite");
}

void check_coordinates(const char* what, std::span<const double> coordinates) {
    if (coordinates.size() % 3 != 0) throw std::invalid_argument(std::string(what) + "s must have shape (n, 3)");
    check_finite(what, coordinates);
    for (std::size_t i = 0; i < coordinates.size(); ++i)
        if (std::abs(coordinates[i]) >= kGreatestCoordinate)
            throw std::invalid_argument(std::string(what) + " " + std::to_string(i / 3) +
                                        " has a coordinate of 2^150 or more");
}

}  // namespace jk
