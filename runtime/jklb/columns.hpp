// The columns of a compiled level, in whichever form the file holds them, and the checks that a reader owes them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "../level_generated.h"

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "jklb reads the file in place: little-endian machines only"
#endif

namespace jklb {

// Numbers of a column as they lie in the file. Vectors of files by jktools start at multiples of 8 bytes; a damaged file
// can hold them anywhere, so that each is copied out.
template <typename V>
struct Stored {
    const unsigned char* data;
    std::size_t count;

    std::size_t size() const { return count; }
    V operator[](std::size_t place) const {
        V value;
        std::memcpy(&value, data + place * sizeof value, sizeof value);
        return value;
    }
    // The array itself, or null where it does not start at a multiple of its type.
    const V* array() const {
        return reinterpret_cast<std::uintptr_t>(data) % alignof(V) ? nullptr : reinterpret_cast<const V*>(data);
    }
};

// What the numbers of a column stand for, in the order of docs/format.md.
struct ColumnForm {
    int width = 1;             // numbers a row
    bool has_values = false;   // else every number is `first`, or with `follows` first, first + 1, ...
    bool follows = false;
    std::int64_t first = 0;
    std::size_t count = 0;     // not 0: the one row of values, or what stands for it, is so many rows
    double step = 0;           // not 0: a number n of a row stands for (origin + n) * step
    const flatbuffers::Vector<std::int32_t>* origin = nullptr;  // one for each number of a row; null for zeros
};

// One column: rows of `width` numbers of type T, read where they lie. Of a column that passed the checks every row can
// be read; of another none.
template <typename T>
class Column {
public:
    Column() = default;

    // Of a column that the file does not hold: so many rows of nothing but `fill`.
    Column(std::size_t rows, T fill, int width) : width_(width), rows_(rows), fill_(fill) {}

    Column(const flatbuffers::Vector<T>* plain, int width) : width_(width) {
        take(plain);
        rows_ = value_rows_;
    }

    Column(const jktools::Packed& packed, int width)
        : packed_(true), width_(width), count_(packed.count()), first_(packed.first()), step_(packed.step()),
          origin_(packed.origin()) {
        take(packed.i8()) || take(packed.u8()) || take(packed.i16()) || take(packed.u16()) || take(packed.i32()) ||
            take(packed.u32()) || take(packed.f32()) || take(packed.f64());
        take_index(packed.index8()) || take_index(packed.index16());
        rows_ = index_ ? index_rows_ : count_ ? count_ : value_rows_;
    }

    std::size_t rows() const { return rows_; }

    // Number `lane` of a row.
    T operator()(std::size_t row, int lane = 0) const {
        if (kind_ == kNothing) return packed_ ? static_cast<T>(first_ + static_cast<std::int64_t>(row)) : fill_;
        if (index_) row = index_bytes_ == 1 ? read<std::uint8_t>(index_, row) : read<std::uint16_t>(index_, row);
        else if (count_) row = 0;
        return value(row, lane);
    }

    // All numbers, row by row.
    std::vector<T> all() const {
        std::vector<T> out(rows_ * static_cast<unsigned>(width_));
        copy(out.data());
        return out;
    }

    // The same into an array of rows() times the width numbers, of a type that holds each T.
    template <typename Out>
    void copy(Out* out) const {
        if (kind_ == kNothing) {
            for (std::size_t row = 0; row < rows_; ++row)
                for (int lane = 0; lane < width_; ++lane) *out++ = (*this)(row, lane);
        } else if (step_ != 0 || count_) {
            for (std::size_t row = 0; row < rows_; ++row)
                for (int lane = 0; lane < width_; ++lane) *out++ = (*this)(row, lane);
        } else {
            with_type([this, out](auto type) {
                using V = decltype(type);
                if (!index_) spread<V>(out, [](std::size_t row) { return row; });
                else if (index_bytes_ == 1) spread<V>(out, [this](std::size_t row) { return index_[row]; });
                else spread<V>(out, [this](std::size_t row) { return read<std::uint16_t>(index_, row); });
            });
        }
    }

