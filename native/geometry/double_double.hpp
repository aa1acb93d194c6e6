// Numbers as sums of two doubles, for quotients that are rounded once.
//
// Sums and products of two parts have a relative error below 2^-102 (Joldes, Muller, Popescu, "Tight and rigorous
// error bounds for basic building blocks of double-word arithmetic", 2017: 3 u^2 for the accurate sum, 5 u^2 for the
// product, u = 2^-53), as long as nothing over- or underflows.
#pragma once

#include <cmath>

namespace jk {

struct DoubleDouble {
    double high, low;

    // For a sum of up to six products of three exact differences: its error at most, as a part of the sum of the
    // absolute products of the rounded differences. Nine operations, 9 * 2^-102, and room for the bound's own rounding.
    static constexpr double kProducts = 0x1p-97;

    DoubleDouble(double high_part, double low_part, int) : high(high_part), low(low_part) {}

    // The exact difference of two doubles.
    DoubleDouble(double a, double b) {
        high = a - b;
        const double part = a - high;
        low = (a - (high + part)) + (part - b);
    }

    friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
        const double product = a.high * b.high, error = std::fma(a.high, b.high, -product);
        return fast_sum(product, error + (a.high * b.low + a.low * b.high));
    }

    friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
        const DoubleDouble s = sum(a.high, b.high), t = sum(a.low, b.low);
        const DoubleDouble v = fast_sum(s.high, s.low + t.high);
        return fast_sum(v.high, t.low + v.low);
    }

    friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
        return a + DoubleDouble(-b.high, -b.low, 0);
    }

    static DoubleDouble sum(double a, double b) {
        const double high = a + b, part = high - a;
        return {high, (a - (high - part)) + (b - part), 0};
    }

    // For |a| >= |b|, or a = 0.
    static DoubleDouble fast_sum(double a, double b) {
        const double high = a + b;
        return {high, b - (high - a), 0};
    }
};

// The double nearest to a / b, both positive and known to within their errors; not a number where these leave a doubt.
inline double quotient(const DoubleDouble& a, double a_error, const DoubleDouble& b, double b_error) {
    const double rough = a.high / b.high;
    const double product = rough * b.high, error = std::fma(rough, b.high, -product);
    const double rest = ((a.high - product) - error + (a.low - rough * b.low)) / b.high;
    // The rest has a relative error below 2^-49 and is below 2^-51 of the whole.
    const DoubleDouble whole = DoubleDouble::fast_sum(rough, rest);
    const double doubt = 2 * ((a_error + whole.high * b_error) / b.high + 0x1p-98 * whole.high);
    const bool sure = b.high > 4 * b_error && whole.high > 0x1p-800 && whole.high + (whole.low + doubt) == whole.high &&
                      whole.high + (whole.low - doubt) == whole.high;
    return sure ? whole.high : std::nan("");
}

}  // namespace jk
