// Which sector holds a point: exactly, whatever the sector's shape.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "mesh.hpp"

namespace jklb {

struct Location {
    Index sector;    // the first that holds the point inside, else the first on whose boundary it lies, else -1
    Index inside;    // how many hold it inside: more than one overlap there
    Index touching;  // on how many boundaries it lies: two on a shared face
};

// A mesh made ready to locate points; the mesh must outlive it. README.md tells what it costs.
class Locator {
public:
    explicit Locator(const Mesh& mesh) : mesh_(mesh), rooms_(static_cast<std::size_t>(mesh.sectors())) {
        const std::vector<Index> place = places(mesh);
        std::vector<Edge> edges;
        for (Index s = 0; s < mesh.sectors(); ++s) {
            Room& room = rooms_[static_cast<std::size_t>(s)];
            edges.clear();
            for (Index i = mesh.first_surface(s); i < mesh.end_surface(s); ++i) take(i, place, room, edges);
            room.closed = balanced(edges);
        }
    }

    // A point that cannot be asked about (Mesh::takes) lies nowhere.
    Location operator()(Point point) const {
        Location found{-1, 0, 0};
        if (!Mesh::takes(point)) return found;
        Index touched = -1;
        for (Index s = 0; s < mesh_.sectors(); ++s) {
            const Place place = in(s, point);
            if (place == kOutside) continue;
            if (place == kInside && !found.inside++) found.sector = s;
            if (place == kOn && !found.touching++) touched = s;
        }
        if (found.sector < 0) found.sector = touched;
        return found;
    }

private:
    enum Place { kOutside, kOn, kInside };

    struct Room {
        double low[3] = {kFar, kFar, kFar}, high[3] = {-kFar, -kFar, -kFar};
        bool closed = false;
    };

    // An edge between two places: the lesser, the greater, and in the last bit whether the surface runs that way.
    using Edge = std::uint64_t;

    static constexpr double kFar = std::numeric_limits<double>::infinity();

    // A number for each vertex, the same for vertices at the same place.
    static std::vector<Index> places(const Mesh& mesh) {
        std::vector<Index> order(static_cast<std::size_t>(mesh.vertices()));
        std::iota(order.begin(), order.end(), 0);
        const auto before = [&mesh](Index a, Index b) {
            const Point p = mesh.vertex(a), q = mesh.vertex(b);
            for (int k = 0; k < 3; ++k)
                if (p[k] != q[k]) return p[k] < q[k];
            return false;
        };
        // What is not finite has no order; no known sector has it.
        const auto whole = [&mesh](Index v) { return Mesh::takes(mesh.vertex(v)); };
        const auto end = std::partition(order.begin(), order.end(), whole);
        std::sort(order.begin(), end, before);
        std::vector<Index> place(order.size());
        for (auto at = order.begin(); at != end; ++at) {
            const bool same = at != order.begin() && !before(at[-1], at[0]);
            place[static_cast<std::size_t>(*at)] = same ? place[static_cast<std::size_t>(at[-1])] : *at;
        }
        return place;
    }

    void take(Index surface, const std::vector<Index>& place, Room& room, std::vector<Edge>& edges) const {
        const Mesh::Box& box = mesh_.box(surface);
        for (int k = 0; k < 3; ++k) {
            room.low[k] = std::min(room.low[k], static_cast<double>(box.low[k]));
            room.high[k] = std::max(room.high[k], static_cast<double>(box.high[k]));
        }
        const Index corners = mesh_.corners(surface);
        for (Index i = 0; i < corners; ++i) {
            const auto here = static_cast<Edge>(place[static_cast<std::size_t>(mesh_.corner_vertex(surface, i))]);
            const auto there = static_cast<Edge>(
                place[static_cast<std::size_t>(mesh_.corner_vertex(surface, i + 1 < corners ? i + 1 : 0))]);
            if (here < there) edges.push_back(here << 32 | there << 1 | 1);
            if (there < here) edges.push_back(there << 32 | here << 1);
        }
    }

