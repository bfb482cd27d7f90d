#include "bindings/python/core/computed_columns.h"

#include "bindings/python/core/failure.h"

#include <cstring>

namespace sinew::python {
namespace {

/// The column as computed now; false where the simulation is closed.
bool computed(sinew_world handle, int column, sinew_view& view) {
    return sinew_world_get_column(handle, sinew_column(column), &view) == SINEW_OK;
}

std::size_t bytes_of(const sinew_view& view, int column) {
    std::size_t count = view.number_bytes;
    for (const auto rows : shape_of(view, column)) count *= std::size_t(rows);
    return count;
}

} // namespace

py::dtype type_of(const sinew_view& view) {
    if (view.is_integer) return py::dtype::of<std::uint32_t>();
    return view.number_bytes == 4 ? py::dtype::of<float>() : py::dtype::of<double>();
}

std::vector<py::ssize_t> shape_of(const sinew_view& view, int column) {
    std::vector<py::ssize_t> shape{py::ssize_t(view.rows)};
    if (column <= SINEW_VELOCITY || column == SINEW_CONSTRAINT_ENDS) shape.push_back(py::ssize_t(view.components));
    return shape;
}

bool ComputedColumns::has(int column) {
    return column == SINEW_CONSTRAINT_ENDS || column == SINEW_ASLEEP || column == SINEW_TENSION ||
           column == SINEW_STRAIN;
}

py::array ComputedColumns::show(sinew_world handle, int column) {
    sinew_view view{};
    check(sinew_world_get_column(handle, sinew_column(column), &view));
    const auto bytes = bytes_of(view, column);
    auto& memory = columns_[column];
    if (!memory || memory->size() != bytes) memory = std::make_shared<Memory>(bytes);
    if (bytes > 0) std::memcpy(memory->data(), view.data, bytes);
    const py::capsule owner(new std::shared_ptr<Memory>(memory),
                            [](void* shared) { delete static_cast<std::shared_ptr<Memory>*>(shared); });
    py::array array(type_of(view), shape_of(view, column), memory->data(), owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

void ComputedColumns::refresh(sinew_world handle) {
    for (auto& [column, memory] : columns_) {
        if (!memory || memory.use_count() == 1) continue;
        sinew_view view{};
        if (computed(handle, column, view) && bytes_of(view, column) == memory->size())
            std::memcpy(memory->data(), view.data, memory->size());
        else
            memory = nullptr;
    }
}

} // namespace sinew::python
