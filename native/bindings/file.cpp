// The door to native/file.
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>

#include <stdexcept>
#include <vector>

#include "arrays.hpp"
#include "file/parts.hpp"

namespace nb = nanobind;

NB_MODULE(_native_file, m) {
    m.doc() = "Native reader of compiled levels; only jktools.compiler imports it.";
    m.def(
        "level_fault", [](jk::Array<std::uint8_t> buffer) {
            nb::gil_scoped_release release;
            return jk::level_fault(jk::view(buffer));
        },
        nb::arg("buffer"),
        "What is wrong with a buffer that should be a compiled level, in one sentence; empty for one that can be read\n"
        "everywhere. The buffer must start at a multiple of 8 bytes.");
    m.def(
        "level_parts", [](jk::Array<std::uint8_t> buffer, jk::Array<std::uint16_t> columns) {
            if (columns.size() % 3) throw std::invalid_argument("three numbers tell of a column");
            std::vector<jk::Wanted> wanted(columns.size() / 3);
            for (std::size_t i = 0; i < wanted.size(); ++i)
                wanted[i] = {columns(3 * i), columns(3 * i + 1), columns(3 * i + 2)};
            std::vector<double> steps;
            auto parts = jk::parts_of(jk::view(buffer), wanted, steps);
            return std::pair(jk::hand_over(std::move(parts)), jk::hand_over(std::move(steps)));
        },
        nb::arg("buffer"), nb::arg("columns"),
        "Where the columns of a buffer without a fault lie: (columns * 10,) int64, and the step of each, (columns,)\n"
        "float64; native/file/parts.hpp tells what the numbers mean. `columns` has three numbers for each: the vtable\n"
        "offsets of its section (0: the level itself), of its vector and of its packed form (0: none).");
}
