// Where bodies walk and fall: what the compiler found out beyond the edges of floors.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "leaving.hpp"
#include "mesh.hpp"

namespace jklb {

// What a body comes onto beyond an edge; grammars/level.fbs and docs/floors.md tell more of each.
enum class LedgeKind : std::uint8_t { kLevel, kSeamless, kFall, kWater, kNone, kStep, kLip, kJump, kWall, kUnknown };

// Whether a body that walks over the edge lets go of the floor and falls.
constexpr bool detaches(LedgeKind kind) {
    return kind == LedgeKind::kFall || kind == LedgeKind::kWater || kind == LedgeKind::kNone;
}

// A part of an edge.
struct Ledge {
    float start, end;             // 0 .. 1 along the edge
    LedgeKind kind, other_kind;   // by the file's engine profile, and by the other
    Index below, thing;           // the surface come onto, or that blocks; the thing that makes it unknown; or -1
    float drop_start, drop_end;   // from the edge down, JKU; NaN for none
    std::uint8_t traits;          // 0x1 narrower than the body, 0x2 the engine's AI stops
    Index onto, onto_face;        // the thing come onto, or that blocks, and the face of its model; or -1

    bool holds(double place) const { return start <= place && place <= end; }

    // From the edge down at a place that it holds, JKU: the double nearest to it. NaN for none.
    double drop(double place) const;
};

// The ledges of one edge, along it: read from the file as they are asked for. Lives as long as its LedgesOf.
class EdgeLedges {
public:
    class Iterator {
    public:
        Iterator(const EdgeLedges& of, Index at) : of_(of), at_(at) {}
        Ledge operator*() const { return of_[at_]; }
        Iterator& operator++() { return ++at_, *this; }
        bool operator!=(const Iterator& other) const { return at_ != other.at_; }

    private:
        const EdgeLedges& of_;
        Index at_;
    };

    EdgeLedges(const Ledges& columns, std::size_t first, std::size_t end)
        : columns_(columns), first_(first), count_(static_cast<Index>(end - first)) {}

    Index size() const { return count_; }
    bool empty() const { return count_ == 0; }
    Iterator begin() const { return {*this, 0}; }
    Iterator end() const { return {*this, count_}; }

    Ledge operator[](Index i) const {
        const std::size_t row = first_ + static_cast<std::size_t>(i);
        const Ledges& c = columns_;
        return {c.start(row), c.end(row), static_cast<LedgeKind>(c.kind(row)),
                static_cast<LedgeKind>(c.other_kind(row)), c.below(row), c.thing(row), c.drop_start(row), c.drop_end(row),
                c.traits(row), since(c.onto, row), since(c.onto_face, row)};
    }

    // The first that holds a place of the edge, 0 .. 1 along it.
    std::optional<Ledge> at(double place) const {
        for (const Ledge each : *this)
            if (each.holds(place)) return each;
        return std::nullopt;
    }

private:
    // Of a column that files of format 1.0 and 1.1 do not have.
    static Index since(const Column<std::int32_t>& column, std::size_t row) {
        return row < column.rows() ? column(row) : -1;
    }

    const Ledges& columns_;
    std::size_t first_;
    Index count_;
};

// What comes of a body's way over a floor.
struct Leave {
    Index corner;         // of the edge by which it leaves, from this corner of the floor to the next; -1 where it stays
    double along, place;  // how far along the way, and along that edge: 0 .. 1, the nearest doubles
    double drop;          // JKU down from the edge there, the nearest double: negative for up, NaN for none and unknown
    Ledge ledge;          // what it comes onto; where none is listed, from the ledge before to the one after

    // kLevel where the body stays or the floor goes on; over an edge of a thing with a drop that is NaN, since also the
    // thing's own faces may go on there or stop the body, which its model tells. kUnknown where the file does not say.
    LedgeKind kind() const { return ledge.kind; }
};

// The ledges of a level, for each of its bodies. An edge of a surface, or a part of one, that has none goes on level; one
// of a thing goes on level, or over or against the thing's own faces. Nothing is allocated by any question but `body`.
class LedgesOf {
public:
    explicit LedgesOf(const Level& level) : level_(level) {
        if (level.sections().ledges) ledges_ = *level.sections().ledges;
    }

