// A body's way over an edge at one place of it, by the exact tiers of sight and drop. For exact_ledges.cpp.
#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "geometry/exact_ledge_rim.hpp"
#include "geometry/ground.hpp"
#include "geometry/sight.hpp"

namespace jk::exact {

enum class State : std::uint8_t { kNotLooked, kStopped, kNoFloor, kFloor };

struct Further {
    State state = State::kNotLooked;
    Index met = -1, face = -1;
    std::optional<Plane> plane;

    bool same(const Further& o) const { return state == o.state && met == o.met && face == o.face; }
};

struct Met {
    Over over;
    Index surface, face, sector, rise;
    std::optional<Plane> plane;
    Further further[2];

    bool same(const Met& o) const {
        return over == o.over && surface == o.surface && face == o.face && sector == o.sector && rise == o.rise &&
               further[0].same(o.further[0]) && further[1].same(o.further[1]);
    }
};

// A level as bodies pass through it, for the exact tiers of sight and drop.
struct World {
    explicit World(const Strides& strides)
        : strides(strides), passes_to(passes_of(strides)), viewer(mesh_of(strides, passes_to)) {}

    static std::vector<Index> passes_of(const Strides& strides) {
        std::vector<Index> passes(strides.mesh().surfaces());
        for (std::size_t i = 0; i < passes.size(); ++i) passes[i] = strides.passes_to(static_cast<Index>(i));
        return passes;
    }

    static SectorMesh mesh_of(const Strides& strides, std::span<const Index> passes) {
        SectorMesh mesh = strides.mesh();
        for (std::size_t i = 0; i < passes.size(); ++i) mesh.leads_to[i] = passes[i] >= 0 ? passes[i] : kBlocks;
        return mesh;
    }

    const Strides& strides;
    const std::vector<Index> passes_to;
    const Viewer viewer;
    const SectorMesh& mesh = viewer.mesh();
    const Faller faller{mesh, viewer.fans(), passes_to, strides.under_water()};
};

// The faces of things near an edge, and those among them that carry, with their planes.
struct NearSolids {
    NearSolids(const Strides& strides, const Rim& rim, std::span<const std::uint8_t> active);

    std::vector<Triangle> all;
    std::vector<std::pair<Triangle, Plane>> carriers;
};

class Way {
public:
    Way(const World& world, const Rim& rim, const Gait& gait, const NearSolids& solids)
        : world_(world), rim_(rim), gait_(gait), solids_(solids) {}

    // Goes over the edge at a place; `further`: looks at the places further out too.
    Met at(double t, bool further);

    // The sectors that ways came through, and the planes of surfaces that were fallen onto, since `forget`.
    const std::set<Index>& visited() const { return visited_; }
    const std::vector<Plane>& planes() const { return planes_; }
    void forget();

private:
    struct Moved;
    struct Landed;

    Index home_of(const Point& p);
    Moved go(Index sector, const Point& from, const Point& to);
    Landed fall(Index sector, const Point& from);
    void go_down(Index sector, const Point& from, double depth);
    std::optional<Plane> plane_of(const Landing& landing, const Point& from) const;
    Further look_further(Index sector, double t, int which);
    void remember(const Plane& plane, Index face);
    static void stop(Met& met, const Moved& way);

    const World& world_;
    const Rim& rim_;
    const Gait& gait_;
    const NearSolids& solids_;
    std::set<Index> visited_;
    std::vector<Plane> planes_;
};

}  // namespace jk::exact
