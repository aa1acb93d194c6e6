#include "geometry/glance.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

namespace jk {
namespace {

using Int4 = std::int32_t __attribute__((vector_size(16)));
using Int8 = std::int32_t __attribute__((vector_size(32)));
constexpr int kSides = PlaneBlock::kSides;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kUnit = 0x1p-24f;
// Rounding of a quotient below 1 is 4 units at most (numerator, denominator, division, comparison).
constexpr float kRounding = 8 * kUnit;
// Keeps quotients finite: a side along which the segment falls less than this is not possible, or in doubt anyway.
constexpr float kLeastFall = 0x1p-100f;
// Beyond this float32 sums of products could overflow.
constexpr float kTooFar = 0x1p60f;

Float4 all(float x) { return Float4{x, x, x, x}; }

template <typename Mask>
bool any(Mask mask) {
    long long parts[sizeof mask / sizeof(long long)], all = 0;
    std::memcpy(parts, &mask, sizeof mask);
    for (const long long part : parts) all |= part;
    return all != 0;
}

float least_of(Float8 x) {
    const Float8 y = __builtin_shuffle(x, Int8{4, 5, 6, 7, 0, 1, 2, 3}), a = x < y ? x : y;
    const Float8 z = __builtin_shuffle(a, Int8{2, 3, 0, 1, 6, 7, 4, 5}), b = a < z ? a : z;
    return std::min(b[0], b[1]);
}

// The first place that holds `value`, which one does.
int first_equal(Float8 x, float value) {
    const Int8 same = x == value;
    int lane = 0;
    while (lane < kSides - 1 && !same[lane]) ++lane;
    return lane;
}

// A segment seen from the centre of a room.
struct Sightline {
    float a[3], b[3];
    float reach_b, farthest;  // the greatest coordinate of b, and of both
    float reach;              // the sum of both ends'

    Sightline(const Room& room, const Segment& segment) {
        for (int k = 0; k < 3; ++k) {
            a[k] = static_cast<float>(segment.a[k] - room.center[k]);
            b[k] = static_cast<float>(segment.b[k] - room.center[k]);
        }
        const float reach_a = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
        reach_b = std::max({std::abs(b[0]), std::abs(b[1]), std::abs(b[2])});
        farthest = std::max(reach_a, reach_b);
        reach = reach_a + reach_b;
    }

    bool too_far() const { return !(reach < kTooFar); }
    Float8 at_a(const PlaneBlock& p) const { return p.x * a[0] + p.y * a[1] + p.z * a[2] + p.d; }
    Float8 at_b(const PlaneBlock& p) const { return p.x * b[0] + p.y * b[1] + p.z * b[2] + p.d; }
    Float8 bound_b(const PlaneBlock& p) const { return p.still + p.tilt * reach_b; }
    Float8 bound(const PlaneBlock& p) const { return p.still + p.tilt * farthest; }
};

// One side and a segment: its plane at both ends, and the greatest bound there.
struct Slab {
    float at_a, at_b, bound_b, bound;

    Slab(const Rooms& rooms, Index side, const Sightline& line) {
        const PlaneBlock& p = rooms.planes[static_cast<std::size_t>(side / kSides)];
        const int lane = side % kSides;
        at_a = p.x[lane] * line.a[0] + p.y[lane] * line.a[1] + p.z[lane] * line.a[2] + p.d[lane];
        at_b = p.x[lane] * line.b[0] + p.y[lane] * line.b[1] + p.z[lane] * line.b[2] + p.d[lane];
        bound_b = p.still[lane] + p.tilt[lane] * line.reach_b;
        bound = p.still[lane] + p.tilt[lane] * line.farthest;
    }
};

// The sides that the segment could leave through, each at lo <= t <= hi, handed out by their lo.
class Order {
public:
    static constexpr Index kMostBlocks = 16;

    Order(const Rooms& rooms, const Room& room, const Sightline& line) : blocks_(room.planes), first_(kSides * room.plane) {
        const Float8 none = Float8{} + kInfinity, least = Float8{} + kLeastFall;
        const PlaneBlock* planes = rooms.planes.data() + room.plane;
        for (Index i = 0; i < blocks_; ++i) {
            const Float8 at_a = line.at_a(planes[i]), at_b = line.at_b(planes[i]), bound = line.bound(planes[i]);
            const Int8 possible = ~((at_b >= line.bound_b(planes[i])) | (at_a <= -bound));
            const Float8 fall = at_a - at_b, depth = fall > least ? fall : least;
            lo_[i] = possible ? (at_a - bound) / depth : none;
            hi_[i] = (at_a + bound) / depth;
        }
    }

