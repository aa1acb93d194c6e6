// Asks a compiled level: from the command line, by lines from standard input, or in binary by the thousand.
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
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
    "ledges-of-thing BODY THING FRAME FACE CORNER [T]\n"
    "                                 the same of a thing's face; FRAME may be placed\n"
    "leave BODY SURFACE X Y Z X Y Z   by which edge a body that moves from a point to another leaves a floor\n"
    "leave-thing BODY THING FRAME FACE X Y Z X Y Z CORNERS\n"
    "                                 the same of a thing's face, whose corners are at CORNERS: X Y Z of each\n"
    "basins BODY                      where a body can fall in, and what leads out\n"
    "basin BODY SURFACE               the same of the one that a floor lies in\n"
    "\n"
    "BODY is its number or the name of a template that has it.\n";

const char* const kEndings[] = {"floor", "solid", "water", "far", "nothing", "unknown"};
const char* const kLedgeNames[] = {"level", "seamless", "fall", "water", "none", "step", "lip", "jump", "wall", "unknown"};

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
    explicit Oracle(const jklb::Level& level)
        : mesh_(level), visible_(level), ledges_(level), basins_(level) {}

    std::string answer(const Words& words) const {
        constexpr std::size_t kAny = 1000;
        struct Question {
            std::string (Oracle::*ask)(const Words&) const;
            std::size_t least, most;  // words behind its own
        };
        static const std::map<std::string, Question> known{
            {"sight", {&Oracle::sight, 7, 7}},
            {"drop", {&Oracle::drop, 4, 5}},
            {"locate", {&Oracle::locate, 3, 3}},
            {"visible", {&Oracle::visible, 2, 2}},
            {"ledges", {&Oracle::ledges, 3, 4}},
            {"ledges-of-thing", {&Oracle::ledges_of_thing, 5, 6}},
            {"leave", {&Oracle::leave, 8, 8}},
            {"leave-thing", {&Oracle::leave_thing, 0, kAny}},
            {"basins", {&Oracle::basins, 1, 1}},
            {"basin", {&Oracle::basin, 2, 2}},
        };
        const auto found = known.find(words[0]);
        if (found == known.end()) throw Refused{"no question '" + words[0] + "'; ask without one for help"};
        const Question& question = found->second;
        const std::size_t count = words.size() - 1;
        if (count < question.least || count > question.most)
            throw Refused{words[0] + " takes " + std::to_string(question.least) +
                          (question.most > question.least ? " or more" : "") + " words, not " + std::to_string(count)};
        return (this->*question.ask)(words);
    }

    const jklb::Mesh& mesh() const { return mesh_; }
    const jklb::VisibleSectors& sees() const { return visible_; }
    const jklb::LedgesOf& ledges() const { return ledges_; }
    const jklb::BasinsOf& basins() const { return basins_; }

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
        char* end;
        const bool named = (std::strtod(word.c_str(), &end), *end != 0);
        const Index found = named ? ledges_.body(word) : index(word);
        if (named && found < 0) throw Refused{"no body is of the template '" + word + "'"};
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
        const Index body = this->body(words[1]), surface = floor(words[2]), corner = index(words[3]);
        if (corner < 0 || corner >= mesh_.corners(surface))
            throw Refused{"corner " + words[3] + " does not exist: there are " + std::to_string(mesh_.corners(surface))};
        return told(ledges_.at(body, surface, corner), words, 4);
    }

    std::string ledges_of_thing(const Words& words) const {
        const Index body = this->body(words[1]), frame = this->frame(words[3]), thing = this->thing(words, body, frame);
        return told(ledges_.of_thing(body, thing, frame, index(words[4]), index(words[5])), words, 6);
    }

    std::string leave(const Words& words) const {
        const Index body = this->body(words[1]);
        const auto on = jklb::Floor::of_surface(floor(words[2]));
        return told(ledges_.leave(mesh_, body, on, place(words, 3).p, place(words, 6).p));
    }

    std::string leave_thing(const Words& words) const {
        if (words.size() < 20 || (words.size() - 11) % 3)
            throw Refused{"leave-thing takes 4 numbers, 2 points and 3 corners or more"};
        const Index body = this->body(words[1]), frame = this->frame(words[3]), thing = this->thing(words, body, frame);
        std::vector<double> corners;
        for (std::size_t i = 11; i < words.size(); i += 3)
            for (const double x : place(words, i).p) corners.push_back(x);
        const auto on = jklb::Floor::of_thing(thing, frame, index(words[4]), corners.data(),
                                              static_cast<Index>(corners.size() / 3));
        return told(ledges_.leave(mesh_, body, on, place(words, 5).p, place(words, 8).p));
    }

    Index floor(const std::string& word) const {
        const Index surface = index(word);
        if (surface < 0 || surface >= mesh_.surfaces())
            throw Refused{"surface " + word + " does not exist: there are " + std::to_string(mesh_.surfaces())};
        if (mesh_.passes_to(surface) != jklb::kCarries) throw Refused{"surface " + word + " is no floor"};
        return surface;
    }

    Index thing(const Words& words, Index body, Index frame) const {
        const Index thing = index(words[2]);
        if (!ledges_.known(body, thing, frame))
            throw Refused{"no edge of thing " + words[2] + " is listed at frame " + words[3]};
        return thing;
    }

    static Index frame(const std::string& word) { return word == "placed" ? jklb::Floor::kPlaced : index(word); }

    static std::string told(const jklb::EdgeLedges& edge, const Words& words, std::size_t at) {
        if (words.size() > at) {
            const double where = number(words[at]);
            if (!(where >= 0 && where <= 1)) throw Refused{words[at] + " is no place on an edge: they go from 0 to 1"};
            const std::optional<jklb::Ledge> found = edge.at(where);
            return found ? told(*found) : "level";
        }
        std::string out;
        for (const jklb::Ledge each : edge) out += (out.empty() ? "" : "; ") + told(each);
        return out.empty() ? "level" : out;
    }

    static std::string told(const jklb::Ledge& each) {
        std::string out = text(each.start) + " to " + text(each.end) + " " + name(each.kind) + met(each);
        if (!std::isnan(each.drop_start)) out += ", " + text(each.drop_start) + " to " + text(each.drop_end) + " JKU down";
        return out;
    }

    static std::string told(const jklb::Leave& leave) {
        if (leave.corner < 0) return leave.kind() == jklb::LedgeKind::kLevel ? "stays" : "unknown";
        std::string out = "leaves by corner " + std::to_string(leave.corner) + " at " + text(leave.place) + ", " +
                          text(leave.along) + " along the way: " + name(leave.kind()) + met(leave.ledge);
        if (!std::isnan(leave.drop)) out += ", " + text(leave.drop) + " JKU down";
        return jklb::detaches(leave.kind()) ? out + ", detaches" : out;
    }

    static std::string name(jklb::LedgeKind kind) {
        const auto place = static_cast<std::size_t>(kind);
        return place < std::size(kLedgeNames) ? kLedgeNames[place] : "kind " + std::to_string(place);
    }

    // What a ledge comes onto.
    static std::string met(const jklb::Ledge& each) {
        std::string out;
        if (each.below >= 0) out += ", surface " + std::to_string(each.below);
        if (each.onto >= 0) out += ", face " + std::to_string(each.onto_face) + " of thing " + std::to_string(each.onto);
        return out;
    }

    std::string basins(const Words& words) const {
        const Index body = this->body(words[1]);
        std::string out;
        for (Index i = 0; i < basins_.size(); ++i)
            if (basins_[i].body == body) out += (out.empty() ? "" : "; ") + told(basins_[i]);
        return out.empty() ? "none" : out;
    }

    std::string basin(const Words& words) const {
        const std::optional<jklb::Basin> found = basins_.at(body(words[1]), floor(words[2]));
        return found ? told(*found) : "none";
    }

    std::string told(const jklb::Basin& each) const {
        char flags[40];
        std::snprintf(flags, sizeof flags, "entered 0x%x, left 0x%x", unsigned{each.entered}, unsigned{each.left});
        return std::to_string(each.count) + " floors from surface " +
               (each.count ? std::to_string(basins_.floor(each.first)) : "none") + ", " + text(each.shallowest) + " to " +
               text(each.deepest) + " JKU deep, " + flags;
    }

    const jklb::Mesh mesh_;
    const jklb::VisibleSectors visible_;
    const jklb::LedgesOf ledges_;
    const jklb::BasinsOf basins_;
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
enum Kind : std::uint32_t { kSight, kDrop, kLocate, kVisible, kLedge, kLedgeOfThing, kLeave, kBasin, kBasinFloor };

