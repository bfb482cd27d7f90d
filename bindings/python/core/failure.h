#pragma once

#include "bindings/c/sinew.h"

#include <string>

namespace sinew::python {

/// Raises the Python exception of a status (sinew/errors.py) with the thread's last message, or with the errors of the
/// thread's last scene. Needs the GIL.
[[noreturn]] void raise(sinew_status status);
[[noreturn]] void raise(sinew_status status, const std::string& message);

inline void check(sinew_status status) {
    if (status != SINEW_OK) raise(status);
}

} // namespace sinew::python