    // The numbers as the file holds them, in their own type, without one being widened or copied: calls
    // see(values, index) with a `Stored` of that type for the values, and one of std::uint8_t or std::uint16_t for the
    // index, empty where the rows stand for themselves. What the numbers stand for tells `form()`.
    template <typename See>
    void visit(const See& see) const {
        with_type([this, &see](auto type) {
            const Stored<decltype(type)> values{values_, value_rows_ * static_cast<unsigned>(width_)};
            if (index_bytes_ == 2) see(values, Stored<std::uint16_t>{index_, index_rows_});
            else see(values, Stored<std::uint8_t>{index_, index_rows_});
        });
    }

    // How numbers that `visit` shows make rows.
    ColumnForm form() const {
        ColumnForm form;
        form.width = width_;
        form.has_values = kind_ != kNothing;
        form.count = form.has_values || packed_ ? count_ : rows_;
        form.first = packed_ ? first_ : static_cast<std::int64_t>(fill_);
        form.follows = packed_ && kind_ == kNothing;
        form.step = step_;
        form.origin = origin_;
        return form;
    }

    // The numbers in place, or null where the file holds them in another form or not at a multiple of their size.
    const T* plain() const {
        if (packed_ || kind_ == kNothing || reinterpret_cast<std::uintptr_t>(values_) % alignof(T)) return nullptr;
        return reinterpret_cast<const T*>(values_);
    }

private:
    friend class Checks;
    enum Kind { kI8, kU8, kI16, kU16, kI32, kU32, kF32, kF64, kNothing };

    template <typename V>
    static constexpr Kind kind_of() {
        if (std::is_floating_point<V>::value) return sizeof(V) == 4 ? kF32 : kF64;
        const int unsigned_one = std::is_unsigned<V>::value;
        return static_cast<Kind>((sizeof(V) == 1 ? 0 : sizeof(V) == 2 ? 2 : 4) + unsigned_one);
    }

    template <typename V>
    bool take(const flatbuffers::Vector<V>* vector) {
        if (!vector) return false;
        kind_ = kind_of<V>();
        values_ = reinterpret_cast<const unsigned char*>(vector->data());
        value_rows_ = vector->size() / static_cast<unsigned>(width_);
        return true;
    }

    template <typename V>
    bool take_index(const flatbuffers::Vector<V>* vector) {
        if (!vector) return false;
        index_ = reinterpret_cast<const unsigned char*>(vector->data());
        index_rows_ = vector->size();
        index_bytes_ = sizeof(V);
        return true;
    }

    // Calls visit(V{}) with the type of the numbers as they are stored. Of a column that has values.
    template <typename Visit>
    void with_type(const Visit& visit) const {
        switch (kind_) {
            case kI8: return visit(std::int8_t{});
            case kU8: return visit(std::uint8_t{});
            case kI16: return visit(std::int16_t{});
            case kU16: return visit(std::uint16_t{});
            case kI32: return visit(std::int32_t{});
            case kU32: return visit(std::uint32_t{});
            case kF32: return visit(float{});
            case kF64: return visit(double{});
            case kNothing: return;
        }
    }

    template <typename V, typename Out, typename Place>
    void spread(Out* out, const Place& place) const {
        const std::size_t width = static_cast<unsigned>(width_);
        for (std::size_t row = 0; row < rows_; ++row) {
            const std::size_t first = place(row) * width;
            for (std::size_t lane = 0; lane < width; ++lane) {
                const V value = read<V>(values_, first + lane);
                if constexpr (std::is_same<V, double>::value) *out++ = narrow(value);
                else *out++ = static_cast<T>(value);
            }
        }
    }

    // Copied out byte by byte, since a damaged file can hold vectors at any place.
    template <typename V>
    static V read(const unsigned char* data, std::size_t place) {
        V value;
        std::memcpy(&value, data + place * sizeof value, sizeof value);
        return value;
    }

