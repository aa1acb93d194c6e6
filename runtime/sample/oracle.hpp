// Answers in words.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "jklb/jklb.hpp"

using jklb::Index;
using Words = std::vector<std::string>;

inline const char* const kEndings[] = {"floor", "solid", "water", "far", "nothing", "unknown"};
inline const char* const kLedgeNames[] = {"level", "seamless", "fall", "water", "none", "step", "lip", "jump", "wall", "unknown"};

struct Refused {
    std::string why;
};

inline double number(const std::string& word) {
    char* end;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || *end) throw Refused{"'" + word + "' is no number"};
    return value;
}

inline Index index(const std::string& word) {
    const double value = number(word);
    if (!(value >= -1 && value <= 2147483647) || value != static_cast<Index>(value))
        throw Refused{"'" + word + "' is no index"};
    return static_cast<Index>(value);
}

inline std::string text(double value) {
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
        if (word != "?") return sector(word);
        const Index found = locator()(place.p).sector;
        if (found < 0) throw Refused{"the point lies in no sector"};
        return found;
    }

    Index sector(const std::string& word) const {
        const Index found = index(word);
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
        return visible_(sector(words[1]), sector(words[2])) ? "may be visible" : "not visible";
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
