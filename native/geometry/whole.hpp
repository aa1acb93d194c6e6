// Exact arithmetic on doubles of any size, as whole multiples of the smallest double: slow, for what an Expansion
// cannot hold. A product of k factors is a multiple of that unit's k-th power; only signs are asked for.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>

namespace jk {

class Whole {
public:
    static Whole difference(double a, double b) { return {units(a) - units(b)}; }

    int sign() const { return n_.sign(); }

    friend Whole operator+(const Whole& a, const Whole& b) { return {a.n_ + b.n_}; }
    friend Whole operator-(const Whole& a, const Whole& b) { return {a.n_ - b.n_}; }
    friend Whole operator*(const Whole& a, const Whole& b) { return {a.n_ * b.n_}; }

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