    // How many bodies there are; their figures are columns of Level::sections().ledges.
    Index bodies() const { return static_cast<Index>(ledges_.body_movesize.rows()); }

    // The body of a template, by its name in any case; -1 for one that has none.
    Index body(std::string_view name) const {
        for (Index i = 0; i < bodies(); ++i)
            for (std::size_t k = ledges_.body_name_start(row(i)); k < ledges_.body_name_start(row(i) + 1); ++k)
                if (same(level_.string(ledges_.body_name(k)), name)) return i;
        return -1;
    }

    // Whether it is known how high a body floats: of one that it is not, the file has neither ledges nor basins, which
    // says nothing about its edges.
    bool known(Index body) const { return exists(body) && !std::isnan(ledges_.body_hover(row(body))); }

    // Whether the file has ledges of a thing at a frame. One that has none is no floor then, its model was not at hand, it
    // is never there, or it lies level among others: the file does not tell these apart.
    bool known(Index body, Index thing, Index frame) const {
        return thing >= 0 && !between(body, of(thing, frame), of(thing, frame, true)).empty();
    }

    // The ledges of the edge that goes from a corner of a surface to the next one.
    EdgeLedges at(Index body, Index surface, Index corner) const {
        if (surface < 0) return none();
        const Key key{surface, 0, 0, 0, corner};
        return between(body, key, {surface, 0, 0, 0, corner, true});
    }

    // The first of them that holds a place of the edge, 0 .. 1 along it.
    std::optional<Ledge> at(Index body, Index surface, Index corner, double place) const {
        return at(body, surface, corner).at(place);
    }

    // The same of a face of a thing (its source index, and that of the face in its model at rest), where it is placed or
    // at one of its frames; a frame at which it is as it is placed counts as that.
    EdgeLedges of_thing(Index body, Index thing, Index frame, Index face, Index corner) const {
        if (thing < 0) return none();
        return between(body, {-1, thing, frame, face, corner}, {-1, thing, frame, face, corner, true});
    }

    std::optional<Ledge> of_thing(Index body, Index thing, Index frame, Index face, Index corner, double place) const {
        return of_thing(body, thing, frame, face, corner).at(place);
    }

    // What comes of a body that moves straight over the floor that it stands on, seen from above: by which edge it leaves
    // it, and what it comes onto there. The way is that of its position, and starts over the floor or on an edge of it;
    // of another way, and of what is no floor, nothing is known.
    Leave leave(const Mesh& mesh, Index body, const Floor& floor, Point from, Point to) const {
        Leave out{-1, 1, 0, kNaN, kUnknown};
        if (!known(body) || !Mesh::takes(from) || !Mesh::takes(to) || !knows(mesh, body, floor)) return out;
        const Exit exit = detail::leaving(detail::Ring(mesh, floor), {from, to});
        if (!exit.starts_inside) return out;
        out = {exit.corner, exit.along, exit.place, 0, kLevel};
        if (exit.corner < 0) return out;
        if (floor.surface < 0) out.drop = out.ledge.drop_start = out.ledge.drop_end = std::numeric_limits<float>::quiet_NaN();
        const EdgeLedges edge = floor.surface >= 0 ? at(body, floor.surface, exit.corner)
                                                   : of_thing(body, floor.thing, floor.frame, floor.face, exit.corner);
        for (const Ledge each : edge) {
            if (each.holds(exit.place)) {
                out.ledge = each;
                out.drop = each.drop(exit.place);
                return out;
            }
            if (each.end < exit.place) out.ledge.start = each.end;
            else if (each.start < out.ledge.end) out.ledge.end = each.start;
        }
        return out;
    }

private:
    static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    static constexpr Ledge kLevel{0, 1, LedgeKind::kLevel, LedgeKind::kLevel, -1, -1, 0, 0, 0, -1, -1};
    static constexpr Ledge kUnknown{0, 1, LedgeKind::kUnknown, LedgeKind::kUnknown, -1, -1,
                                    std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::quiet_NaN(),
                                    0, -1, -1};

