// The door to native/file.
#include "arrays.hpp"
#include "file/verify.hpp"

namespace nb = nanobind;

NB_MODULE(_native_file, m) {
    m.doc() = "Native verifier of compiled levels; only jktools.compiler imports it.";
    m.def(
        "verify_level", [](jk::Array<std::uint8_t> buffer) {
            nb::gil_scoped_release release;
            return jk::verify_level(jk::view(buffer));
        },
        nb::arg("buffer"),
        "Whether the buffer is a compiled level all of whose offsets stay inside it.");
}
