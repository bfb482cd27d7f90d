#pragma once

#include "bindings/c/sinew.h"

#include <cstddef>
#include <map>
#include <memory>
#include <pybind11/numpy.h>
#include <vector>

namespace sinew::python {

namespace py = pybind11;

/// Columns that the engine computes when asked for: tensions, strains, ends, sleep. Memory of their own, which arrays
/// show without a copy, and which is computed again after a step while an array shows it. All functions need the GIL.
class ComputedColumns {
  public:
    static bool has(int column);
    /// Computes a column and shows it; an array that cannot be written to.
    py::array show(sinew_world handle, int column);
    /// Computes again all that is shown. Arrays whose number of rows has changed keep their last values.
    void refresh(sinew_world handle);
    /// Arrays shown keep their last values from now on.
    void forget() { columns_.clear(); }

  private:
    using Memory = std::vector<std::byte>;
    std::map<int, std::shared_ptr<Memory>> columns_; ///< by number; each array shares its own
};

/// Type and shape of an array of a column.
py::dtype type_of(const sinew_view& view);
std::vector<py::ssize_t> shape_of(const sinew_view& view, int column);

} // namespace sinew::python
