#pragma once

#include "sinew/scene/image.h"

#include "bindings/python/core/computed_columns.h"
#include "bindings/python/core/failure.h"

#include <chrono>
#include <memory>
#include <mutex>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A simulation as Python holds it: a handle of the C face, which one thread uses at a time.
namespace sinew::python {

/// Rows of points, or ids: C-contiguous, converted where necessary.
using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Ids = py::array_t<std::uint64_t, py::array::c_style>;

/// The lock of a simulation. Waiting threads let others run Python.
class Hold {
  public:
    explicit Hold(std::mutex& mutex) : lock_(mutex, std::try_to_lock) {
        if (lock_.owns_lock()) return;
        const py::gil_scoped_release others;
        lock_.lock();
    }

  private:
    std::unique_lock<std::mutex> lock_;
};

/// Scene and files as read by Python.
struct SceneSource {
    std::string text, name;
    std::vector<std::string> overrides;
    std::vector<std::pair<std::string, std::string>> images; ///< name in the scene, path of the PNG file
    std::vector<std::pair<std::string, std::string>> models; ///< name in the scene, text

    /// Calls open(options) with the options in C; the sizes of images are those of `read`.
    template <class Open> sinew_status with_options(const Images& read, const Open& open) const;
};

class Simulation {
  public:
    explicit Simulation(const SceneSource& source);
    Simulation(sinew_world handle, Images images) : handle_(handle), images_(std::move(images)) {}
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;
    ~Simulation() { sinew_world_close(handle_); }

    sinew_world handle() const { return handle_; }
    std::mutex& mutex() { return mutex_; }
    const Images& images() const { return images_; }

    /// Calls a function of the C face with the handle and further arguments, and raises its failure.
    template <class Function, class... Arguments> void call(Function function, Arguments... arguments) {
        const Hold hold(mutex_);
        check(function(handle_, arguments...));
    }
    /// The same for a function whose last argument is a pointer to its result.
    template <class Result, class Function, class... Arguments> Result ask(Function function, Arguments... arguments) {
        Result result{};
        call(function, arguments..., &result);
        return result;
    }
    /// The same for a function that finds something or nothing; false for nothing.
    template <class Function, class... Arguments> bool finds(Function function, Arguments... arguments) {
        const Hold hold(mutex_);
        const auto status = function(handle_, arguments...);
        if (status != SINEW_NOT_FOUND) check(status);
        return status == SINEW_OK;
    }

    /// A simulation that goes on where that of a snapshot was; `files` has the images and models of its scene.
    static std::unique_ptr<Simulation> load(std::string_view bytes, const SceneSource& files);
    /// The same in place; raises if dimension or precision differ.
    void restore(std::string_view bytes, const SceneSource& files);
    std::unique_ptr<Simulation> copy();
    void close() { call(sinew_world_close); }
    void restart();
    void step(std::uint32_t count);
    void run_until(double seconds);
    /// Shows a column of the C face.
    py::array column(int number);
    /// Brings arrays of computed columns up to date; the caller holds the lock.
    void refresh() { computed_.refresh(handle_); }

  private:
    /// Calls next() without the GIL until it is false. Python's signals (Ctrl-C) are handled between calls.
    template <class Next> void advance(const Next& next);

    sinew_world handle_{};
    Images images_; ///< with pixels, for painting
    ComputedColumns computed_;
    std::mutex mutex_;
};

/// A point of two or three finite numbers; raises otherwise. `what` names the argument.
sinew_point point_of(const Points& numbers, const char* what);
/// True for a world of floats, whose numbers end at 3.4e38.
bool is_float(sinew_world handle);
/// Raises for a number that is not finite in a world, with its row; `rows` is what a row is called.
void check_points(const Points& points, bool is_float, const char* rows = "row");
/// Row `row` of an array of points with 2 or 3 columns.
sinew_point point_at(const Points& points, py::ssize_t row);

// Functions of the module, a file each.
void bind_reading(py::module_& module, py::class_<Simulation, std::shared_ptr<Simulation>>& type);
void bind_search(py::class_<Simulation, std::shared_ptr<Simulation>>& type);
void bind_edit(py::class_<Simulation, std::shared_ptr<Simulation>>& type);
void bind_painting(py::module_& module, py::class_<Simulation, std::shared_ptr<Simulation>>& type);
void bind_exporting(py::module_& module);
void bind_batch(py::module_& module);
void bind_saving(py::module_& module, py::class_<Simulation, std::shared_ptr<Simulation>>& type);

} // namespace sinew::python