    struct Next {
        float lo, hi;
        Index side;
    };

    // The next side; its lo is infinite when there is none.
    Next next() {
        Index block = 0;
        Float8 least = lo_[0];
        for (Index i = 1; i < blocks_; ++i) least = lo_[i] < least ? lo_[i] : least;
        const float lo = least_of(least);
        if (!(lo < kInfinity)) return {kInfinity, kInfinity, -1};
        while (!any(lo_[block] == lo)) ++block;
        const int lane = first_equal(lo_[block], lo);
        lo_[block][lane] = kInfinity;
        return {lo, hi_[block][lane], first_ + kSides * block + lane};
    }

private:
    Index blocks_, first_;
    Float8 lo_[kMostBlocks], hi_[kMostBlocks];
};

// A point of the segment between t = lo and hi in two coordinates, and how far it can be off in either direction.
struct Spot {
    float p, q, spread;
};

// The coordinates that a side shows in, the one that it leaves out aside.
int first_of(std::uint16_t axis) { return axis == 2 ? 0 : axis + 1; }
int second_of(std::uint16_t axis) { return axis == 0 ? 2 : axis - 1; }

// Rounding of a point of a segment, in parts of its reach.
constexpr float kOff = 40 * kUnit;

Spot spot_of(const Sightline& line, std::uint16_t axis, float lo, float hi) {
    const int i = first_of(axis), j = second_of(axis);
    const float t = 0.5f * (lo + hi), along_p = line.b[i] - line.a[i], along_q = line.b[j] - line.a[j];
    // Half the piece between lo and hi, times sqrt 2 for both coordinates, and the rounding of the point.
    return {line.a[i] + t * along_p, line.a[j] + t * along_q,
            std::max(std::abs(along_p), std::abs(along_q)) * std::abs(hi - lo) + kOff * line.reach};
}

struct Passage {
    const PolygonBlock* polygon;  // null when none is certain
    bool outside;                 // of all polygons, certainly
};

// The one polygon of a side that a spot lies in.
Passage passage(const Rooms& rooms, const Side& side, const Spot& spot) {
    Passage found{nullptr, true};
    const PolygonBlock* block = rooms.polygons.data() + side.first;
    for (const PolygonBlock* end = block + side.count; block != end; ++block) {
        const Float4 margin = all(block->margin + spot.spread);
        Int4 not_inside{0, 0, 0, 0}, outside = not_inside;
        for (;; ++block) {
            const Float4 ahead = block->a * spot.p + block->b * spot.q + block->c;
            not_inside |= ~(ahead > margin);
            outside |= ahead < -margin;
            if (!block->continues) break;
        }
        if (any(outside)) continue;
        if (any(not_inside) || found.polygon) return {nullptr, false};
        if (block->apart) return {block, false};
        found = {block, false};
    }
    return found;
}

// Whether the segment stays in front of a needle's slab until after t = `until`, or passes the slab beside the needle.
bool clear_of(const Rooms& rooms, const Needle& needle, const Sightline& line, float until) {
    const Slab slab(rooms, needle.side, line);
    const float fall = slab.at_a - slab.at_b;
    if (slab.at_a > slab.bound && (slab.at_b > slab.bound || slab.at_a - slab.bound > (until + kRounding) * fall))
        return true;
    if (!(std::abs(fall) > 4 * slab.bound)) return false;  // along the slab
    const Spot spot = spot_of(line, rooms.sides[static_cast<std::size_t>(needle.side)].axis,
                              (slab.at_a - slab.bound) / fall, (slab.at_a + slab.bound) / fall);
    return std::abs(needle.a * spot.p + needle.b * spot.q + needle.c) > needle.margin + spot.spread;
}

bool leaves_by_needle(const Rooms& rooms, const Fans& fans, const Room& room, const Segment& segment,
                      const Sightline& line, float until) {
    const Needle* needle = rooms.needles.data() + room.needle;
    for (const Needle* end = needle + room.needles; needle != end; ++needle) {
        Crossing crossing;
        if (!clear_of(rooms, *needle, line, until) && crosses(fans, needle->triangle, segment, crossing)) return true;
    }
    return false;
}

// Eight segments in one room, each in a lane.
class Packet {
public:
    Packet(const Room& room, const Segment* segments, const float* entered, int count) {
        const auto lane = [&](int i) { return i < count ? i : 0; };
        const auto gather = [&](const double* Segment::* end, int k) {
            const auto at = [&](int i) { return static_cast<float>((segments[lane(i)].*end)[k] - room.center[k]); };
            return Float8{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
        };
        for (int k = 0; k < 3; ++k) {
            a_[k] = gather(&Segment::a, k);
            b_[k] = gather(&Segment::b, k);
        }
        for (int i = 0; i < kPacket; ++i) entered_[i] = entered[lane(i)];
    }

    // Finds for each lane the side that can be left first, as leaving() does, and the spot on it.
    void leave(const Rooms& rooms, const Room& room) {
        const Float8 none = Float8{} + kInfinity, least = Float8{} + kLeastFall;
        const Float8 reach_a = greatest(a_), reach_b = greatest(b_), farthest = reach_a > reach_b ? reach_a : reach_b;
        Float8 first = none, second = none, latest = none;
        Int8 side{};
        const PlaneBlock* block = rooms.planes.data() + room.plane;
        for (Index i = 0; i < room.sides; ++i) {
            const PlaneBlock& p = block[i / kSides];
            const int k = i % kSides;
            const Float8 at_a = p.x[k] * a_[0] + p.y[k] * a_[1] + p.z[k] * a_[2] + p.d[k];
            const Float8 at_b = p.x[k] * b_[0] + p.y[k] * b_[1] + p.z[k] * b_[2] + p.d[k];
            const Float8 bound = p.still[k] + p.tilt[k] * farthest, bound_b = p.still[k] + p.tilt[k] * reach_b;
            const Int8 possible = ~((at_b >= bound_b) | (at_a <= -bound));
            const Float8 fall = at_a - at_b, depth = fall > least ? fall : least;
            const Float8 lo = possible ? (at_a - bound) / depth : none, hi = (at_a + bound) / depth;
            const Int8 better = lo < first;
            second = better ? first : (lo < second ? lo : second);
            latest = better ? hi : latest;
            side = better ? Int8{} + i : side;
            first = better ? lo : first;
        }
        const Int8 far = ~(reach_a + reach_b < kTooFar);
        ends_ = (first == kInfinity) & ~far;
        leaves_ = (second > latest + kRounding) & (first > entered_ + kRounding) & (latest < 1 - kRounding) & ~far;
        side_ = side + kSides * room.plane;
        latest_ = latest;
        const Float8 t = 0.5f * (first + latest), along[3] = {b_[0] - a_[0], b_[1] - a_[1], b_[2] - a_[2]};
        for (int k = 0; k < 3; ++k) middle_[k] = a_[k] + t * along[k];
        spread_ = greatest(along) * (latest - first) + kOff * (reach_a + reach_b);
    }

    Glance seen(const Rooms& rooms, int lane) const {
        if (ends_[lane]) return {Glance::kEnds};
        if (!leaves_[lane]) return {Glance::kDoubt};
        const Side& side = rooms.sides[static_cast<std::size_t>(side_[lane])];
        const Spot spot{middle_[first_of(side.axis)][lane], middle_[second_of(side.axis)][lane], spread_[lane]};
        const Passage pass = passage(rooms, side, spot);
        if (!pass.polygon) return {Glance::kDoubt};
        return {Glance::kLeaves, pass.polygon->surface, pass.polygon->leads_to, latest_[lane]};
    }

private:
    // The greatest coordinate without its sign; a first one that is not a number stays.
    static Float8 greatest(const Float8 (&v)[3]) {
        const Float8 x = v[0] < 0 ? -v[0] : v[0], y = v[1] < 0 ? -v[1] : v[1], z = v[2] < 0 ? -v[2] : v[2];
        const Float8 both = x < y ? y : x;
        return both < z ? z : both;
    }

    Float8 a_[3], b_[3], entered_;
    Int8 ends_, leaves_, side_;
    Float8 latest_, middle_[3], spread_;
};

}  // namespace

// Wider registers change nothing but the time: every operation is the same IEEE operation, and none is fused.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__linux__)
#define JK_WIDE __attribute__((target_clones("avx2", "default"), flatten))
#else
#define JK_WIDE
#endif

JK_WIDE Glance glance(const Rooms& rooms, const Fans& fans, Index sector, const Segment& segment, float entered) {
    const Room& room = rooms.rooms[static_cast<std::size_t>(sector)];
    const Sightline line(room, segment);
    if (line.too_far() || room.planes > Order::kMostBlocks) return {Glance::kDoubt};
    Glance found{Glance::kEnds, -1, kBlocks, 1};
    for (Order order(rooms, room, line);;) {
        const Order::Next next = order.next();
        if (next.lo == kInfinity || (found.kind == Glance::kLeaves && next.lo > found.latest + kRounding)) break;
        const Side& side = rooms.sides[static_cast<std::size_t>(next.side)];
        const Passage pass = passage(rooms, side, spot_of(line, side.axis, next.lo, next.hi));
        if (pass.outside) continue;
        // Uncertain, through two sides at once, before the entry or at the end.
        if (!pass.polygon || found.kind == Glance::kLeaves || !(next.lo > entered + kRounding) || !(next.hi < 1 - kRounding))
            return {Glance::kDoubt};
        found = {Glance::kLeaves, pass.polygon->surface, pass.polygon->leads_to, next.hi};
    }
    if (room.needles > 0 && leaves_by_needle(rooms, fans, room, segment, line, found.latest)) return {Glance::kDoubt};
    return found;
}

JK_WIDE void glance_packet(const Rooms& rooms, const Fans& fans, Index sector, const Segment* segments,
                           const float* entered, int count, Glance* seen) {
    const Room& room = rooms.rooms[static_cast<std::size_t>(sector)];
    Packet packet(room, segments, entered, count);
    packet.leave(rooms, room);
    for (int i = 0; i < count; ++i) seen[i] = packet.seen(rooms, i);
    if (room.needles == 0) return;
    for (int i = 0; i < count; ++i) {
        if (seen[i].kind == Glance::kDoubt) continue;
        const float until = seen[i].kind == Glance::kEnds ? 1 : seen[i].latest;
        if (leaves_by_needle(rooms, fans, room, segments[i], Sightline(room, segments[i]), until)) seen[i] = {Glance::kDoubt};
    }
}

float latest(const Crossing& c) {
    const double fall = c.from.value - c.to.value - c.from.error - c.to.error;
    const double t = fall > 0 ? (c.from.value + c.from.error) / fall : 1;
    return static_cast<float>(t) + kRounding;
}

void possible_exits(const SectorMesh& mesh, const Rooms& rooms, const Fans& fans, Index sector, const Segment& segment,
                    Triangles& triangles) {
    triangles.clear();
    const auto s = static_cast<std::size_t>(sector);
    const Room& room = rooms.rooms[s];
    const Sightline line(room, segment);
    if (line.too_far()) {
        const auto first = static_cast<std::size_t>(mesh.sector_first[s]);
        const Index begin = fans.start[first], end = fans.start[first + static_cast<std::size_t>(mesh.sector_count[s])];
        triangles.resize(static_cast<std::size_t>(end - begin));
        std::iota(triangles.begin(), triangles.end(), begin);
        return;
    }
    const auto add = [&](Index begin, Index end) { for (; begin < end; ++begin) triangles.push_back(begin); };
    for (Index i = room.plane; i < room.plane + room.planes; ++i) {
        const PlaneBlock& planes = rooms.planes[static_cast<std::size_t>(i)];
        const Int8 possible = ~((line.at_b(planes) >= line.bound_b(planes)) | (line.at_a(planes) <= -line.bound(planes)));
        for (int lane = 0; lane < kSides; ++lane) {
            const Side& side = rooms.sides[static_cast<std::size_t>(kSides * i + lane)];
            Index last = -1;
            for (Index p = side.first; possible[lane] && p < side.first + side.count; ++p) {
                const Index own = rooms.polygons[static_cast<std::size_t>(p)].surface;
                if (std::exchange(last, own) == own) continue;  // a polygon of several blocks
                const auto surface = static_cast<std::size_t>(own);
                add(fans.start[surface], fans.start[surface + 1]);
            }
        }
    }
    for (Index n = room.needle; n < room.needle + room.needles; ++n) {
        const Needle& needle = rooms.needles[static_cast<std::size_t>(n)];
        if (!clear_of(rooms, needle, line, 1)) add(needle.triangle, needle.triangle + 1);
    }
}

}  // namespace jk
