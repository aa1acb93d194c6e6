// Numbers of 106 bits: the unevaluated sum of two doubles (Dekker 1971; the algorithms are those of Shewchuk 1997).
#pragma once

#include <cmath>

namespace jk {

// Each operation is off by 2^-100 of its result at most, as long as nothing over- or underflows.
struct DoubleDouble {
    double high = 0, low = 0;

    DoubleDouble() = default;
    DoubleDouble(double x) : high(x) {}
    DoubleDouble(double h, double l) : high(h + l), low(l - (high - h)) {}

    explicit operator double() const { return high; }
    DoubleDouble operator-() const { return {-high, -low}; }

    friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
        const DoubleDouble s = sum(a.high, b.high), t = sum(a.low, b.low);
        const DoubleDouble u(s.high, s.low + t.high);
        return {u.high, u.low + t.low};
    }
    friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
    friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
        const double p = a.high * b.high;
        return {p, std::fma(a.high, b.high, -p) + (a.high * b.low + a.low * b.high)};
    }
    friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
        const double q = a.high / b.high;
        const DoubleDouble left = a - b * q;
        const double r = left.high / b.high;
        return DoubleDouble(q, r) + (left - b * r).high / b.high;
    }
    friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
        return a.high < b.high || (a.high == b.high && a.low < b.low);
    }
    friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
    friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) { return !(b < a); }
    friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return !(a < b); }

    friend DoubleDouble sqrt(const DoubleDouble& a) {
        if (!(a.high > 0)) return 0;
        const double root = std::sqrt(a.high);
        return DoubleDouble(root) + (a - DoubleDouble(root) * root) / (2 * root);
    }

private:
    static DoubleDouble sum(double a, double b) {
        const double s = a + b, part = s - a;
        DoubleDouble out;
        out.high = s, out.low = (a - (s - part)) + (b - part);
        return out;
    }
};

}  // namespace jk
