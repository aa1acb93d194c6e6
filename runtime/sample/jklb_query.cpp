// Asks a compiled level: from the command line, by lines from standard input, or in binary by the thousand.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <sstream>

#include "oracle.hpp"
#include "records.hpp"

namespace {

const char* const kUsage =
    "usage: jklb_query FILE                             what the level holds\n"
    "       jklb_query FILE QUESTION                    one answer\n"
    "       jklb_query FILE -                           a question a line from standard input, an answer a line\n"
    "       jklb_query FILE --binary QUERIES ANSWERS    records (see README.md) from and to files\n"
    "       jklb_query FILE --time                      how long it takes to open the file and answer once\n"
    "\n"
    "sight X Y Z SECTOR X Y Z         whether a point is seen from another; SECTOR may be ? to look it up\n"
    "drop X Y Z SECTOR [LIMIT]        what is straight below a point\n"
    "locate X Y Z                     the sector of a point\n"
    "visible SECTOR SECTOR            whether a sector may be seen from another\n"
    "ledges BODY SURFACE CORNER [T]   what a body meets beyond the edge of a floor, or at one place, 0 .. 1\n"
    "ledges-of-thing BODY THING FRAME FACE CORNER [T]\n"
    "                                 the same of a thing's face; FRAME may be placed\n"
    "leave BODY SURFACE X Y Z X Y Z   by which edge a body that moves from a point to another leaves a floor\n"
    "leave-thing BODY THING FRAME FACE X Y Z X Y Z CORNERS\n"
    "                                 the same of a thing's face, whose corners are at CORNERS: X Y Z of each\n"
    "basins BODY                      where a body can fall in, and what leads out\n"
    "basin BODY SURFACE               the same of the one that a floor lies in\n"
    "\n"
    "BODY is its number or the name of a template that has it.\n";

void summary(const std::string& path, const jklb::Level& level) {
    const jktools::Level& root = level.root();
    const jklb::Geometry& g = level.geometry();
    const auto count = [](const auto& section, auto column) { return section ? ((*section).*column).rows() : 0; };
    std::printf("%s: compiled level, format %u.%u, %zu bytes, of jktools %s for game %s, engine %s, accuracy %s\n",
                path.c_str(), root.format_major(), root.format_minor(), level.size(), root.tool_version()->c_str(),
                root.settings()->game()->c_str(), root.settings()->engine()->c_str(),
                root.settings()->accuracy()->c_str());
    std::printf("%zu vertices, %zu surfaces, %zu sectors, %zu adjoins, %zu things, %zu bodies, %zu ledges, %zu basins\n",
                g.vertices.rows(), g.surface_flags.rows(), g.sector_flags.rows(), g.adjoin_flags.rows(),
                count(level.sections().things, &jklb::Things::source),
                count(level.sections().ledges, &jklb::Ledges::body_movesize),
                count(level.sections().ledges, &jklb::Ledges::surface), count(level.sections().basins, &jklb::Basins::body));
}

Words words_of(const std::string& line) {
    std::istringstream stream(line);
    return {std::istream_iterator<std::string>(stream), {}};
}

int lines(const Oracle& oracle) {
    int status = 0;
    for (std::string line; std::getline(std::cin, line);) {
        const Words words = words_of(line);
        if (words.empty()) continue;
        try {
            std::cout << oracle.answer(words) << '\n';
        } catch (const Refused& refused) {
            std::cout << "refused: " << refused.why << '\n';
            status = 2;
        }
    }
    return status;
}

using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Opens the file again and again, makes its mesh and asks whether the first sector's first corner sees the last's; then
// makes locators.
int times(const std::string& path) {
    constexpr int kTimes = 51;
    const auto median = [](std::vector<double> values) {
        std::sort(values.begin(), values.end());
        return values[values.size() / 2];
    };
    std::vector<double> opened, answered, located;
    std::optional<jklb::Level> level;
    for (int i = 0; i < kTimes; ++i) {
        level.reset();
        const auto start = Clock::now();
        std::string error;
        level = jklb::Level::open(path, error);
        if (!level) throw Refused{error};
        opened.push_back(1e3 * seconds(start));
        const jklb::Mesh mesh(*level);
        if (mesh.surfaces() && mesh.corners(0) && mesh.corners(mesh.surfaces() - 1))
            jklb::sight(mesh, mesh.corner(0, 0), 0, mesh.corner(mesh.surfaces() - 1, 0));
        answered.push_back(1e3 * seconds(start));
    }
    const jklb::Mesh mesh(*level);
    for (int i = 0; i < kTimes; ++i) {
        const auto start = Clock::now();
        const jklb::Locator locator(mesh);
        located.push_back(1e3 * seconds(start));
    }
    std::printf("first %.3f ms to open, %.3f ms to the first answer; median of %d %.3f ms and %.3f ms; %.3f ms for a locator "
                "of %d sectors, %d surfaces\n",
                opened[0], answered[0], kTimes, median(opened), median(answered), median(located), mesh.sectors(),
                mesh.surfaces());
    return 0;
}

int run(const Words& arguments) {
    const std::string path = arguments[0], what = arguments.size() > 1 ? arguments[1] : "";
    const std::size_t more = arguments.size() - std::min<std::size_t>(arguments.size(), 2);
    if ((what == "-" || what == "--time") && more)
        throw Refused{what + " takes no words, not " + std::to_string(more)};
    if (what == "--binary" && more != 2) throw Refused{"--binary takes two files, not " + std::to_string(more)};
    if (what == "--time") return times(path);
    std::string error;
    const std::optional<jklb::Level> level = jklb::Level::open(path, error);
    if (!level) throw Refused{error};
    if (what.empty()) return summary(path, *level), 0;
    const Oracle oracle(*level);
    if (what == "-") return lines(oracle);
    if (what == "--binary") return binary(oracle, arguments[2], arguments[3]);
    std::cout << oracle.answer({arguments.begin() + 1, arguments.end()}) << '\n';
    return 0;
}

}  // namespace

int main(int count, char** words) {
    const Words arguments(words + 1, words + count);
    if (arguments.empty() || arguments[0] == "--help") {
        std::fputs(kUsage, arguments.empty() ? stderr : stdout);
        return arguments.empty() ? 2 : 0;
    }
    try {
        return run(arguments);
    } catch (const Refused& refused) {
        std::cerr << "jklb_query: error: " << refused.why << '\n';
        return 2;
    }
}
