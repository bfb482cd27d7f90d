#include "bindings/python/core/failure.h"

#include <pybind11/pybind11.h>

namespace py = pybind11;

namespace sinew::python {
namespace {

/// Text of the engine, which shows a file's own text: bytes that are no UTF-8 become marks of replacement.
py::str text_of(const char* text) {
    return py::reinterpret_steal<py::str>(
        PyUnicode_DecodeUTF8(text, Py_ssize_t(std::char_traits<char>::length(text)), "replace"));
}

py::list diagnostics() {
    py::list all;
    for (std::size_t i = 0; i < sinew_diagnostic_count(); ++i) {
        sinew_diagnostic one;
        sinew_diagnostic_at(i, &one);
        all.append(py::make_tuple(text_of(one.source), one.line, one.column, one.length, text_of(one.path),
                                  text_of(one.message), text_of(one.help), text_of(one.text), one.is_override != 0));
    }
    return all;
}

} // namespace

void raise(sinew_status status, const std::string& message) {
    const auto errors = py::module_::import("sinew.errors");
    const py::object error = status == SINEW_BAD_SCENE ? errors.attr("scene_error")(diagnostics())
                                                       : errors.attr("error_of")(int(status), text_of(message.c_str()));
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
    throw py::error_already_set();
}

void raise(sinew_status status) {
    raise(status, sinew_message());
}

} // namespace sinew::python
