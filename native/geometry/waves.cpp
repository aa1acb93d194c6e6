#include "geometry/waves.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "geometry/glance.hpp"
#include "geometry/walk.hpp"

namespace jk {
namespace {

class Waves {
public:
    Waves(const SectorMesh& mesh, const Fans& fans, const Rooms& rooms, const Queries& queries, Sight& out)
        : mesh_(mesh), fans_(fans), rooms_(rooms), queries_(queries), out_(out), start_(mesh.sectors() + 1) {}

    void run(const VisibleRows& known, std::size_t first, std::size_t end) {
        stands_.resize(end - first);
        first_ = first;
        for (Row row = 0; row < stands_.size(); ++row) {
            stands_[row] = {queries_.sectors[first + row]};
            const Index aim = queries_.aim(first + row);
            if (aim == kNoAim || (aim >= 0 && known.holds(stands_[row].sector, aim)))
                under_way_.push_back(row);
            else
                out_.tell(first + row, {false, 0, -1});
        }
        while (!under_way_.empty()) {
            sort_by_sector();
            under_way_.clear();
            for (std::size_t i = 0; i < sorted_.size();) {
                for (std::size_t k = i + kPacket; k < std::min(i + 2 * kPacket, sorted_.size()); ++k) fetch(sorted_[k]);
                i += advance(i);
            }
        }
    }

private:
    using Row = std::uint32_t;  // counted from the first

    void sort_by_sector() {
        std::fill(start_.begin(), start_.end(), 0);
        for (const Row row : under_way_) ++start_[static_cast<std::size_t>(stands_[row].sector) + 1];
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        sorted_.resize(under_way_.size());
        for (const Row row : under_way_) sorted_[start_[static_cast<std::size_t>(stands_[row].sector)]++] = row;
    }

    // Asks for a row's points before they are needed.
    void fetch(Row row) const {
        const Segment segment = queries_.segment(first_ + row);
        __builtin_prefetch(segment.a);
        __builtin_prefetch(segment.a + 2);
        __builtin_prefetch(segment.b);
        __builtin_prefetch(segment.b + 2);
    }

    // Moves those at `from` that share a sector, at most a packet of them, one sector on; how many there were.
    std::size_t advance(std::size_t from) {
        const Index sector = stands_[sorted_[from]].sector;
        std::array<Segment, kPacket> segments;
        std::array<float, kPacket> entered;
        std::array<Glance, kPacket> seen;
        std::size_t count = 0;
        for (; count < kPacket && from + count < sorted_.size(); ++count) {
            const Row row = sorted_[from + count];
            if (stands_[row].sector != sector) break;
            segments[count] = queries_.segment(first_ + row);
            entered[count] = stands_[row].entered;
        }
        glance_packet(rooms_, fans_, sector, segments.data(), entered.data(), static_cast<int>(count), seen.data());
        for (std::size_t i = 0; i < count; ++i) follow(sorted_[from + i], segments[i], seen[i]);
        return count;
    }

    void follow(Row row, const Segment& segment, const Glance& seen) {
        Stand& stand = stands_[row];
        const Index aim = queries_.aim(first_ + row);
        stand.reached |= aim == kNoAim || stand.sector == aim;
        if (seen.kind == Glance::kEnds) return out_.tell(first_ + row, {true, stand.crossed, -1, stand.reached});
        if (seen.kind == Glance::kDoubt) {
            Doubts doubts;
            return out_.tell(first_ + row,
                             walk(mesh_, fans_, rooms_, queries_.sectors[first_ + row], aim, stand, segment, doubts));
        }
        if (seen.leads_to == kBlocks) return out_.tell(first_ + row, {false, stand.crossed, seen.surface});
        stand = {seen.leads_to, seen.surface, stand.crossed + 1, seen.latest, stand.reached};
        under_way_.push_back(row);
    }

    const SectorMesh& mesh_;
    const Fans& fans_;
    const Rooms& rooms_;
    const Queries& queries_;
    Sight& out_;
    std::size_t first_ = 0;
    std::vector<Stand> stands_;
    std::vector<Row> under_way_, sorted_;
    std::vector<std::uint32_t> start_;  // of each sector's rows among the sorted
};

}  // namespace

void walk_waves(const SectorMesh& mesh, const Fans& fans, const Rooms& rooms, const Queries& queries,
                const VisibleRows& known, std::size_t first, std::size_t end, Sight& out) {
    Waves(mesh, fans, rooms, queries, out).run(known, first, end);
}

}  // namespace jk
