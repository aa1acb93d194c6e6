// The door to visibility.
#include "geometry/visibility.hpp"

#include <nanobind/stl/tuple.h>

#include <chrono>
#include <optional>
#include <exception>
#include <string>

#include "../arrays.hpp"
#include "doors.hpp"
#include "tiers.hpp"

namespace jk {
namespace {

// Lets Python handle signals and hear of the progress, ten times a second at most.
class Listener {
public:
    explicit Listener(nb::object progress) : progress_(std::move(progress)) {}

    bool hear(std::size_t done, std::size_t all) {
        const auto now = std::chrono::steady_clock::now();
        if (now - last_ < std::chrono::milliseconds(100)) return true;
        last_ = now;
        nb::gil_scoped_acquire acquire;
        try {
            if (PyErr_CheckSignals()) throw nb::python_error();
            if (!progress_.is_none()) progress_(done, all);
        } catch (nb::python_error& error) {
            raised_.emplace(std::move(error));
            return false;
        }
        return true;
    }

    void rethrow() {
        if (raised_) throw nb::python_error(std::move(*raised_));
    }

private:
    nb::object progress_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    std::optional<nb::python_error> raised_;
};

auto visible_sectors(const Viewer& viewer, Array<Index> leads_to, const char* accuracy, unsigned threads,
                     nb::object progress) {
    const Tier tier = tier_of(accuracy);
    Listener listener(std::move(progress));
    Visibility found;
    {
        nb::gil_scoped_release release;
        found = visibility(viewer, view(leads_to), tier, threads,
                           [&](std::size_t done, std::size_t all) { return listener.hear(done, all); });
    }
    listener.rethrow();
    return std::make_tuple(hand_over(std::move(found.rows)), found.portals, found.cut_short);
}

}  // namespace

void open_visibility(nb::module_& m) {
    m.def("visibility", &visible_sectors, nb::arg("viewer"), nb::arg("leads_to"), nb::arg("accuracy"),
          nb::arg("threads"), nb::arg("progress").none(),
          "Answer (rows, portals, cut_short): which sectors can be seen from which.\n\n"
          "rows is uint8, (n + 7) // 8 bytes a sector, the least bit first. leads_to is (surfaces,) int32, as the viewer\n"
          "takes it. progress(done, all) may raise to stop the work. Raises ValueError naming the surface that leads\n"
          "to no sector.");
}

}  // namespace jk
