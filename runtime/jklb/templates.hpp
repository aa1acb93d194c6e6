// What things are made of: every value that a template holds, its own and those of the templates that it rests on.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "level.hpp"

namespace jklb {

// One parameter of a template. Its name, and its text if it has one, are strings of the level.
struct TemplateValue {
    std::uint32_t key;         // the parameter, as `size`
    std::int32_t text;         // a name; -1 for what numbers tell
    std::int32_t setter;       // position of the template whose line set it; -1 for one of the game's static.jkl
    std::size_t first, count;  // its numbers are TemplatesOf::number(first) and on
};

// The templates of a level, by their rows. Reads files since 1.1; those of 1.0 hold no values. Keeps nothing of its own:
// as cheap to copy as the columns, and as safe to read from several threads.
class TemplatesOf {
public:
    explicit TemplatesOf(const Level& level) : minor_(level.root().format_minor()) {
        if (level.sections().templates) templates_ = *level.sections().templates;
    }

    std::size_t rows() const { return templates_.source.rows(); }

    // The value of a parameter, by the index of its name; nothing for one that is 0 or nothing.
    std::optional<TemplateValue> find(std::size_t row, std::uint32_t key) const {
        if (row >= rows()) return std::nullopt;
        for (std::int64_t at = static_cast<std::int64_t>(row); at >= 0; at = rests_on(static_cast<std::size_t>(at))) {
            const auto here = static_cast<std::size_t>(at);
            for (std::size_t i = start(here); i < start(here + 1); ++i)
                if (key_at(i) == key) return value(here, i);
        }
        return std::nullopt;
    }

    // All values of a template, by the index of the parameter's name.
    std::vector<TemplateValue> values(std::size_t row) const {
        std::vector<TemplateValue> found;
        if (row >= rows()) return found;
        for (std::int64_t at = static_cast<std::int64_t>(row); at >= 0; at = rests_on(static_cast<std::size_t>(at))) {
            const auto here = static_cast<std::size_t>(at);
            for (std::size_t i = start(here); i < start(here + 1); ++i) found.push_back(value(here, i));
        }
        // Of one key, the template's that is nearest comes first, and stays.
        const auto by_key = [](const TemplateValue& a, const TemplateValue& b) { return a.key < b.key; };
        const auto same = [](const TemplateValue& a, const TemplateValue& b) { return a.key == b.key; };
        std::stable_sort(found.begin(), found.end(), by_key);
        found.erase(std::unique(found.begin(), found.end(), same), found.end());
        return found;
    }

    double number(std::size_t place) const {
        return minor_ >= kListsSince ? templates_.list_number(place) : templates_.number(place);
    }

private:
    static constexpr unsigned kListsSince = 2, kBasesSince = 3;

    std::int64_t rests_on(std::size_t row) const { return minor_ >= kBasesSince ? templates_.base(row) : -1; }

    std::size_t start(std::size_t row) const {
        if (minor_ >= kBasesSince) return templates_.own_start(row);
        return templates_.value_start.rows() ? templates_.value_start(row) : 0;
    }

    std::uint32_t key_at(std::size_t i) const {
        return minor_ >= kBasesSince ? templates_.own_key(i) : templates_.value_key(i);
    }

    TemplateValue value(std::size_t row, std::size_t i) const {
        if (minor_ < kListsSince)
            return with_numbers(i, templates_.value_source(i), templates_.number_start, i);
        if (minor_ < kBasesSince)
            return with_numbers(i, templates_.value_source(i), templates_.list_start, templates_.value_list(i));
        const std::int32_t setter = templates_.own_setter(i);
        return with_numbers(i, setter == 0 ? templates_.source(row) : std::max(setter - 1, -1), templates_.list_start,
                            templates_.own_list(i));
    }

    TemplateValue with_numbers(std::size_t i, std::int32_t setter, const Column<std::uint32_t>& starts,
                               std::size_t list) const {
        const std::size_t first = starts(list);
        const std::int32_t text = minor_ >= kBasesSince ? templates_.own_text(i) : templates_.value_text(i);
        return {key_at(i), text, setter, first, starts(list + 1) - first};
    }

    Templates templates_;
    unsigned minor_;
};

}  // namespace jklb
