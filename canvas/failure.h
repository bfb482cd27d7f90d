#pragma once

#include <optional>
#include <string>

namespace sinew::canvas {

/// Nothing when all went well; otherwise what went wrong, in words for the person who asked for the file.
using Failure = std::optional<std::string>;

} // namespace sinew::canvas
