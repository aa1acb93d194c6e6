#include "file/parts.hpp"

#include "jklb/level.hpp"

namespace jk {
namespace {

using Octets = flatbuffers::Vector<std::uint8_t>;  // only to find a vector: its length and its data lie alike for all

constexpr std::int64_t kNoSection = -2, kAbsent = -1, kPlain = 0, kNoValues = 1, kValues = 2;
constexpr flatbuffers::voffset_t kVectors[] = {
    jktools::Packed::VT_I8,  jktools::Packed::VT_U8,  jktools::Packed::VT_I16, jktools::Packed::VT_U16,
    jktools::Packed::VT_I32, jktools::Packed::VT_U32, jktools::Packed::VT_F32, jktools::Packed::VT_F64};

// The members of a table that are offsets, which `flatbuffers::Table` hands to generated code only.
template <typename T>
const T* member(const flatbuffers::Table& table, flatbuffers::voffset_t field) {
    return field ? table.GetPointer<const T*>(field) : nullptr;
}

class Finder {
public:
    Finder(const std::uint8_t* start, std::int64_t* out) : start_(start), out_(out) {}

    void find(const flatbuffers::Table* section, const Wanted& column, double& step) {
        std::fill(out_, out_ + kPart, 0);
        out_[0] = section ? kAbsent : kNoSection;
        if (!section) return;
        if (const auto* plain = member<Octets>(*section, column.plain)) {
            out_[0] = kPlain;
            place(plain, out_ + 1);
        } else if (const auto* packed = member<flatbuffers::Table>(*section, column.packed)) {
            take(*packed, step);
        }
    }

private:
    void take(const flatbuffers::Table& packed, double& step) {
        const auto& told = reinterpret_cast<const jktools::Packed&>(packed);
        out_[0] = kNoValues;
        for (int i = 0; i < 8; ++i)
            if (const auto* values = member<Octets>(packed, kVectors[i])) {
                out_[0] = kValues + i;
                place(values, out_ + 1);
                break;
            }
        const auto* index8 = member<Octets>(packed, jktools::Packed::VT_INDEX8);
        const auto* index = index8 ? index8 : member<Octets>(packed, jktools::Packed::VT_INDEX16);
        if (index) {
            out_[3] = index8 ? 1 : 2;
            place(index, out_ + 4);
        }
        out_[6] = told.count();
        out_[7] = told.first();
        if (const auto* origin = member<Octets>(packed, jktools::Packed::VT_ORIGIN)) place(origin, out_ + 8);
        step = told.step();
    }

    void place(const Octets* vector, std::int64_t* out) const {
        out[0] = vector->data() - start_;
        out[1] = vector->size();
    }

    const std::uint8_t* start_;
    std::int64_t* out_;
};

}  // namespace

std::string level_fault(std::span<const std::uint8_t> buffer) {
    const std::string name = "it";
    std::string error;
    const auto level = jklb::Level::from_memory(buffer.data(), buffer.size(), error, name);
    const std::string before = "cannot read " + name + ": ";
    return level ? "" : error.substr(error.rfind(before, 0) == 0 ? before.size() : 0);
}

std::vector<std::int64_t> parts_of(std::span<const std::uint8_t> buffer, std::span<const Wanted> columns,
                                   std::vector<double>& steps) {
    const auto* root = flatbuffers::GetRoot<flatbuffers::Table>(buffer.data());
    std::vector<std::int64_t> out(columns.size() * kPart);
    steps.assign(columns.size(), 0.0);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const flatbuffers::Table* section = columns[i].section ? member<flatbuffers::Table>(*root, columns[i].section) : root;
        Finder(buffer.data(), &out[i * kPart]).find(section, columns[i], steps[i]);
    }
    return out;
}

}  // namespace jk
