// Exact arithmetic on doubles of any size, as whole multiples of the smallest double: slow, for what an Expansion
// cannot hold. A product of k factors is a multiple of that unit's k-th power.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>

namespace jk {

class Whole {
public:
    Whole() = default;

    static Whole difference(double a, double b) { return {units(a) - units(b)}; }

    int sign() const { return n_.sign(); }

    friend Whole operator+(const Whole& a, const Whole& b) { return {a.n_ + b.n_}; }
    friend Whole operator-(const Whole& a, const Whole& b) { return {a.n_ - b.n_}; }
    friend Whole operator*(const Whole& a, const Whole& b) { return {a.n_ * b.n_}; }

    // The double nearest to a / b, a product of k + 1 factors over one of k: a not negative, b positive; ties to even.
    friend double nearest_quotient(const Whole& a, const Whole& b) {
        if (a.n_.is_zero()) return 0;
        const long digits = static_cast<long>(msb(a.n_)) - static_cast<long>(msb(b.n_));  // the quotient's, or one less
        for (long place = std::max(0L, digits - 53);; ++place) {  // of the last digit; no double has one below unit
            const Integer divisor = b.n_ << place;
            Integer quotient, rest;
            divide_qr(a.n_, divisor, quotient, rest);
            if (quotient >> 53 != 0) continue;
            const int above_half = Integer(2 * rest).compare(divisor);
            if (above_half > 0 || (above_half == 0 && bit_test(quotient, 0))) ++quotient;
            return std::ldexp(quotient.convert_to<double>(), static_cast<int>(place - 1074));
        }
    }

private:
    using Integer = boost::multiprecision::cpp_int;

    Whole(Integer n) : n_(std::move(n)) {}

    static Integer units(double x) {
        int exponent;
        const auto digits = static_cast<long long>(std::ldexp(std::frexp(x, &exponent), 53));
        const int shift = exponent - 53 + 1074;  // below 0 only where the digits end in as many zeros
        return shift >= 0 ? Integer(digits) << shift : Integer(digits / (1LL << -shift));
    }

    Integer n_;
};

}  // namespace jk