    T value(std::size_t row, int lane) const {
        const std::size_t place = row * static_cast<unsigned>(width_) + static_cast<unsigned>(lane);
        switch (kind_) {
            case kI8: return whole(read<std::int8_t>(values_, place), lane);
            case kU8: return whole(read<std::uint8_t>(values_, place), lane);
            case kI16: return whole(read<std::int16_t>(values_, place), lane);
            case kU16: return whole(read<std::uint16_t>(values_, place), lane);
            case kI32: return whole(read<std::int32_t>(values_, place), lane);
            case kU32: return whole(read<std::uint32_t>(values_, place), lane);
            case kF32: return static_cast<T>(read<float>(values_, place));
            default: return narrow(read<double>(values_, place));
        }
    }

    T whole(std::int64_t number, int lane) const {
        if (step_ == 0) return static_cast<T>(number);
        const std::int32_t origin = origin_ && origin_->size() ? origin_->Get(static_cast<unsigned>(lane)) : 0;
        return narrow((static_cast<double>(number) + origin) * step_);
    }

    static T narrow(double x) {
        if constexpr (std::is_same<T, float>::value) {
            constexpr double kBeyond = 0x1.ffffffp127;  // what rounds to infinity; the language leaves that cast open
            if (std::abs(x) >= kBeyond) return std::copysign(std::numeric_limits<float>::infinity(), x > 0 ? 1.f : -1.f);
        }
        return static_cast<T>(x);
    }

    bool packed_ = false;
    Kind kind_ = kNothing;
    int width_ = 1, index_bytes_ = 0;
    std::size_t rows_ = 0, value_rows_ = 0, index_rows_ = 0, count_ = 0;
    const unsigned char *values_ = nullptr, *index_ = nullptr;
    std::int64_t first_ = 0;
    double step_ = 0;
    const flatbuffers::Vector<std::int32_t>* origin_ = nullptr;
    T fill_ = 0;
};

// A column of a table: the plain vector, or its packed form, or neither.
template <typename T>
Column<T> column(const flatbuffers::Vector<T>* plain, const jktools::Packed* packed, int width, std::size_t rows,
                 T fill = 0) {
    if (plain) return {plain, width};
    return packed ? Column<T>(*packed, width) : Column<T>(rows, fill, width);
}

// What is wrong with columns: the first fault found, in one sentence.
class Checks {
public:
    // Of a file of so many bytes.
    explicit Checks(std::size_t size) : size_(size) {}

    const std::string& fault() const { return fault_; }

    void refuse(const std::string& fault) {
        if (fault_.empty()) fault_ = fault;
    }

    // That the parts of a packed column fit each other, and it claims no more rows than a file of this size can.
    template <typename T>
    void form(const char* name, const Column<T>& c) {
        if (!fault_.empty() || !c.packed_) return;
        const bool has_values = c.kind_ != Column<T>::kNothing, floats = std::is_floating_point<T>::value;
        const bool held_floats = c.kind_ == Column<T>::kF32 || c.kind_ == Column<T>::kF64;
        const std::size_t origins = c.origin_ ? c.origin_->size() : 0;
        if (c.count_ > size_)
            say(name, "claims " + std::to_string(c.count_) + " rows, more than the file has bytes");
        else if (!has_values && (floats || c.width_ != 1 || c.index_ || !c.count_))
            say(name, "has no values");
        else if (!has_values)
            return;
        else if (c.count_ && (c.index_ || c.value_rows_ != 1))
            say(name, "has " + std::to_string(c.value_rows_) + " rows for one that stands for all");
        else if (const std::size_t most = greatest_index(c); c.index_rows_ && most >= c.value_rows_)
            say(name, "takes row " + std::to_string(most) + " of a pool of " + std::to_string(c.value_rows_));
        else if (c.step_ != 0 && (held_floats || !floats || !std::isfinite(c.step_) || c.step_ < 0 ||
                                  (origins && origins != static_cast<unsigned>(c.width_))))
            say(name, "is no grid");
        else if (c.step_ == 0 && (origins || held_floats != floats))
            say(name, std::string("holds ") + kNames[c.kind_] + " for " + type_name<T>());
    }

    template <typename T>
    void rows(const char* name, const Column<T>& c, std::size_t wanted) {
        if (fault_.empty() && c.rows() != wanted)
            say(name, "has " + std::to_string(c.rows()) + " rows, but should have " + std::to_string(wanted));
    }

