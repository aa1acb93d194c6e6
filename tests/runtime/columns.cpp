// Makes every number of every column of geometry from its stored form, by `visit` and `form`, and compares it with what
// the column itself answers: columns FILE. Prints the columns whose numbers lie in a smaller type, and how many differ.
#include <cstdio>
#include <cstring>
#include <type_traits>
#include <vector>

#include "jklb/jklb.hpp"

namespace {

long wrong = 0, packed = 0, pooled = 0, grids = 0, runs = 0, absent = 0;

template <typename T>
void compare(const jklb::Column<T>& column, std::size_t width) {
    const jklb::ColumnForm form = column.form();
    wrong += form.width != static_cast<int>(width);
    std::vector<T> made;
    if (!form.has_values) {
        for (std::size_t i = 0; i < form.count * width; ++i)
            made.push_back(static_cast<T>(form.first + (form.follows ? static_cast<std::int64_t>(i) : 0)));
        ++(form.follows ? runs : absent);
    }
    column.visit([&](auto values, auto index) {
        using V = decltype(values[0]);
        packed += sizeof(V) < sizeof(T);
        pooled += index.size() != 0;
        grids += form.step != 0;
        const std::size_t rows = index.size() ? index.size() : form.count ? form.count : values.size() / width;
        for (std::size_t row = 0; row < rows; ++row)
            for (std::size_t lane = 0; lane < width; ++lane) {
                const std::size_t at = index.size() ? index[row] : form.count ? 0 : row;
                const V n = values[at * width + lane];
                const double origin = form.origin ? form.origin->Get(static_cast<unsigned>(lane)) : 0;
                made.push_back(form.step != 0 ? static_cast<T>((origin + static_cast<double>(n)) * form.step)
                                              : static_cast<T>(n));
            }
        if (const V* array = values.array()) wrong += values.size() && std::memcmp(array, values.data, sizeof(V));
    });
    const std::vector<T> all = column.all();
    wrong += all.size() != made.size() || (all.size() && std::memcmp(all.data(), made.data(), all.size() * sizeof(T)));
}

// Columns of so many numbers a row, as docs/format.md has it.
template <std::size_t width = 1, typename... Columns>
void compare_all(const Columns&... columns) {
    (compare(columns, width), ...);
}

}  // namespace

int main(int count, char** words) {
    std::string error;
    const auto level = count == 2 ? jklb::Level::open(words[1], error) : std::nullopt;
    if (!level) return std::fprintf(stderr, "%s\n", error.c_str()), 2;
    const jklb::Geometry& g = level->geometry();
    compare_all(g.adjoin_flags, g.adjoin_mirror, g.surface_material, g.surface_flags, g.surface_geometry_mode,
                g.surface_adjoin, g.surface_corner_start, g.corner_vertex, g.corner_light, g.sector_sound);
    compare_all<2>(g.texture_vertices);
    compare_all<3>(g.vertices, g.surface_normal, g.sector_tint);
    compare_all<6>(g.sector_bound_box);
    if (const auto& t = level->sections().templates) compare_all(t->source, t->base, t->own_text, t->list_number);
    if (const auto& v = level->sections().visibility) compare_all(v->sector, v->row_start);
    std::printf("wrong %ld, narrow %ld, pooled %ld, grids %ld, runs %ld, absent %ld\n", wrong, packed, pooled, grids, runs,
                absent);
    return wrong ? 1 : 0;
}
