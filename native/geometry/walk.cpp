#include "geometry/walk.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace jk {
namespace {

using Int4 = std::int32_t __attribute__((vector_size(16)));

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kUnit = 0x1p-24f;
// Rounding of a quotient below 1 is 4 units at most (numerator, denominator, division, comparison).
constexpr float kRounding = 8 * kUnit;
// Keeps quotients finite: a side along which the segment falls less than this is not possible, or is in doubt anyway.
constexpr float kLeastFall = 0x1p-100f;
// Beyond this float32 sums of products could overflow.
constexpr float kTooFar = 0x1p60f;

Float4 all(float x) { return Float4{x, x, x, x}; }
bool any(Int4 mask) {
    long long halves[2];
    std::memcpy(halves, &mask, sizeof mask);
    return (halves[0] | halves[1]) != 0;
}

struct Exit {
    enum Kind { kNone, kThrough, kDoubt } kind;
    Index surface = -1, leads_to = kBlocks;
    float latest = 0;  // t at most
};

// A segment seen from the centre of a room.
struct Sightline {
    float a[3], b[3];
    float reach_a, reach_b;  // greatest coordinate

    Sightline(const Room& room, const Segment& segment) {
        for (int k = 0; k < 3; ++k) {
            a[k] = static_cast<float>(segment.a[k] - room.center[k]);
            b[k] = static_cast<float>(segment.b[k] - room.center[k]);
        }
        reach_a = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
        reach_b = std::max({std::abs(b[0]), std::abs(b[1]), std::abs(b[2])});
    }
};

// The two sides that the segment could leave first.
struct Leaving {
    float first = kInfinity, second = kInfinity, latest = kInfinity;  // lo, lo of the next, hi
    std::size_t side = 0;
};

Leaving leaving(const Rooms& rooms, const Room& room, const Sightline& line) {
    const float bound_b = room.still + room.tilt * line.reach_b;
    const float bound = std::max(bound_b, room.still + room.tilt * line.reach_a);
    const Float4 m = all(bound), m_b = all(bound_b);
    Float4 first = all(kInfinity), second = first, latest = first;
    Int4 block{0, 0, 0, 0};
    const PlaneBlock* planes = rooms.planes.data() + room.plane;
    for (Index i = 0; i < room.planes; ++i) {
        const PlaneBlock& p = planes[i];
        const Float4 at_a = p.x * line.a[0] + p.y * line.a[1] + p.z * line.a[2] + p.d;
        const Float4 at_b = p.x * line.b[0] + p.y * line.b[1] + p.z * line.b[2] + p.d;
        const Int4 possible = ~((at_b >= m_b) | (at_a <= -m));
        const Float4 fall = at_a - at_b;
        const Float4 depth = fall > all(kLeastFall) ? fall : all(kLeastFall);
        const Float4 lo = possible ? (at_a - m) / depth : all(kInfinity);
        const Float4 hi = (at_a + m) / depth;
        const Int4 better = lo < first;
        second = better ? first : (lo < second ? lo : second);
        latest = better ? hi : latest;
        block = better ? Int4{i, i, i, i} : block;
        first = better ? lo : first;
    }
    Leaving out;
    for (int lane = 0; lane < 4; ++lane) {
        if (first[lane] < out.first) {
            out.second = std::min({out.second, out.first, second[lane]});
            out.first = first[lane];
            out.latest = latest[lane];
            out.side = static_cast<std::size_t>(4 * (room.plane + block[lane]) + lane);
        } else {
            out.second = std::min({out.second, first[lane]});
        }
    }
    return out;
}

// The one polygon of a side through which the segment passes between t = lo and hi, or null when that is in doubt.
const PolygonBlock* polygon_at(const Rooms& rooms, const Side& side, const Sightline& line, float lo, float hi) {
    const int p = side.axis == 2 ? 0 : side.axis + 1, q = side.axis == 0 ? 2 : side.axis - 1;
    const float t = 0.5f * (lo + hi), along_p = line.b[p] - line.a[p], along_q = line.b[q] - line.a[q];
    const Float4 at_p = all(line.a[p] + t * along_p), at_q = all(line.a[q] + t * along_q);
    // Half the piece between lo and hi, times sqrt 2 for both coordinates, and the rounding of the point.
    const float spread = std::max(std::abs(along_p), std::abs(along_q)) * (hi - lo) +
                         40 * kUnit * (line.reach_a + line.reach_b);
    const PolygonBlock* found = nullptr;
    const PolygonBlock* block = rooms.polygons.data() + side.first;
    for (const PolygonBlock* end = block + side.count; block != end; ++block) {
        const Float4 margin = all(block->margin + spread);
        Int4 not_inside{0, 0, 0, 0}, outside = not_inside;
        for (;; ++block) {
            const Float4 ahead = block->a * at_p + block->b * at_q + block->c;
            not_inside |= ~(ahead > margin);
            outside |= ahead < -margin;
            if (!block->continues) break;
        }
        if (any(outside)) continue;
        if (any(not_inside) || found) return nullptr;
        found = block;
    }
    return found;
}

class Walk {
public:
    Walk(const SectorMesh& mesh, const Fans& fans, const Rooms& rooms, const Segment& segment, Doubts& doubts)
        : mesh_(mesh), fans_(fans), rooms_(rooms), segment_(segment), doubts_(doubts) {}