    // That a column cuts `end` rows in order.
    void cuts(const char* name, const Column<std::uint32_t>& c, std::size_t end) {
        if (!fault_.empty()) return;
        const std::vector<std::uint32_t> starts = c.all();
        const bool good = !starts.empty() && starts.front() == 0 && starts.back() == end &&
                          std::is_sorted(starts.begin(), starts.end());
        if (!good) say(name, "should run from 0 to " + std::to_string(end) + " without a step back, but does not");
    }

    // That every number of a column is at least `least` and below the count of what it names.
    template <typename T>
    void indices(const char* name, const Column<T>& c, int least, std::size_t count, const char* what) {
        if (!fault_.empty()) return;
        const auto bound = static_cast<std::int64_t>(count);
        if (all_within(c, least, bound)) return;
        for (std::size_t i = 0; i < c.rows(); ++i) {
            const std::int64_t value = c(i);
            if (value >= least && value < bound) continue;
            return say(name, std::to_string(i) + " is " + std::to_string(value) + ", but there are " +
                                 std::to_string(count) + " " + what);
        }
    }

private:
    static constexpr const char* kNames[] = {"int8",  "uint8",  "int16",   "uint16",
                                             "int32", "uint32", "float32", "float64"};

    template <typename T>
    static std::string type_name() {
        const char kind = std::is_floating_point<T>::value ? 'f' : std::is_unsigned<T>::value ? 'u' : 'i';
        return kind + std::to_string(sizeof(T));
    }

    // Whether all values are within bounds, those that no row takes included: a quick look that spares the long one.
    template <typename T>
    static bool all_within(const Column<T>& c, std::int64_t least, std::int64_t bound) {
        bool within = false;
        c.with_type([&](auto type) {
            using V = decltype(type);
            // A type that holds other numbers than T is left to the long look.
            if constexpr (std::is_integral<V>::value && sizeof(V) <= sizeof(T)) {
                using Read = std::conditional_t<sizeof(V) == sizeof(T), T, V>;
                const Range found = range<Read>(c.values_, c.value_rows_ * static_cast<unsigned>(c.width_));
                const bool kept = std::is_signed<T>::value || found.low >= 0;
                within = kept && (found.low > found.high || (found.low >= least && found.high < bound));
            }
        });
        return within;
    }

    template <typename T>
    static std::size_t greatest_index(const Column<T>& c) {
        if (!c.index_rows_) return 0;
        return static_cast<std::size_t>(c.index_bytes_ == 1 ? range<std::uint8_t>(c.index_, c.index_rows_).high
                                                            : range<std::uint16_t>(c.index_, c.index_rows_).high);
    }

    struct Range {
        std::int64_t low, high;
    };

    // The least and the greatest of whole numbers that lie one after the other; low above high of none. By lanes that do
    // not wait for each other, which compilers make vector instructions of.
    template <typename V>
    static Range range(const unsigned char* data, std::size_t count) {
        constexpr std::size_t kLanes = 64 / sizeof(V);
        if (!count) return {0, -1};
        V low[kLanes], high[kLanes], block[kLanes];
        const auto take = [&](std::size_t from, std::size_t lanes) {
            std::memcpy(block, data + from * sizeof(V), lanes * sizeof(V));
            for (std::size_t k = 0; k < kLanes; ++k) {
                low[k] = block[k] < low[k] ? block[k] : low[k];
                high[k] = high[k] < block[k] ? block[k] : high[k];
            }
        };
        std::memcpy(block, data, sizeof(V));
        for (std::size_t k = 0; k < kLanes; ++k) low[k] = high[k] = block[k] = block[0];
        std::size_t i = 0;
        for (; i + kLanes <= count; i += kLanes) take(i, kLanes);
        if (i < count) take(i, count - i);  // the other lanes still hold numbers of the column
        return {*std::min_element(low, low + kLanes), *std::max_element(high, high + kLanes)};
    }

    void say(const char* name, const std::string& what) { fault_ = std::string(name) + " " + what; }

    std::size_t size_;
    std::string fault_;
};

}  // namespace jklb