struct Query {
    std::uint32_t kind;
    Index which[5];
    double origin[3], target[3];
};

struct Answer {
    Index whole[8];
    double real[6];
};

static_assert(sizeof(Query) == 72 && sizeof(Answer) == 80, "records without gaps");

Answer answer(const jklb::EdgeLedges& edge, double place) {
    const std::optional<jklb::Ledge> found = edge.at(place);
    if (!found) return {{-1, edge.size()}, {}};
    const jklb::Ledge& l = *found;
    return {{static_cast<Index>(l.kind), edge.size(), static_cast<Index>(l.other_kind), l.below, l.thing, l.traits, l.onto,
             l.onto_face},
            {l.start, l.end, l.drop_start, l.drop_end, l.drop(place)}};
}

Answer answer(const jklb::Leave& leave) {
    const jklb::Ledge& l = leave.ledge;
    return {{leave.corner, static_cast<Index>(l.kind), static_cast<Index>(l.other_kind), l.below, l.thing, l.traits, l.onto,
             l.onto_face},
            {leave.along, leave.place, leave.drop, l.start, l.end}};
}

Answer answer(const Oracle& oracle, const Query& q) {
    const Index* const n = q.which;
    switch (q.kind) {
        case kSight: {
            const jklb::Sight s = jklb::sight(oracle.mesh(), q.origin, n[0], q.target);
            return {{s.visible, s.crossed, s.blocker}, {}};
        }
        case kDrop: {
            const jklb::Drop d = jklb::drop(oracle.mesh(), q.origin, n[0], q.target[0]);
            return {{static_cast<Index>(d.ending), d.met, d.sector}, {d.distance}};
        }
        case kLocate: {
            const jklb::Location l = oracle.locator()(q.origin);
            return {{l.sector, l.inside, l.touching}, {}};
        }
        case kVisible: return {{oracle.sees()(n[0], n[1])}, {}};
        case kLedge: return answer(oracle.ledges().at(n[0], n[1], n[2]), q.origin[0]);
        case kLedgeOfThing: return answer(oracle.ledges().of_thing(n[0], n[1], n[2], n[3], n[4]), q.origin[0]);
        case kLeave:
            return answer(
                oracle.ledges().leave(oracle.mesh(), n[0], jklb::Floor::of_surface(n[1]), q.origin, q.target));
        case kBasin: {
            const std::optional<jklb::Basin> b = oracle.basins().at(n[0], n[1]);
            if (!b) return {{-1}, {}};
            return {{b->count, oracle.basins().floor(b->first), b->entered, b->left}, {b->shallowest, b->deepest}};
        }
        case kBasinFloor: {
            if (n[0] < 0 || n[0] >= oracle.basins().size()) return {{-1}, {}};
            const jklb::Basin b = oracle.basins()[n[0]];
            return {{b.body, b.count, n[1] >= 0 && n[1] < b.count ? oracle.basins().floor(b.first + n[1]) : -1}, {}};
        }
        default: return {{-1, -1, -1}, {}};
    }
}