    Verdict run(Index start) {
        Index sector = start;
        for (Index crossed = 1;; ++crossed) {
            Exit exit = glance(rooms_.rooms[static_cast<std::size_t>(sector)]);
            if (exit.kind == Exit::kDoubt) exit = look(sector);
            if (exit.kind == Exit::kNone) return {true, crossed, -1};
            if (exit.kind == Exit::kDoubt) {
                ++doubts_.queries;
                return search(mesh_, fans_, start, segment_);
            }
            if (exit.leads_to == kBlocks) return {false, crossed, exit.surface};
            sector = exit.leads_to;
            entered_by_ = exit.surface;
            latest_ = exit.latest;
        }
    }

private:
    // The certified answer for one room.
    Exit glance(const Room& room) {
        const Sightline line(room, segment_);
        if (!(line.reach_a + line.reach_b < kTooFar)) return {Exit::kDoubt};
        for (Index n = room.needle; n < room.needle + room.needles; ++n) {
            Crossing crossing;
            if (crosses(fans_, rooms_.needles[static_cast<std::size_t>(n)], segment_, crossing)) return {Exit::kDoubt};
        }
        const Leaving left = leaving(rooms_, room, line);
        if (left.first == kInfinity) return {Exit::kNone};
        if (!(left.first > latest_ + kRounding && left.latest < 1 - kRounding &&
              left.second > left.latest + kRounding))
            return {Exit::kDoubt};
        const PolygonBlock* polygon = polygon_at(rooms_, rooms_.sides[left.side], line, left.first, left.latest);
        if (!polygon) return {Exit::kDoubt};
        entry_.reset();
        return {Exit::kThrough, polygon->surface, polygon->leads_to, left.latest};
    }

    // The complete answer for one sector; in doubt when ways part or do not advance.
    Exit look(Index sector) {
        ++doubts_.sectors;
        const std::optional<Crossing> entry = entry_ ? entry_ : entry_crossing();
        leave_sector(mesh_, fans_, segment_, sector, entry, exits_);
        if (exits_.empty()) return {Exit::kNone};
        for (const Crossing& exit : exits_)
            if (leads_to(exit) == kBlocks) return {Exit::kThrough, surface(exit), kBlocks, 1};
        const Crossing& exit = exits_.front();
        const bool advances = entry ? compare(fans_, segment_, exit, *entry) > 0 : exit.from.sign > 0;
        if (exits_.size() > 1 || !advances) return {Exit::kDoubt};
        entry_ = exit;
        return {Exit::kThrough, surface(exit), leads_to(exit), latest_of(exit)};
    }

    // The exact crossing behind a certified one: the first through the surface's fan.
    std::optional<Crossing> entry_crossing() const {
        std::optional<Crossing> first;
        if (entered_by_ < 0) return first;
        const auto s = static_cast<std::size_t>(entered_by_);
        for (Index t = fans_.start[s]; t < fans_.start[s + 1]; ++t) {
            Crossing found;
            if (!crosses(fans_, t, segment_, found)) continue;
            if (!first || compare(fans_, segment_, found, *first) < 0) first = found;
        }
        return first;
    }

    Index surface(const Crossing& exit) const { return fans_.triangles[static_cast<std::size_t>(exit.triangle)].surface; }
    Index leads_to(const Crossing& exit) const { return mesh_.leads_to[static_cast<std::size_t>(surface(exit))]; }

    // An upper bound of t in float32; 1 and above leaves the next room in doubt.
    static float latest_of(const Crossing& c) {
        const double fall = c.from.value - c.to.value - c.from.error - c.to.error;
        const double t = fall > 0 ? (c.from.value + c.from.error) / fall : 1;
        return static_cast<float>(t) + kRounding;
    }

    const SectorMesh& mesh_;
    const Fans& fans_;
    const Rooms& rooms_;
    const Segment segment_;
    Doubts& doubts_;
    std::vector<Crossing> exits_;
    std::optional<Crossing> entry_;  // exact, where the last sector was searched completely
    Index entered_by_ = -1;
    float latest_ = 0;  // t of the entry at most
};

}  // namespace

Verdict walk(const SectorMesh& mesh, const Fans& fans, const Rooms& rooms, Index sector, const Segment& segment,
             Doubts& doubts) {
    return Walk(mesh, fans, rooms, segment, doubts).run(sector);
}

}  // namespace jk
