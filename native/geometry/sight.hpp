// Sight between points of a level, in batches: all three tiers behind one call.
#pragma once

#include <span>
#include <vector>

#include "geometry/locate.hpp"
#include "geometry/mesh.hpp"
#include "geometry/queries.hpp"
#include "geometry/rooms.hpp"
#include "geometry/walk.hpp"

namespace jk {

enum class Tier { kFast, kBalanced, kExact };

// A mesh made ready for queries.
class Viewer {
public:
    explicit Viewer(SectorMesh mesh);

    Viewer(const Viewer&) = delete;  // its parts refer to each other
    Viewer& operator=(const Viewer&) = delete;

    const SectorMesh& mesh() const { return mesh_; }
    const Fans& fans() const { return fans_; }

    // Where each point lies (x y z, JKU). Throws std::invalid_argument naming the point that is not finite or too great.
    Location locate(std::span<const double> points, Tier tier, unsigned threads) const;

    // Answers one query a row: from origins (x y z, JKU) in sectors to targets. The rows are shared out among
    // `threads` threads (0: one a core); the answers do not depend on how many. Throws std::invalid_argument naming
    // the row when a sector is out of bounds or a coordinate is not finite or too great.
    Sight sight(const Queries& queries, Tier tier, unsigned threads) const;

    // Whether each target is seen in the sector that its query aims at: visible, on a way that enters that sector. Queries
    // whose pair of sectors is not among the `known` visible ones are not walked; as long as those rows are right, which
    // they are when no way enters a sector that has no bit, they change no answer. Throws as `sight` does, and when a
    // sector aimed at does not exist or the rows are not of this mesh.
    std::vector<std::uint8_t> sees(const Queries& queries, const VisibleRows& known, unsigned threads) const;

    // The way that decides one query, by the complete search.
    Verdict explain(std::span<const double> origin, Index sector, std::span<const double> target,
                    std::vector<Step>& path) const;

    // How often `balanced` was in doubt over these queries, on one thread.
    Doubts doubts(const Queries& queries) const;

    // Bytes held, the mesh included.
    std::size_t memory() const;

private:
    void check(const Queries& queries) const;

    SectorMesh mesh_;
    Fans fans_;
    Rooms rooms_;
    Locator locator_;
};

}  // namespace jk
