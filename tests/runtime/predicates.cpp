// Answers predicates for test_predicates.py: reads rows of 18 doubles, p0 .. p5 of x y z, and writes six signs and a
// depth each: doubles throughout.
//
// orient3d(p0, p1, p2, p3), orient2d(p0, p1, p2), collinear(p0, p1, p2), compare of the meetings of the way from p3 to
// p4 with the triangles p0 p1 p2 and p0 p2 p5, the same of the way straight down from p3, Expansion's own sign of the
// first (or the answer where it does not fit), and the depth of p0 p1 p2 straight below p3; 9 where a way does not meet
// both planes, or the last not the triangle.
#include <cstdio>

#include "jklb/predicates.hpp"

using namespace jklb;

namespace {

Signed less(const Signed& a, const Signed& b) {
    const double value = a.value - b.value;
    return {value, a.error + b.error + 0x1p-52 * std::abs(value), a.sign >= 0 && b.sign < 0 ? 1 : 0};
}

bool met(const Triangle& t, const Way& way, Meeting& out) {
    const Signed above = orient3d(t.a, t.b, t.c, way.from);
    const Signed fall = way.to ? less(above, orient3d(t.a, t.b, t.c, way.to)) : orient2d(t.a, t.b, t.c);
    out = {t, above, fall};
    return above.sign >= 0 && fall.sign > 0;
}

int order(const Triangle& s, const Triangle& t, const Way& way) {
    Meeting first, second;
    return met(s, way, first) && met(t, way, second) ? compare(first, second, way) : 9;
}

}  // namespace

int main() {
    double p[6][3];
    while (std::fread(p, sizeof p, 1, stdin) == 1) {
        const Triangle s{p[0], p[1], p[2]}, t{p[0], p[2], p[5]};
        const Signed side = orient3d(p[0], p[1], p[2], p[3]);
        Meeting down;
        const bool above = orient2d(p[0], p[1], p[3]).sign >= 0 && orient2d(p[1], p[2], p[3]).sign >= 0 &&
                           orient2d(p[2], p[0], p[3]).sign >= 0;
        const double deep = met(s, {p[3]}, down) && above ? depth(down, {p[3]}) : 9;
        const int exact = detail::fit({p[0], p[1], p[2], p[3]})
                              ? detail::volume<Expansion>(p[0], p[1], p[2], p[3]).sign()
                              : side.sign;
        const double out[] = {double(side.sign), double(orient2d(p[0], p[1], p[2]).sign),
                              double(collinear(p[0], p[1], p[2])), double(order(s, t, {p[3], p[4]})),
                              double(order(s, t, {p[3]})), double(exact), deep};
        std::fwrite(out, sizeof out, 1, stdout);
    }
}
