// Asks a compiled level: from the command line, by lines from standard input, or in binary by the thousand.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "jklb/jklb.hpp"

namespace {

using jklb::Index;
using Words = std::vector<std::string>;

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
    "basins BODY                      where a body can fall in, and what leads out\n";

const char* const kEndings[] = {"floor", "solid", "water", "far", "nothing", "unknown"};
const char* const kLedges[] = {"level", "seamless", "fall", "water", "none", "step", "lip", "jump", "wall", "unknown"};

struct Refused {
    std::string why;
};

double number(const std::string& word) {
    char* end;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || *end) throw Refused{"'" + word + "' is no number"};
    return value;
}

Index index(const std::string& word) {
    const double value = number(word);
    if (!(value >= -1 && value <= 2147483647) || value != static_cast<Index>(value))
        throw Refused{"'" + word + "' is no index"};
    return static_cast<Index>(value);
}

std::string text(double value) {
    char out[32];
    std::snprintf(out, sizeof out, "%.9g", value);
    return out;
}

// A level with all that its answers need.
class Oracle {
public:
    explicit Oracle(const jklb::Level& level) : level_(level), mesh_(level), visible_(level), ledges_(level) {}

    std::string answer(const Words& words) const {
        static const std::map<std::string, std::pair<std::string (Oracle::*)(const Words&) const, std::size_t>> known{
            {"sight", {&Oracle::sight, 8}},     {"drop", {&Oracle::drop, 5}},     {"locate", {&Oracle::locate, 4}},
            {"visible", {&Oracle::visible, 3}}, {"ledges", {&Oracle::ledges, 4}}, {"basins", {&Oracle::basins, 2}},
        };
        const auto found = known.find(words[0]);
        if (found == known.end()) throw Refused{"no question '" + words[0] + "'; ask without one for help"};
        const std::size_t least = found->second.second, most = least + (words[0] == "drop" || words[0] == "ledges");
        if (words.size() < least || words.size() > most)
            throw Refused{words[0] + " takes " + std::to_string(least - 1) + (most > least ? " or more" : "") +
                          " words, not " + std::to_string(words.size() - 1)};
        return (this->*found->second.first)(words);
    }

    const jklb::Mesh& mesh() const { return mesh_; }
    const jklb::VisibleSectors& sees() const { return visible_; }

    const jklb::Locator& locator() const {
        if (!locator_) locator_ = std::make_unique<jklb::Locator>(mesh_);
        return *locator_;
    }

private:
    struct Place {
        double p[3];
    };

    static Place place(const Words& words, std::size_t at) {
        const Place found{{number(words[at]), number(words[at + 1]), number(words[at + 2])}};
        if (!jklb::Mesh::takes(found.p)) throw Refused{"a coordinate is not finite or 2^150 or more"};
        return found;
    }

    Index sector(const std::string& word, const Place& place) const {
        const Index found = word == "?" ? locator()(place.p).sector : index(word);
        if (word == "?" && found < 0) throw Refused{"the point lies in no sector"};
        if (!mesh_.takes(found))
            throw Refused{"sector " + word + " does not exist: there are " + std::to_string(mesh_.sectors())};
        return found;
    }

    Index body(const std::string& word) const {
        const Index found = index(word);
        if (found < 0 || found >= ledges_.bodies())
            throw Refused{"body " + word + " does not exist: there are " + std::to_string(ledges_.bodies())};
        if (!ledges_.known(found))
            throw Refused{"how high body " + word + " floats was not known when the level was compiled"};
        return found;
    }

    std::string sight(const Words& words) const {
        const Place from = place(words, 1), to = place(words, 5);
        const jklb::Sight seen = jklb::sight(mesh_, from.p, sector(words[4], from), to.p);
        const std::string way = std::to_string(seen.crossed) + (seen.crossed == 1 ? " sector" : " sectors");
        if (!seen.crossed) return "unknown: the sector cannot be computed with";
        return seen.visible ? "visible through " + way
                            : "blocked by surface " + std::to_string(seen.blocker) + " after " + way;
    }