    // Whether as many edges run one way as the other between any two places: the sector is closed.
    static bool balanced(std::vector<Edge>& edges) {
        std::sort(edges.begin(), edges.end());
        int balance = 0;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            balance += edges[i] & 1 ? 1 : -1;
            if (i + 1 < edges.size() && edges[i + 1] >> 1 == edges[i] >> 1) continue;
            if (balance != 0) return false;
        }
        return true;
    }

    Place in(Index sector, Point p) const {
        const Room& room = rooms_[static_cast<std::size_t>(sector)];
        for (int k = 0; k < 3; ++k)
            if (p[k] < room.low[k] || p[k] > room.high[k]) return kOutside;
        return room.closed ? by_winding(sector, p) : by_planes(sector, p);
    }

    // How often the triangles wind around the point: those above it, facing down or up, counted along a vertical line.
    // The line is thought of as moved by less than any distance along x, and by less than any such along y, so that it
    // meets no edge; a point on no triangle does not change sides by that.
    Place by_winding(Index sector, Point p) const {
        int turns = 0;
        for (Index s = mesh_.first_surface(sector); s < mesh_.end_surface(sector); ++s) {
            const Index triangles = mesh_.triangles(s);
            for (Index i = 0; i < triangles; ++i) {
                const Triangle t = mesh_.triangle(s, i);
                if (apart(t, p)) continue;
                const int side = jklb::side(t, p).sign;
                if (side == 0 && on(t, p)) return kOn;
                const int facing = covers(t, p);
                if (facing && side == -facing) turns += facing;
            }
        }
        return turns ? kInside : kOutside;
    }

    // Whether a triangle lies beside the point or below it.
    static bool apart(const Triangle& t, Point p) {
        for (int k = 0; k < 2; ++k)
            if ((t.a[k] < p[k] && t.b[k] < p[k] && t.c[k] < p[k]) || (t.a[k] > p[k] && t.b[k] > p[k] && t.c[k] > p[k]))
                return true;
        return t.a[2] < p[2] && t.b[2] < p[2] && t.c[2] < p[2];
    }

    // 1 or -1 where the triangle, facing up or down, has the moved point under or over it; 0 where it has not.
    static int covers(const Triangle& t, Point p) {
        const int ab = moved_turn(t.a, t.b, p), bc = moved_turn(t.b, t.c, p), ca = moved_turn(t.c, t.a, p);
        return ab == bc && bc == ca ? ab : 0;
    }

    // The side of the line from a to b, seen from above, on which p lies when it is moved; 0 where a and b are one.
    static int moved_turn(Point a, Point b, Point p) {
        const int sign = orient2d(a, b, p).sign;
        if (sign) return sign;
        if (a[1] != b[1]) return a[1] > b[1] ? 1 : -1;
        return a[0] == b[0] ? 0 : a[0] < b[0] ? 1 : -1;
    }

    // Whether a point in the plane of a triangle lies on it: seen along an axis by which the triangle has an area.
    static bool on(const Triangle& t, Point p) {
        for (int x = 0; x < 3; ++x) {
            const int y = (x + 1) % 3, facing = orient2d(t.a, t.b, t.c, x, y).sign;
            if (facing)
                return orient2d(t.a, t.b, p, x, y).sign != -facing && orient2d(t.b, t.c, p, x, y).sign != -facing &&
                       orient2d(t.c, t.a, p, x, y).sign != -facing;
        }
        return false;
    }

    // For a sector that is not closed: the point lies behind none of its triangles.
    Place by_planes(Index sector, Point p) const {
        Place place = kOutside;
        for (Index s = mesh_.first_surface(sector); s < mesh_.end_surface(sector); ++s) {
            const Index triangles = mesh_.triangles(s);
            for (Index i = 0; i < triangles; ++i) {
                const Triangle t = mesh_.triangle(s, i);
                const int side = jklb::side(t, p).sign;
                if (side < 0) return kOutside;
                if (side == 0 && collinear(t.a, t.b, t.c)) continue;
                if (side == 0) place = kOn;
                else if (place == kOutside) place = kInside;
            }
        }
        return place;
    }

    const Mesh& mesh_;
    std::vector<Room> rooms_;
};

}  // namespace jklb
