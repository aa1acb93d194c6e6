#include "geometry/volume.hpp"

#include <cmath>
#include <initializer_list>

#include "geometry/expansion.hpp"
#include "geometry/whole.hpp"

namespace jk {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr double kBound = (7 + 56 * kUnit) * kUnit;
constexpr double kUnderflow = 0x1p-900;

template <typename Exact>
struct Differences {
    Exact x, y, z;
    Differences(const double* a, const double* b)
        : x(Exact::difference(a[0], b[0])), y(Exact::difference(a[1], b[1])), z(Exact::difference(a[2], b[2])) {}
};

template <typename Exact>
Exact exact_volume(const Corners& t, const double* p) {
    const Differences<Exact> u(t.b, t.a), v(t.c, t.a), w(p, t.a);
    return (u.y * v.z - u.z * v.y) * w.x + (u.z * v.x - u.x * v.z) * w.y + (u.x * v.y - u.y * v.x) * w.z;
}

template <typename Exact>
int exact_comparison(const Corners& s, const Corners& t, const double* p, const double* q) {
    return (exact_volume<Exact>(s, p) * exact_volume<Exact>(t, q) -
            exact_volume<Exact>(t, p) * exact_volume<Exact>(s, q)).sign();
}

template <typename Exact>
bool exactly_on_one_line(const Corners& t) {
    const Differences<Exact> u(t.b, t.a), v(t.c, t.a);
    return (u.y * v.z - u.z * v.y).sign() == 0 && (u.z * v.x - u.x * v.z).sign() == 0 &&
           (u.x * v.y - u.y * v.x).sign() == 0;
}

bool fit(std::initializer_list<const double*> points) {
    for (const double* p : points)
        if (!Expansion::fits(p[0]) || !Expansion::fits(p[1]) || !Expansion::fits(p[2])) return false;
    return true;
}

}  // namespace

Volume volume(const double* a, const double* b, const double* c, const double* p) {
    const double ax = a[0] - p[0], ay = a[1] - p[1], az = a[2] - p[2];
    const double bx = b[0] - p[0], by = b[1] - p[1], bz = b[2] - p[2];
    const double cx = c[0] - p[0], cy = c[1] - p[1], cz = c[2] - p[2];
    const double bxcy = bx * cy, cxby = cx * by, cxay = cx * ay, axcy = ax * cy, axby = ax * by, bxay = bx * ay;
    const double value = -(az * (bxcy - cxby) + bz * (cxay - axcy) + cz * (axby - bxay));
    const double sum = (std::abs(bxcy) + std::abs(cxby)) * std::abs(az) +
                       (std::abs(cxay) + std::abs(axcy)) * std::abs(bz) +
                       (std::abs(axby) + std::abs(bxay)) * std::abs(cz);
    const double error = kBound * sum + kUnderflow;
    if (value > error) return {value, error, 1};
    if (-value > error) return {value, error, -1};
    // Four points with one coordinate in common lie in a plane: the usual doubt in levels built on a grid.
    if ((ax == 0 && bx == 0 && cx == 0) || (ay == 0 && by == 0 && cy == 0) || (az == 0 && bz == 0 && cz == 0))
        return {0, 0, 0};
    const Corners t{a, b, c};
    const int sign = fit({a, b, c, p}) ? exact_volume<Expansion>(t, p).sign() : exact_volume<Whole>(t, p).sign();
    return {value, error, sign};
}

int compare_products(const Corners& s, const Corners& t, const double* p, const double* q) {
    if (fit({s.a, s.b, s.c, t.a, t.b, t.c, p, q})) return exact_comparison<Expansion>(s, t, p, q);
    return exact_comparison<Whole>(s, t, p, q);
}

bool on_one_line(const double* a, const double* b, const double* c) {
    const Corners t{a, b, c};
    return fit({a, b, c}) ? exactly_on_one_line<Expansion>(t) : exactly_on_one_line<Whole>(t);
}

}  // namespace jk
