#include "geometry/rooms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace jk {
namespace {

using Vector = std::array<double, 3>;

constexpr double kUnit = 0x1p-24;  // rounding of float32
constexpr float kFar = std::numeric_limits<float>::infinity();
// Sides are grouped and surfaces taken for flat within this lean (1-norm of the difference of unit normals): rounding
// to float32 leans a real level's triangles by 1e-6, and the bound costs the walk as much of a segment's length.
constexpr double kMostTilt = 3e-5;
// A triangle whose doubled area is below this part of its longest edge squared has no trustworthy plane in doubles:
// above it the normal's error stays below 2^-29.
constexpr double kThinnest = 0x1p-20;
constexpr double kNormalError = 0x1p-29;
// Edges below this part of the sector's size are left out, their length added to the margin; triangles less high are
// needles; and a vertex this close to a plane lies in it.
constexpr double kShortest = 1e-5;
constexpr double kPadding = 1.001;
// Rooms within these sizes, JKU, neither overflow float32 nor come near its subnormals; others are always in doubt.
constexpr double kSmallest = 0x1p-60, kLargest = 0x1p60;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }
double norm1(const Vector& a) { return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]); }
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector scaled(const Vector& a, double factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }

struct Plane {
    Vector normal;
    double offset;
};

// A flat part of a surface: all of it, or one triangle of a bent one.
struct Piece {
    Index surface;
    std::vector<Vector> polygon;
    std::vector<Index> triangles, needles;
};

struct Edge {
    double a, b, c;
};

struct Wall {  // a side in the making
    Plane plane;
    std::vector<Piece> pieces;
};

Vector normal_of(const std::vector<Vector>& t, double& doubled) {
    const Vector area = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    doubled = length(area);
    return scaled(area, 1 / doubled);
}

double longest_edge(const std::vector<Vector>& t) {
    return std::max({length(minus(t[1], t[0])), length(minus(t[2], t[1])), length(minus(t[0], t[2]))});
}

class Builder {
public:
    Builder(const SectorMesh& mesh, const Fans& fans, Rooms& out) : mesh_(mesh), fans_(fans), out_(out) {}