    std::string drop(const Words& words) const {
        const Place from = place(words, 1);
        const double limit = words.size() > 5 ? number(words[5]) : HUGE_VAL;
        if (!(limit >= 0)) throw Refused{"the limit is negative or not a number"};
        const jklb::Drop found = jklb::drop(mesh_, from.p, sector(words[4], from), limit);
        std::string told = kEndings[static_cast<int>(found.ending)];
        if (found.met >= 0) told += " surface " + std::to_string(found.met);
        told += " in sector " + std::to_string(found.sector);
        return found.ending == jklb::Ending::kUnknown ? told : told + ", " + text(found.distance) + " JKU down";
    }

    std::string locate(const Words& words) const {
        const jklb::Location found = locator()(place(words, 1).p);
        if (found.sector < 0) return "in no sector";
        return "sector " + std::to_string(found.sector) + ", inside " + std::to_string(found.inside) + ", on the boundary of " +
               std::to_string(found.touching);
    }

    std::string visible(const Words& words) const {
        return visible_(index(words[1]), index(words[2])) ? "may be visible" : "not visible";
    }

    std::string ledges(const Words& words) const {
        const Index body = this->body(words[1]), surface = index(words[2]), corner = index(words[3]);
        if (surface < 0 || surface >= mesh_.surfaces())
            throw Refused{"surface " + words[2] + " does not exist: there are " + std::to_string(mesh_.surfaces())};
        if (mesh_.passes_to(surface) != jklb::kCarries) throw Refused{"surface " + words[2] + " is no floor"};
        if (corner < 0 || corner >= mesh_.corners(surface))
            throw Refused{"corner " + words[3] + " does not exist: there are " + std::to_string(mesh_.corners(surface))};
        const double place = words.size() > 4 ? number(words[4]) : 0;
        if (!(place >= 0 && place <= 1)) throw Refused{words[4] + " is no place on an edge: they go from 0 to 1"};
        std::string told;
        for (const jklb::Ledge& each : ledges_.at(body, surface, corner)) {
            if (words.size() > 4 && !(each.start <= place && place <= each.end)) continue;
            told += (told.empty() ? "" : "; ") + text(each.start) + " to " + text(each.end) + " " +
                    (each.kind <= jklb::LedgeKind::kUnknown ? kLedges[static_cast<int>(each.kind)] : "?");
            if (each.below >= 0) told += ", surface " + std::to_string(each.below);
            if (each.onto >= 0) told += ", face " + std::to_string(each.onto_face) + " of thing " + std::to_string(each.onto);
            if (each.drop_start == each.drop_start)
                told += ", " + text(each.drop_start) + " to " + text(each.drop_end) + " JKU down";
            if (words.size() > 4) break;
        }
        return told.empty() ? "level" : told;
    }

    std::string basins(const Words& words) const {
        std::ostringstream told;
        for (const jklb::Basin& each : jklb::basins(level_, body(words[1])))
            told << (told.tellp() ? "; " : "") << each.surfaces.size() << " floors from surface "
                 << (each.surfaces.empty() ? -1 : each.surfaces[0]) << ", " << text(each.shallowest) << " to "
                 << text(each.deepest) << " JKU deep, entered 0x" << std::hex << int{each.entered} << ", left 0x"
                 << int{each.left} << std::dec;
        return told.tellp() ? told.str() : "none";
    }

    const jklb::Level& level_;
    const jklb::Mesh mesh_;
    const jklb::VisibleSectors visible_;
    const jklb::LedgesOf ledges_;
    mutable std::unique_ptr<jklb::Locator> locator_;  // made when first asked for
};

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

// What a binary query and its answer are: little-endian, in the machine's own layout, without gaps.
enum Kind : std::uint32_t { kSight, kDrop, kLocate, kVisible };

struct Query {
    std::uint32_t kind;
    Index sector, other, unused;  // `other`: the second sector of kVisible
    double origin[3], target[3];  // of kDrop target[0] is the limit
};

