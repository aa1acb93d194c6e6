// Exact sums, differences and products of doubles, as sums of doubles that do not overlap.
//
// The method is Shewchuk's ("Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
// 1997): two_sum and two_product split a rounded result into itself and its error, FAST-EXPANSION-SUM and
// SCALE-EXPANSION carry that to sums of many parts. It is exact in the default rounding mode as long as nothing
// over- or underflows. The deepest product here has six factors: with coordinates below 2^150 it stays below
// 2^1000, and with coordinates that are multiples of 2^-172 every part is a multiple of 2^-1032, which a subnormal
// double still holds. `fits` tells; Whole (whole.hpp) takes the rest.
#pragma once

#include <boost/container/small_vector.hpp>

#include <cmath>

namespace jk {

class Expansion {
public:
    Expansion() = default;

    // Whether products of six differences of such coordinates are exact.
    static bool fits(double x) {
        const double magnitude = std::abs(x);
        if (magnitude >= 0x1p-120) return magnitude < 0x1p150;
        const double multiple = magnitude * 0x1p172;
        return multiple == std::floor(multiple);
    }

    static Expansion difference(double a, double b) {
        Expansion out;
        const double sum = a - b, part = a - sum, error = (a - (sum + part)) + (part - b);
        out.append(error);
        out.append(sum);
        return out;
    }

    // -1, 0 or 1: the greatest part outweighs all others.
    int sign() const { return parts_.empty() ? 0 : parts_.back() > 0 ? 1 : -1; }

    friend Expansion operator-(Expansion e) {
        for (double& part : e.parts_) part = -part;
        return e;
    }

    friend Expansion operator+(const Expansion& e, const Expansion& f) {
        Expansion out;
        double total = 0;
        bool started = false;
        auto a = e.parts_.begin(), b = f.parts_.begin();
        while (a != e.parts_.end() || b != f.parts_.end()) {
            const bool take_a = b == f.parts_.end() || (a != e.parts_.end() && std::abs(*a) < std::abs(*b));
            const double next = take_a ? *a++ : *b++;
            if (!started) {
                total = next;
                started = true;
                continue;
            }
            out.append(two_sum(total, next));
        }
        out.append(total);
        return out;
    }

    friend Expansion operator-(const Expansion& e, const Expansion& f) { return e + -f; }

    friend Expansion operator*(const Expansion& e, const Expansion& f) {
        Expansion out;
        for (const double factor : f.parts_) out = out + e.scaled(factor);
        return out;
    }

private:
    void append(double part) {
        if (part != 0) parts_.push_back(part);
    }

    // Leaves the rounded sum in `total` and returns its error.
    static double two_sum(double& total, double b) {
        const double a = total, sum = a + b, part = sum - a;
        total = sum;
        return (a - (sum - part)) + (b - part);
    }

    Expansion scaled(double factor) const {
        Expansion out;
        if (parts_.empty()) return out;
        double total = parts_.front() * factor;
        out.append(std::fma(parts_.front(), factor, -total));
        for (std::size_t i = 1; i < parts_.size(); ++i) {
            const double high = parts_[i] * factor, low = std::fma(parts_[i], factor, -high);
            out.append(two_sum(total, low));
            double sum = high;
            out.append(two_sum(sum, total));
            total = sum;
        }
        out.append(total);
        return out;
    }

    boost::container::small_vector<double, 24> parts_;  // rising in magnitude, no zeros
};

}  // namespace jk
