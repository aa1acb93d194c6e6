// Questions and answers by the thousand: records of numbers from and to files.
#pragma once

#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sstream>

#include "oracle.hpp"

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

inline Answer answer(const jklb::EdgeLedges& edge, double place) {
    const std::optional<jklb::Ledge> found = edge.at(place);
    if (!found) return {{-1, edge.size()}, {}};
    const jklb::Ledge& l = *found;
    return {{static_cast<Index>(l.kind), edge.size(), static_cast<Index>(l.other_kind), l.below, l.thing, l.traits, l.onto,
             l.onto_face},
            {l.start, l.end, l.drop_start, l.drop_end, l.drop(place)}};
}

inline Answer answer(const jklb::Leave& leave) {
    const jklb::Ledge& l = leave.ledge;
    return {{leave.corner, static_cast<Index>(l.kind), static_cast<Index>(l.other_kind), l.below, l.thing, l.traits, l.onto,
             l.onto_face},
            {leave.along, leave.place, leave.drop, l.start, l.end}};
}

inline Answer answer(const Oracle& oracle, const Query& q) {
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

// Why the last call of the system failed.
inline std::string reason() {
    std::string why = std::strerror(errno);
    if (!why.empty() && why[0] >= 'A' && why[0] <= 'Z') why[0] = static_cast<char>(why[0] - 'A' + 'a');
    return why;
}

inline std::vector<Query> queries_of(const std::string& path) {
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

inline int binary(const Oracle& oracle, const std::string& from, const std::string& to) {
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