struct Answer {
    Index first, second, third, unused;  // the members of Sight, Drop or Location in their order
    double distance;                     // of kDrop, else 0
};

static_assert(sizeof(Query) == 64 && sizeof(Answer) == 24, "records without gaps");

Answer answer(const Oracle& oracle, const Query& q) {
    switch (q.kind) {
        case kSight: {
            const jklb::Sight s = jklb::sight(oracle.mesh(), q.origin, q.sector, q.target);
            return {s.visible, s.crossed, s.blocker, 0, 0};
        }
        case kDrop: {
            const jklb::Drop d = jklb::drop(oracle.mesh(), q.origin, q.sector, q.target[0]);
            return {static_cast<Index>(d.ending), d.met, d.sector, 0, d.distance};
        }
        case kLocate: {
            const jklb::Location l = oracle.locator()(q.origin);
            return {l.sector, l.inside, l.touching, 0, 0};
        }
        case kVisible: return {oracle.sees()(q.sector, q.other), 0, 0, 0, 0};
        default: return {-1, -1, -1, 0, 0};
    }
}

using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

int binary(const Oracle& oracle, const std::string& from, const std::string& to) {
    std::ifstream in(from, std::ios::binary);
    if (!in) throw Refused{"cannot read " + from};
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (bytes.size() % sizeof(Query)) throw Refused{from + " is not whole queries of 64 bytes"};
    std::vector<Query> queries(bytes.size() / sizeof(Query));
    if (!bytes.empty()) std::memcpy(queries.data(), bytes.data(), bytes.size());
    std::vector<Answer> answers(queries.size());
    const std::clock_t start = std::clock();
    for (std::size_t i = 0; i < queries.size(); ++i) answers[i] = answer(oracle, queries[i]);
    const double taken = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::ofstream out(to, std::ios::binary);
    out.write(reinterpret_cast<const char*>(answers.data()), static_cast<std::streamsize>(answers.size() * sizeof(Answer)));
    out.close();
    if (!out) throw Refused{"cannot write " + to};
    std::printf("%zu answers, %.9g s of processor\n", answers.size(), taken);
    return 0;
}

// Opens the file again and again, makes its mesh and asks whether the first sector's first corner sees the last's.
int times(const std::string& path) {
    constexpr int kTimes = 51;
    std::vector<double> opened, answered;
    for (int i = 0; i < kTimes; ++i) {
        const auto start = Clock::now();
        std::string error;
        const std::optional<jklb::Level> level = jklb::Level::open(path, error);
        if (!level) throw Refused{error};
        opened.push_back(1e3 * seconds(start));
        const jklb::Mesh mesh(*level);
        if (mesh.surfaces() && mesh.corners(0) && mesh.corners(mesh.surfaces() - 1))
            jklb::sight(mesh, mesh.corner(0, 0), 0, mesh.corner(mesh.surfaces() - 1, 0));
        answered.push_back(1e3 * seconds(start));
    }
    const double first_opened = opened[0], first_answered = answered[0];
    std::sort(opened.begin(), opened.end());
    std::sort(answered.begin(), answered.end());
    std::printf("first %.3f ms to open, %.3f ms to the first answer; median of %d %.3f ms and %.3f ms\n", first_opened,
                first_answered, kTimes, opened[kTimes / 2], answered[kTimes / 2]);
    return 0;
}

int run(const Words& arguments) {
    std::string error;
    if (arguments.size() == 2 && arguments[1] == "--time") return times(arguments[0]);
    const std::optional<jklb::Level> level = jklb::Level::open(arguments[0], error);
    if (!level) throw Refused{error};
    if (arguments.size() == 1) return summary(arguments[0], *level), 0;
    const Oracle oracle(*level);
    if (arguments[1] == "-") return lines(oracle);
    if (arguments[1] == "--binary" && arguments.size() == 4) return binary(oracle, arguments[2], arguments[3]);
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
