// Exact sums, differences and products of doubles.
//
// Two number types with the same operations. Expansion is fast and holds what coordinates of levels come to; Dyadic is
// slow and holds everything that finite doubles come to. predicates.hpp chooses.
//
// What this needs of the compiler, and checks as far as it can: IEEE 754 doubles, evaluated as doubles
// (FLT_EVAL_METHOD 0: SSE2, AVX, ARM64, WASM; not the x87 stack), no -ffast-math. And of the caller: round to nearest,
// the default, while a query runs. A contracted multiply-add (-ffp-contract=fast) does no harm: the only products here
// are those whose error the same line takes by std::fma, and a filter only gains by a rounding less.
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#if defined(__FAST_MATH__) || defined(_M_FP_FAST)
#error "jklb: -ffast-math (/fp:fast) lets the compiler drop the very errors that exact arithmetic is made of"
#endif

namespace jklb {

static_assert(std::numeric_limits<double>::is_iec559, "jklb needs IEEE 754 doubles");
#if defined(FLT_EVAL_METHOD)
static_assert(FLT_EVAL_METHOD == 0, "jklb needs doubles that are evaluated as doubles: -msse2 -mfpmath=sse");
#endif

// The sum of doubles, its parts, that do not overlap: none has a bit in the place of another's, so the greatest tells
// the sign. In the manner of Shewchuk ("Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", 1997): an addition splits into the rounded sum and what the rounding lost, both doubles, and so does a
// product; a part is added to an expansion by carrying such sums through it (his theorem 10).
//
// Exact while no part over- or underflows. The longest product here has six factors, differences of coordinates: with
// coordinates below 2^150 that are multiples of 2^-170 (`fits`; every float32 is one, subnormal ones included) all
// parts lie between 2^-1020 and 2^913, so not even a mode that flushes subnormal doubles to zero does harm.
class Expansion {
public:
    Expansion() = default;
    Expansion(const Expansion& other) { *this = other; }
    Expansion& operator=(const Expansion& other) {
        size_ = other.size_;
        for (int i = 0; i < size_; ++i) parts_[i] = other.parts_[i];
        return *this;
    }

    static bool fits(double x) {
        const double magnitude = std::abs(x);
        if (magnitude >= 0x1p-118) return magnitude < 0x1p150;  // its last bit is 2^-170 or more
        const double multiple = magnitude * 0x1p170;
        return multiple == std::floor(multiple);
    }

    static Expansion difference(double a, double b) {
        Expansion out;
        out.add(a);
        out.add(-b);
        return out;
    }

    int sign() const { return size_ == 0 ? 0 : parts_[size_ - 1] > 0 ? 1 : -1; }

    // Off by 2^-51 of itself at most.
    double about() const { return size_ == 0 ? 0 : parts_[size_ - 1]; }

    friend Expansion operator+(Expansion e, const Expansion& f) {
        for (int i = 0; i < f.size_; ++i) e.add(f.parts_[i]);
        e.compress();
        return e;
    }

    friend Expansion operator-(Expansion e, const Expansion& f) {
        for (int i = 0; i < f.size_; ++i) e.add(-f.parts_[i]);
        e.compress();
        return e;
    }

    friend Expansion operator*(const Expansion& e, const Expansion& f) {
        Expansion out;
        for (int i = 0; i < f.size_; ++i) {
            for (int k = 0; k < e.size_; ++k) {
                const double product = e.parts_[k] * f.parts_[i];
                out.add(std::fma(e.parts_[k], f.parts_[i], -product));
                out.add(product);
            }
            out.compress();
        }
        return out;
    }

private:
    // After `compress` each part is below 2^-52 of the next, so the 1933 binary places above are 39 parts at most; a
    // product adds two for each part of one factor before it is compressed again.
    static constexpr int kCompressed = 40, kMost = 3 * kCompressed;

    void add(double x) {
        int kept = 0;
        for (int i = 0; i < size_; ++i) {
            const double sum = x + parts_[i], rest = sum - x;
            const double lost = (x - (sum - rest)) + (parts_[i] - rest);
            if (lost != 0) parts_[kept++] = lost;
            x = sum;
        }
        if (x != 0) parts_[kept++] = x;
        size_ = kept;
    }

    // Makes the parts few, from the greatest down: each becomes what it and those beneath it round to.
    void compress() {
        if (size_ < 2) return;
        int bottom = size_;
        double above = parts_[size_ - 1];
        for (int i = size_ - 2; i >= 0; --i) {
            const double sum = above + parts_[i], lost = parts_[i] - (sum - above);
            if (lost == 0) {
                above = sum;
                continue;
            }
            parts_[--bottom] = sum;
            above = lost;
        }
        parts_[--bottom] = above;
        for (int i = bottom; i < size_; ++i) parts_[i - bottom] = parts_[i];
        size_ -= bottom;
    }

