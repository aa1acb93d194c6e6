// Prints every value of every template of a compiled level: templates FILE.
#include <cstdio>

#include "jklb/jklb.hpp"

int main(int count, char** words) {
    std::string error;
    const auto level = count == 2 ? jklb::Level::open(words[1], error) : std::nullopt;
    if (!level) return std::fprintf(stderr, "%s\n", error.c_str()), 2;
    const jklb::TemplatesOf templates(*level);
    for (std::size_t row = 0; row < templates.rows(); ++row)
        for (const jklb::TemplateValue& each : templates.values(row)) {
            const auto found = templates.find(row, each.key);
            if (!found || found->first != each.first || found->text != each.text || found->setter != each.setter) return 1;
            std::printf("%zu\t%s\t%s\t%d", row, level->string(each.key).c_str(),
                        each.text < 0 ? "" : level->string(static_cast<std::size_t>(each.text)).c_str(), each.setter);
            for (std::size_t i = 0; i < each.count; ++i) std::printf("\t%a", templates.number(each.first + i));
            std::printf("\n");
        }
    return templates.find(templates.rows(), 0) ? 1 : 0;
}