    // The rows of a body are sorted by this; `after` is behind all rows that are equal so far as it tells.
    struct Key {
        Index surface, thing, frame, face, corner;
        bool after = false;
    };

    static std::size_t row(Index i) { return static_cast<std::size_t>(i); }
    bool exists(Index body) const { return body >= 0 && body < bodies(); }
    EdgeLedges none() const { return {ledges_, 0, 0}; }

    // Before the first row of a thing at a frame, or behind the last.
    static Key of(Index thing, Index frame, bool behind = false) {
        constexpr Index kLeast = std::numeric_limits<Index>::min(), kMost = std::numeric_limits<Index>::max();
        const Index end = behind ? kMost : kLeast;
        return {-1, thing, frame, end, end, behind};
    }

    // The rows of a body from one key to another.
    EdgeLedges between(Index body, const Key& low, const Key& high) const {
        if (!exists(body)) return none();
        const std::size_t first = ledges_.body_ledge_start(row(body)), end = ledges_.body_ledge_start(row(body) + 1);
        const std::size_t from = search(first, end, low);
        return {ledges_, from, search(from, end, high)};
    }

    std::size_t search(std::size_t low, std::size_t high, const Key& key) const {
        while (low < high) {
            const std::size_t middle = low + (high - low) / 2;
            if (before(middle, key)) low = middle + 1;
            else high = middle;
        }
        return low;
    }

    bool before(std::size_t row, const Key& key) const {
        const Index surface = ledges_.surface(row);
        if (surface != key.surface) return surface < key.surface;
        if (surface < 0) {
            if (row >= ledges_.carrier.rows()) return true;  // up to format 1.1
            const Column<std::int32_t>* const columns[] = {&ledges_.carrier, &ledges_.carrier_frame, &ledges_.carrier_face};
            const Index wanted[] = {key.thing, key.frame, key.face};
            for (int i = 0; i < 3; ++i) {
                const Index own = (*columns[i])(row);
                if (own != wanted[i]) return own < wanted[i];
            }
        }
        const Index corner = ledges_.corner(row);
        return corner < key.corner || (corner == key.corner && key.after);
    }

    bool knows(const Mesh& mesh, Index body, const Floor& floor) const {
        if (floor.surface >= 0)
            return !floor.corners && floor.surface < mesh.surfaces() && mesh.sound(floor.surface) &&
                   mesh.passes_to(floor.surface) == kCarries;
        if (!floor.corners || !known(body, floor.thing, floor.frame)) return false;
        for (Index i = 0; i < floor.count; ++i)
            if (!Mesh::takes(floor.corners + 3 * i)) return false;
        return true;
    }

    static bool same(std::string_view a, std::string_view b) {
        const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
        if (a.size() != b.size()) return false;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (lower(a[i]) != lower(b[i])) return false;
        return true;
    }

    const Level& level_;
    Ledges ledges_;
};

inline double Ledge::drop(double place) const {
    const double s = start, e = end, here = drop_start, there = drop_end;
    if (!std::isfinite(here) || !std::isfinite(there) || !holds(place) || !std::isfinite(e - s))
        return std::numeric_limits<double>::quiet_NaN();
    if (!(s < e)) return here;
    const bool fits = Expansion::fits(place);  // as all floats do
    const auto exact = [&](auto number) {
        using Number = decltype(number);
        const auto less = [](double a, double b) { return Number::difference(a, b); };
        return std::pair(less(here, 0) * less(e, place) + less(there, 0) * less(place, s), less(e, s));
    };
    return detail::quotient(fits, exact);
}

}  // namespace jklb
