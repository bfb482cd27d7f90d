#include "sinew/solver/workers.h"

#include "bindings/python/core/simulation.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <pybind11/stl.h>

/// Many simulations stepped in one call, their columns gathered in arrays.
namespace sinew::python {
namespace {

using Shared = std::shared_ptr<Simulation>;
using Mask = py::array_t<bool, py::array::c_style | py::array::forcecast>;

class Batch {
  public:
    /// Simulations of equal dimension and precision with at least `particles` particles each.
    Batch(std::vector<Shared> worlds, std::uint32_t particles) : worlds_(std::move(worlds)), particles_(particles) {
        locked_ = worlds_;
        std::sort(locked_.begin(), locked_.end());
        locked_.erase(std::unique(locked_.begin(), locked_.end()), locked_.end());
    }

    /// Steps the worlds of `mask` on `threads` threads and writes their columns into positions and velocities, arrays
    /// of (worlds, particles, dimension).
    void step(std::uint32_t count, const Mask& mask, py::array positions, py::array velocities, int threads) {
        for (std::uint32_t taken = 0, next = std::min(count, 1u);;) {
            const auto start = std::chrono::steady_clock::now();
            step_all(next, mask, positions, velocities, threads);
            taken += next;
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (taken == count) return;
            const auto took =
                std::max(std::chrono::steady_clock::now() - start, std::chrono::steady_clock::duration(1));
            const auto share = std::min(double(attention / took) * next, double(count - taken));
            next = std::max(1u, std::uint32_t(share));
        }
    }

    /// Returns the worlds of `mask` to their start.
    void restart(const Mask& mask, int threads) {
        const auto* const is_on = mask.data();
        each(threads, [&](int world) {
            return is_on[world] ? sinew_world_restart(worlds_[std::size_t(world)]->handle()) : SINEW_OK;
        });
    }

    /// Calls function(handle, id, point) for each world, with an id and a point of its own; for none where a number is
    /// wrong.
    template <class Function> void edit(Function function, const Ids& ids, const Points& points) {
        check_points(points, is_float(worlds_.front()->handle()), "world");
        each(1, [&](int world) {
            return function(worlds_[std::size_t(world)]->handle(), ids.data()[world], point_at(points, world));
        });
    }

  private:
    /// Longest time that steps run without a look at Python's signals.
    static constexpr std::chrono::steady_clock::duration attention = std::chrono::milliseconds(50);

    void step_all(std::uint32_t count, const Mask& mask, py::array& positions, py::array& velocities, int threads) {
        const auto* const is_on = mask.data();
        auto* const places = static_cast<char*>(positions.mutable_data());
        auto* const speeds = static_cast<char*>(velocities.mutable_data());
        const auto bytes = std::size_t(positions.nbytes()) / worlds_.size();
        each(threads, [&](int world) {
            if (!is_on[world]) return SINEW_OK;
            const auto handle = worlds_[std::size_t(world)]->handle();
            if (count > 0)
                if (const auto status = sinew_world_step(handle, count)) return status;
            if (const auto status = gather(handle, SINEW_POSITION, places + bytes * std::size_t(world), bytes))
                return status;
            return gather(handle, SINEW_VELOCITY, speeds + bytes * std::size_t(world), bytes);
        });
    }

    std::vector<Shared> worlds_;
    std::uint32_t particles_;
    std::vector<Shared> locked_; ///< each world once, in an order that any two batches share: no deadlock

    sinew_status gather(sinew_world handle, sinew_column column, char* to, std::size_t bytes) const {
        sinew_view view{};
        if (const auto status = sinew_world_get_column(handle, column, &view)) return status;
        if (view.rows < particles_) return SINEW_NOT_FOUND;
        if (bytes != std::size_t(particles_) * view.components * view.number_bytes) return SINEW_FULL;
        std::memcpy(to, view.data, bytes);
        return SINEW_OK;
    }

    static std::string reason_of(sinew_status status) {
        switch (status) {
        case SINEW_NOT_FOUND:
            return "it has lost particles";
        case SINEW_BAD_ID:
            return "the particle or pin is gone";
        case SINEW_BAD_ARGUMENT:
            return "a number is not finite";
        case SINEW_FULL:
            return "an array of the batch has another size";
        default:
            return "it is closed";
        }
    }

    /// Calls work(world) for all worlds on several threads, without the GIL, and raises the first failure.
    template <class Work> void each(int threads, const Work& work) {
        std::vector<std::unique_ptr<Hold>> holds;
        for (const auto& world : locked_) holds.push_back(std::make_unique<Hold>(world->mutex()));
        std::vector<sinew_status> statuses(worlds_.size(), SINEW_OK);
        {
            const py::gil_scoped_release others;
            Workers::run(threads, int(worlds_.size()), [&](int world) { statuses[std::size_t(world)] = work(world); });
        }
        for (const auto& world : locked_) world->refresh();
        const auto failed =
            std::find_if(statuses.begin(), statuses.end(), [](auto status) { return status != SINEW_OK; });
        if (failed == statuses.end()) return;
        const auto number = std::to_string(failed - statuses.begin());
        raise(*failed, "world " + number + ": " + reason_of(*failed));
    }
};

} // namespace

void bind_batch(py::module_& module) {
    py::class_<Batch>(module, "Batch")
        .def(py::init<std::vector<Shared>, std::uint32_t>())
        .def("step", &Batch::step)
        .def("restart", &Batch::restart)
        .def("apply_forces",
             [](Batch& self, const Ids& ids, const Points& forces) { self.edit(sinew_world_apply_force, ids, forces); })
        .def("move_pins",
             [](Batch& self, const Ids& pins, const Points& to) { self.edit(sinew_world_move_pin, pins, to); });
    module.def("hardware_threads", &hardware_threads);
}

} // namespace sinew::python