    void add(std::size_t sector) {
        first_ = mesh_.sector_first[sector];
        end_ = first_ + mesh_.sector_count[sector];
        measure();
        walls_.clear();
        bounded_ = radius_ > kSmallest && radius_ < kLargest;
        room_.plane = static_cast<Index>(out_.planes.size());
        room_.needle = static_cast<Index>(out_.needles.size());
        for (Index s = first_; s < end_; ++s) place(s);
        for (std::size_t w = 0; w < walls_.size(); ++w) pack(w);
        room_.planes = static_cast<Index>(out_.planes.size()) - room_.plane;
        room_.needles = static_cast<Index>(out_.needles.size()) - room_.needle;
        room_.sides = static_cast<Index>(walls_.size());
        if (!bounded_) room_.center[0] = std::numeric_limits<double>::quiet_NaN();
        out_.rooms.push_back(room_);
    }

private:
    void measure() {
        Vector low, high;
        low.fill(std::numeric_limits<double>::infinity());
        high.fill(-std::numeric_limits<double>::infinity());
        for (Index c = mesh_.surface_start[first_]; c < mesh_.surface_start[end_]; ++c)
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], mesh_.vertex(mesh_.surface_vertex[c])[k]);
                high[k] = std::max(high[k], mesh_.vertex(mesh_.surface_vertex[c])[k]);
            }
        radius_ = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            room_.center[k] = low[k] <= high[k] ? low[k] / 2 + high[k] / 2 : 0;
            radius_ = std::max(radius_, high[k] - room_.center[k]);
        }
    }

    Vector local(const double* p) const {
        return {p[0] - room_.center[0], p[1] - room_.center[1], p[2] - room_.center[2]};
    }

    std::vector<Vector> corners(Index surface) const {
        std::vector<Vector> out;
        for (Index c = mesh_.surface_start[surface]; c < mesh_.surface_start[surface + 1]; ++c)
            out.push_back(local(mesh_.vertex(mesh_.surface_vertex[c])));
        return out;
    }

    // Along the polygon's vector area through the mean of its vertices, rounded to float32.
    static Plane plane_of(const std::vector<Vector>& polygon) {
        Vector area{0, 0, 0}, mean{0, 0, 0};
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vector turn = cross(minus(polygon[i], polygon[0]), minus(polygon[(i + 1) % polygon.size()], polygon[0]));
            for (std::size_t k = 0; k < 3; ++k) {
                area[k] += turn[k];
                mean[k] += polygon[i][k] / static_cast<double>(polygon.size());
            }
        }
        const Vector normal = scaled(area, 1 / length(area));
        Plane plane{normal, -dot(normal, mean)};
        for (double& x : plane.normal) x = static_cast<float>(x);
        plane.offset = static_cast<float>(plane.offset);
        return plane;
    }

    std::vector<Vector> corners_of(Index triangle) const {
        const Fans::Triangle& t = fans_.triangles[static_cast<std::size_t>(triangle)];
        return {local(t.a), local(t.b), local(t.c)};
    }

    bool is_needle(const std::vector<Vector>& t) const {
        double doubled;
        normal_of(t, doubled);
        const double longest = longest_edge(t);
        return !(doubled > kThinnest * longest * longest && doubled > kShortest * radius_ * longest);
    }

    // Puts a surface on walls that it lies in, whole where it is flat, or its triangles one by one.
    void place(Index surface) {
        Piece whole{surface, corners(surface), {}, {}};
        for (Index t = fans_.start[surface]; t < fans_.start[surface + 1]; ++t)
            (is_needle(corners_of(t)) ? whole.needles : whole.triangles).push_back(t);
        if (whole.triangles.empty() && whole.needles.empty()) return;  // without area it is never crossed
        const Plane plane = plane_of(whole.polygon);
        if (flat(whole, plane)) return put(std::move(whole), plane);
        // The needles of a bent surface go with its first triangle; where they are far from its plane, no bound holds.
        for (const Index t : whole.triangles) {
            const std::vector<Vector> polygon = corners_of(t);
            put({surface, polygon, {t}, std::exchange(whole.needles, {})}, plane_of(polygon));
        }
        if (!whole.needles.empty()) bounded_ = false;
    }

    bool flat(const Piece& piece, const Plane& plane) const {
        return norm1(plane.normal) < 2 && lies_in(plane, piece.polygon) &&
               std::all_of(piece.triangles.begin(), piece.triangles.end(), [&](Index t) {
                   double doubled;
                   return norm1(minus(normal_of(corners_of(t), doubled), plane.normal)) < kMostTilt;
               });
    }

    void put(Piece piece, const Plane& plane) {
        for (Wall& wall : walls_)
            if (norm1(minus(wall.plane.normal, plane.normal)) < kMostTilt && lies_in(wall.plane, piece.polygon)) {
                wall.pieces.push_back(std::move(piece));
                return;
            }
        walls_.push_back({plane, {std::move(piece)}});
    }

    bool lies_in(const Plane& plane, const std::vector<Vector>& polygon) const {
        return std::all_of(polygon.begin(), polygon.end(),
                           [&](const Vector& v) { return distance(plane, v) < kShortest * radius_; });
    }

    static double distance(const Plane& plane, const Vector& v) { return std::abs(dot(plane.normal, v) + plane.offset); }

    void pack(std::size_t w) {
        const Wall& wall = walls_[w];
        const std::size_t lane = w % PlaneBlock::kSides;
        if (lane == 0) {
            const Float8 zero{};
            out_.planes.push_back({zero, zero, zero, zero + kFar, zero, zero});
            out_.sides.resize(out_.sides.size() + PlaneBlock::kSides);
        }
        side_ = static_cast<Index>(out_.sides.size() - PlaneBlock::kSides + lane);
        PlaneBlock& block = out_.planes.back();
        block.x[lane] = static_cast<float>(wall.plane.normal[0]);
        block.y[lane] = static_cast<float>(wall.plane.normal[1]);
        block.z[lane] = static_cast<float>(wall.plane.normal[2]);
        block.d[lane] = static_cast<float>(wall.plane.offset);
        still_ = tilt_ = 0;
        const Vector size{std::abs(wall.plane.normal[0]), std::abs(wall.plane.normal[1]), std::abs(wall.plane.normal[2])};
        const auto axis = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
        const auto first = static_cast<Index>(out_.polygons.size());
        for (const Piece& piece : wall.pieces) pack_polygon(piece, axis, wall);
        const auto count = static_cast<std::uint16_t>(out_.polygons.size() - static_cast<std::size_t>(first));
        out_.sides[static_cast<std::size_t>(side_)] = {first, count, static_cast<std::uint16_t>(axis)};
        block.still[lane] = static_cast<float>((still_ + kUnit * (4 * std::abs(wall.plane.offset) + radius_)) * kPadding);
        block.tilt[lane] = static_cast<float>((tilt_ + 9 * kUnit) * kPadding);
    }

    // Widens the side's bounds to hold the piece.
    void bound(const Piece& piece, const Plane& plane, std::size_t axis) {
        for (const Index t : piece.triangles) {
            double doubled;
            const std::vector<Vector> corners = corners_of(t);
            const Vector normal = normal_of(corners, doubled);
            tilt_ = std::max(tilt_, norm1(minus(normal, plane.normal)) + 2 * kNormalError);
            still_ = std::max(still_, std::abs(-dot(normal, corners[0]) - plane.offset) + 4 * kNormalError * radius_);
        }
        for (const Index t : piece.needles) {
            const std::vector<Vector> corners = corners_of(t);
            for (const Vector& v : corners) still_ = std::max(still_, distance(plane, v));
            out_.needles.push_back(needle(t, corners, (axis + 1) % 3, (axis + 2) % 3));
        }
    }

    Needle needle(Index triangle, const std::vector<Vector>& corners, std::size_t p, std::size_t q) const {
        std::size_t i = 0;  // the edge that shows longest
        const auto span = [&](std::size_t k) {
            return std::hypot(corners[(k + 1) % 3][p] - corners[k][p], corners[(k + 1) % 3][q] - corners[k][q]);
        };
        for (std::size_t k = 1; k < 3; ++k)
            if (span(k) > span(i)) i = k;
        const Vector &here = corners[i], &next = corners[(i + 1) % 3], &third = corners[(i + 2) % 3];
        const double a = (here[q] - next[q]) / span(i), b = (next[p] - here[p]) / span(i);
        const double c = -(a * here[p] + b * here[q]);
        const double margin = (std::abs(a * third[p] + b * third[q] + c) + 16 * kUnit * radius_) * kPadding;
        return {triangle, side_, static_cast<float>(a), static_cast<float>(b), static_cast<float>(c),
                static_cast<float>(margin)};
    }

    // The edges of a polygon in two coordinates, inside positive; short ones are left out.
    std::vector<Edge> edges_of(const Piece& piece, std::size_t axis, const Plane& plane) const {
        const std::size_t p = (axis + 1) % 3, q = (axis + 2) % 3;
        const double turn = plane.normal[axis] > 0 ? 1 : -1;
        std::vector<Edge> edges;
        for (std::size_t i = 0; i < piece.polygon.size(); ++i) {
            const Vector &here = piece.polygon[i], &next = piece.polygon[(i + 1) % piece.polygon.size()];
            const double along_p = turn * (next[p] - here[p]), along_q = turn * (next[q] - here[q]);
            const double size = std::hypot(along_p, along_q);
            if (size < kShortest * radius_) continue;
            const double a = -along_q / size, b = along_p / size;
            edges.push_back({a, b, -(a * here[p] + b * here[q])});
        }
        return edges;
    }

    // How far all of another piece comes within the edge that it keeps off most.
    static double intrusion(const std::vector<Edge>& edges, const Piece& other, std::size_t axis) {
        double least = std::numeric_limits<double>::infinity();
        for (const Edge& edge : edges) {
            double most = -least;
            for (const Vector& v : other.polygon)
                most = std::max(most, edge.a * v[(axis + 1) % 3] + edge.b * v[(axis + 2) % 3] + edge.c);
            least = std::min(least, most);
        }
        return least;
    }

    void pack_polygon(const Piece& piece, std::size_t axis, const Wall& wall) {
        bound(piece, wall.plane, axis);
        double left_out = 0, outside = 0;
        for (const Index t : piece.needles) {
            double doubled;
            const std::vector<Vector> corners = corners_of(t);
            normal_of(corners, doubled);
            left_out += 2 * doubled / longest_edge(corners);
        }
        const std::vector<Vector>& polygon = piece.polygon;
        const std::size_t p = (axis + 1) % 3, q = (axis + 2) % 3, from = out_.polygons.size();
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vector& next = polygon[(i + 1) % polygon.size()];
            const double size = std::hypot(next[p] - polygon[i][p], next[q] - polygon[i][q]);
            if (size < kShortest * radius_) left_out += 2 * size;
        }
        const std::vector<Edge> edges = edges_of(piece, axis, wall.plane);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (i % 4 == 0) open_block(piece.surface);
            out_.polygons.back().a[i % 4] = static_cast<float>(edges[i].a);
            out_.polygons.back().b[i % 4] = static_cast<float>(edges[i].b);
            out_.polygons.back().c[i % 4] = static_cast<float>(edges[i].c);
            for (const Vector& v : polygon)
                outside = std::max(outside, -(edges[i].a * v[p] + edges[i].b * v[q] + edges[i].c));
        }
        if (edges.empty()) open_block(piece.surface), left_out = std::numeric_limits<double>::infinity();
        double others = 0;
        for (const Piece& other : wall.pieces)
            if (&other != &piece) others = std::max(others, intrusion(edges, other, axis));
        const bool apart = others < kShortest * radius_;
        if (apart) outside = std::max(outside, others);
        const double margin = (left_out + outside + 16 * kUnit * radius_) * kPadding;
        for (std::size_t i = from; i < out_.polygons.size(); ++i) {
            out_.polygons[i].margin = static_cast<float>(margin);
            out_.polygons[i].continues = i + 1 < out_.polygons.size();
            out_.polygons[i].apart = apart;
        }
    }

    void open_block(Index surface) {
        const Float4 zero{0, 0, 0, 0}, far{kFar, kFar, kFar, kFar};
        out_.polygons.push_back({zero, zero, far, 0, surface, mesh_.leads_to[static_cast<std::size_t>(surface)], 0, 0});
    }

    const SectorMesh& mesh_;
    const Fans& fans_;
    Rooms& out_;
    Room room_{};
    Index first_ = 0, end_ = 0, side_ = 0;
    bool bounded_ = true;
    double radius_ = 0, still_ = 0, tilt_ = 0;
    std::vector<Wall> walls_;
};

}  // namespace

Rooms::Rooms(const SectorMesh& mesh, const Fans& fans) {
    Builder builder(mesh, fans, *this);
    for (std::size_t s = 0; s < mesh.sectors(); ++s) builder.add(s);
    planes.shrink_to_fit();
    sides.shrink_to_fit();
    polygons.shrink_to_fit();
    needles.shrink_to_fit();
}

std::size_t Rooms::memory() const {
    const auto bytes = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
    return bytes(rooms) + bytes(planes) + bytes(sides) + bytes(polygons) + bytes(needles);
}

}  // namespace jk
