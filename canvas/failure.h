#pragma once

#include <optional>
#include <string>

namespace sinew::canvas {

/// Empty on success; otherwise the reason, worded for the person who asked for the file.
using Failure = std::optional<std::string>;

} // namespace sinew::canvas