using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Why the last call of the system failed.
std::string reason() {
    std::string why = std::strerror(errno);
    if (!why.empty() && why[0] >= 'A' && why[0] <= 'Z') why[0] = static_cast<char>(why[0] - 'A' + 'a');
    return why;
}

std::vector<Query> queries_of(const std::string& path) {
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    std::ostringstream bytes;
    if (in && in.peek() != std::ifstream::traits_type::eof()) bytes << in.rdbuf();
    if (errno) throw Refused{"cannot read " + path + ": " + reason()};
    const std::string held = bytes.str();
    if (held.size() % sizeof(Query)) throw Refused{path + " is not whole queries of 72 bytes"};
    std::vector<Query> queries(held.size() / sizeof(Query));
    if (!held.empty()) std::memcpy(queries.data(), held.data(), held.size());
    return queries;
}

int binary(const Oracle& oracle, const std::string& from, const std::string& to) {
    const std::vector<Query> queries = queries_of(from);
    std::vector<Answer> answers(queries.size());
    const std::clock_t start = std::clock();
    for (std::size_t i = 0; i < queries.size(); ++i) answers[i] = answer(oracle, queries[i]);
    const double taken = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    errno = 0;
    std::ofstream out(to, std::ios::binary);
    out.write(reinterpret_cast<const char*>(answers.data()), static_cast<std::streamsize>(answers.size() * sizeof(Answer)));
    out.close();
    if (!out) throw Refused{"cannot write " + to + ": " + reason()};
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
