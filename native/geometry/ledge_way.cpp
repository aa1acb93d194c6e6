#include "geometry/ledge_way.hpp"

namespace jk::ledge {
namespace {

void stop(Found& found, const Moved& moved) {
    found.met = moved.blocker, found.face = moved.face, found.sector = moved.sector;
}

}  // namespace

Way::Way(const Strides& strides, const Rim& rim, const Gait& gait, const Surroundings& around, Breaks& breaks)
    : strides_(strides), rim_(rim), gait_(gait), around_(around), breaks_(breaks) {
    if (!rim.of_face()) return;
    const Box close = rim.close_box();
    for (std::size_t s = 0; s < strides.mesh().sectors(); ++s)
        if (strides.box(static_cast<Index>(s)).touches(close)) homes_.push_back(static_cast<Index>(s));
}

// The sector that a way over the edge begins in: the first that holds it; -1 outside the level.
Index Way::home_of(const Point& p) const {
    if (!rim_.of_face()) return rim_.home();
    Index on = -1;
    for (const Index sector : homes_) {
        const Place place = strides_.locator().place(sector, p.data());
        if (place == Place::kInside) return sector;
        if (place == Place::kOn && on < 0) on = sector;
    }
    return on;
}

Found Way::at(double t, bool further) {
    const Point start = rim_.inner(t);
    const Index home = home_of(start);
    Found found{Over::kBlocked, -1, -1, home, 0, {{0, 0, 1}, rim_.beside(0, 0, 0)}, {}};
    if (home < 0) return found;
    for (Index rise = 0; rise <= gait_.rises; ++rise) {
        const double up = gait_.hover + rise * gait_.rise;
        const Moved lifted = around_.go(home, start, rim_.beside(t, -kBeyond, up), visited_);
        if (lifted.blocked()) {
            if (rise == 0) stop(found, lifted);
            break;
        }
        const Point beyond = rim_.beside(t, kBeyond, up);
        const Moved over = around_.go(lifted.sector, rim_.beside(t, -kBeyond, up), beyond, visited_);
        if (over.blocked()) {
            if (rise == 0) stop(found, over);
            continue;
        }
        const Landed landed = around_.fall(over.sector, beyond, visited_);
        found = {static_cast<Over>(landed.below), landed.met, landed.face, landed.sector, rise,
                 {landed.normal, landed.corner}, {}};
        if (found.face < 0 && found.met >= 0) breaks_.remember(found.plane);
        if (further && rise == 0)
            for (int which = 0; which < 2; ++which) found.further[which] = look_further(over.sector, t, which);
        return found;
    }
    return found;
}

Further Way::look_further(Index sector, double t, int which) {
    const Point there = rim_.beside(t, rim_.off(which), gait_.hover);
    const Moved past = around_.go(sector, rim_.beside(t, kBeyond, gait_.hover), there, visited_);
    if (past.blocked()) return {Further::kStopped, past.blocker, past.face, {}};
    const Landed landed = around_.fall(past.sector, there, visited_);
    const Plane plane{landed.normal, landed.corner};
    if (landed.face < 0 && landed.met >= 0) breaks_.remember(plane);
    return {landed.below == Below::kFloor ? Further::kFloor : Further::kNoFloor, landed.met, landed.face, plane};
}

}  // namespace jk::ledge
