// Opens files that are damaged in every way that is tried, and asks those that open everything: damage FILE [STRIDE].
//
// Each byte is changed to several others, every length is cut, and every number of 4 bytes at a multiple of 4 becomes 0,
// -1, the greatest and one near them. A file is refused with a sentence, or answers. Prints how many did either; built
// with the sanitizers, which end the program at the first fault.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "jklb/jklb.hpp"

namespace {

using Bytes = std::vector<unsigned char>;

struct Tally {
    long refused = 0, answered = 0, silent = 0;
};

template <typename T>
void read(const jklb::Column<T>& c) {
    volatile T last = 0;
    for (std::size_t i = 0; i < c.rows(); ++i) last = c(i);
    (void)last;
}

void ask(const jklb::Level& level) {
    const jklb::Mesh mesh(level);
    const jklb::Locator locator(mesh);
    const jklb::VisibleSectors visible(level);
    const jklb::LedgesOf ledges(level);
    const double points[][3] = {{.5, .5, .5}, {.5, 1.5, .5}, {0, 0, 0}, {0, 1, 1}, {.25, 3, -2}};
    for (jklb::Index s = -1; s <= mesh.sectors() && s < 8; ++s) {
        for (const auto& from : points) {
            for (const auto& to : points) jklb::sight(mesh, from, s, to);
            jklb::drop(mesh, from, s);
            jklb::drop(mesh, from, s, 0.25);
        }
        for (jklb::Index other = -1; other <= mesh.sectors() && other < 8; ++other) visible(s, other);
    }
    for (const auto& point : points) locator(point);
    const jklb::BasinsOf basins(level);
    for (jklb::Index i = 0; i < basins.size(); ++i)
        for (jklb::Index k = 0; k < basins[i].count; ++k) basins.floor(basins[i].first + k);
    ledges.body("walkplayer");
    for (jklb::Index body = -1; body <= ledges.bodies() && body < 8; ++body) {
        for (jklb::Index surface = -1; surface <= mesh.surfaces() && surface < 16; ++surface) {
            for (jklb::Index corner = 0; corner < 4; ++corner) ledges.at(body, surface, corner, 0.5);
            for (const auto& from : points)
                for (const auto& to : points) ledges.leave(mesh, body, jklb::Floor::of_surface(surface), from, to);
            basins.at(body, surface);
        }
        for (jklb::Index thing = -1; thing < 4; ++thing) {
            ledges.of_thing(body, thing, -1, 0, 0, 0.5);
            const auto face = jklb::Floor::of_thing(thing, -1, 0, points[0], 5);
            ledges.leave(mesh, body, face, points[0], points[1]);
        }
    }
    for (std::size_t i = 0; i < level.strings(); ++i) level.string(i);
    if (const auto& t = level.sections().templates) read(t->value_text), read(t->number), read(t->list_number), read(t->own_list), read(t->base);
    if (const auto& t = level.sections().things) read(t->angles), read(t->template_);
    read(level.geometry().surface_normal), read(level.geometry().sector_tint);
}

// A copy of exactly this size, so that one byte beyond it is seen.
void attempt(const Bytes& bytes, std::size_t size, Tally& tally) {
    const std::unique_ptr<unsigned char[]> copy(new unsigned char[size ? size : 1]);
    if (size) std::memcpy(copy.get(), bytes.data(), size);
    std::string error;
    const std::optional<jklb::Level> level = jklb::Level::from_memory(copy.get(), size, error);
    if (!level) {
        ++tally.refused;
        tally.silent += error.rfind("cannot read <memory>: ", 0) != 0;
        return;
    }
    ++tally.answered;
    ask(*level);
}

}  // namespace

int main(int count, char** words) {
    if (count < 2) return 2;
    std::ifstream in(words[1], std::ios::binary);
    Bytes bytes{std::istreambuf_iterator<char>(in), {}};
    const std::size_t stride = count > 2 ? std::strtoul(words[2], nullptr, 10) : 1;
    Tally whole, flipped, cut, numbers;
    attempt(bytes, bytes.size(), whole);
    for (std::size_t i = 0; i < bytes.size(); i += stride) {
        const unsigned char kept = bytes[i];
        for (const int change : {0x01, 0x10, 0x80, 0xff}) {
            bytes[i] = static_cast<unsigned char>(kept ^ change);
            attempt(bytes, bytes.size(), flipped);
        }
        bytes[i] = kept;
        attempt(bytes, i, cut);
    }
    for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4 * stride) {
        std::uint32_t kept;
        std::memcpy(&kept, &bytes[i], sizeof kept);
        for (const std::uint32_t value : {0u, 0xffffffffu, 0x7fffffffu, 0x80000000u, kept + 1, kept - 1, kept * 2}) {
            std::memcpy(&bytes[i], &value, sizeof value);
            attempt(bytes, bytes.size(), numbers);
        }
        std::memcpy(&bytes[i], &kept, sizeof kept);
    }
    for (const auto& [name, tally] : {std::pair{"whole", whole}, {"flipped", flipped}, {"cut", cut}, {"numbers", numbers}})
        std::printf("%s: %ld answered, %ld refused\n", name, tally.answered, tally.refused);
    return flipped.silent + cut.silent + numbers.silent ? 1 : 0;
}