    double parts_[kMost];  // rising in magnitude, no zeros
    int size_ = 0;
};

// A whole number, of any length, times a power of two: every finite double is one, and sums and products of such are.
class Dyadic {
public:
    Dyadic() = default;

    static Dyadic difference(double a, double b) { return Dyadic(a) - Dyadic(b); }

    int sign() const { return digits_.empty() ? 0 : sign_; }

    friend Dyadic operator+(const Dyadic& a, const Dyadic& b) {
        if (a.digits_.empty()) return b;
        if (b.digits_.empty()) return a;
        Dyadic x = a, y = b;
        x.bring_to(std::min(a.exponent_, b.exponent_));
        y.bring_to(x.exponent_);
        if (x.sign_ == y.sign_) {
            x.add(y);
        } else {
            if (x.below(y)) std::swap(x, y);
            x.take(y);
        }
        return x;
    }

    friend Dyadic operator-(const Dyadic& a, Dyadic b) {
        b.sign_ = -b.sign_;
        return a + b;
    }

    friend Dyadic operator*(const Dyadic& a, const Dyadic& b) {
        Dyadic out;
        out.sign_ = a.sign_ * b.sign_;
        out.exponent_ = a.exponent_ + b.exponent_;
        out.digits_.assign(a.digits_.size() + b.digits_.size(), 0);
        for (std::size_t i = 0; i < a.digits_.size(); ++i) {
            std::uint64_t carry = 0;
            for (std::size_t k = 0; k < b.digits_.size() || carry; ++k) {
                carry += out.digits_[i + k];
                if (k < b.digits_.size()) carry += std::uint64_t{a.digits_[i]} * b.digits_[k];
                out.digits_[i + k] = static_cast<std::uint32_t>(carry);
                carry >>= 32;
            }
        }
        out.trim();
        return out;
    }

    // |a / b|, off by 2^-50 of itself at most where that is no subnormal. Neither is zero.
    friend double rough_quotient(const Dyadic& a, const Dyadic& b) {
        int a_exponent, b_exponent;
        const double a_top = a.top(a_exponent), b_top = b.top(b_exponent);
        return std::ldexp(a_top / b_top, a_exponent - b_exponent);
    }

private:
    explicit Dyadic(double x) : sign_(x < 0 ? -1 : 1) {
        const double fraction = std::frexp(std::abs(x), &exponent_);
        auto whole = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
        exponent_ -= 53;
        for (; whole; whole >>= 32) digits_.push_back(static_cast<std::uint32_t>(whole));
    }

    double top(int& exponent) const {
        const std::size_t n = digits_.size();
        exponent = exponent_ + 32 * static_cast<int>(n - 1);
        double sum = 0;
        for (std::size_t i = n > 3 ? n - 3 : 0; i < n; ++i) sum = std::ldexp(sum, -32) + digits_[i];
        return sum;
    }

    void bring_to(int exponent) {
        const int shift = exponent_ - exponent, bits = shift % 32;
        std::uint32_t carry = 0;
        for (std::uint32_t& digit : digits_) {
            const std::uint64_t wide = (std::uint64_t{digit} << bits) | carry;
            digit = static_cast<std::uint32_t>(wide);
            carry = static_cast<std::uint32_t>(wide >> 32);
        }
        if (carry) digits_.push_back(carry);
        digits_.insert(digits_.begin(), static_cast<std::size_t>(shift / 32), 0);
        exponent_ = exponent;
    }

    // The following three compare, add and take magnitudes of one exponent.
    bool below(const Dyadic& other) const {
        if (digits_.size() != other.digits_.size()) return digits_.size() < other.digits_.size();
        for (std::size_t i = digits_.size(); i-- > 0;)
            if (digits_[i] != other.digits_[i]) return digits_[i] < other.digits_[i];
        return false;
    }

    void add(const Dyadic& other) {
        if (digits_.size() < other.digits_.size()) digits_.resize(other.digits_.size());
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < digits_.size(); ++i) {
            carry += std::uint64_t{digits_[i]} + (i < other.digits_.size() ? other.digits_[i] : 0);
            digits_[i] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        if (carry) digits_.push_back(1);
    }

    void take(const Dyadic& lesser) {
        std::uint64_t borrow = 0;
        for (std::size_t i = 0; i < digits_.size(); ++i) {
            const std::uint64_t less = (i < lesser.digits_.size() ? lesser.digits_[i] : 0) + borrow;
            borrow = digits_[i] < less;
            digits_[i] = static_cast<std::uint32_t>(digits_[i] - less);
        }
        trim();
    }

    void trim() {
        while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
    }

    int sign_ = 1, exponent_ = 0;
    std::vector<std::uint32_t> digits_;  // from the least, no zero at the end; none for 0
};

}  // namespace jklb
