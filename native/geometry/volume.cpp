#include "geometry/volume.hpp"

#include <cmath>

namespace jk {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr double kBound = (7 + 56 * kUnit) * kUnit;

struct Differences {
    Expansion x, y, z;
    Differences(const double* a, const double* b)
        : x(Expansion::difference(a[0], b[0])), y(Expansion::difference(a[1], b[1])),
          z(Expansion::difference(a[2], b[2])) {}
};

}  // namespace

Expansion exact_volume(const double* a, const double* b, const double* c, const double* p) {
    const Differences u(b, a), v(c, a), w(p, a);
    return (u.y * v.z - u.z * v.y) * w.x + (u.z * v.x - u.x * v.z) * w.y + (u.x * v.y - u.y * v.x) * w.z;
}

Volume volume(const double* a, const double* b, const double* c, const double* p) {
    const double ax = a[0] - p[0], ay = a[1] - p[1], az = a[2] - p[2];
    const double bx = b[0] - p[0], by = b[1] - p[1], bz = b[2] - p[2];
    const double cx = c[0] - p[0], cy = c[1] - p[1], cz = c[2] - p[2];
    const double bxcy = bx * cy, cxby = cx * by, cxay = cx * ay, axcy = ax * cy, axby = ax * by, bxay = bx * ay;
    const double value = -(az * (bxcy - cxby) + bz * (cxay - axcy) + cz * (axby - bxay));
    const double sum = (std::abs(bxcy) + std::abs(cxby)) * std::abs(az) +
                       (std::abs(cxay) + std::abs(axcy)) * std::abs(bz) +
                       (std::abs(axby) + std::abs(bxay)) * std::abs(cz);
    const double error = kBound * sum;
    if (value > error) return {value, error, 1};
    if (-value > error) return {value, error, -1};
    return {value, error, exact_volume(a, b, c, p).sign()};
}

bool on_one_line(const double* a, const double* b, const double* c) {
    const Differences u(b, a), v(c, a);
    return (u.y * v.z - u.z * v.y).sign() == 0 && (u.z * v.x - u.x * v.z).sign() == 0 &&
           (u.x * v.y - u.y * v.x).sign() == 0;
}

}  // namespace jk
