#pragma once

#include "sinew/scene/json.h"

#include <string>

namespace sinew::cli {

/// The value on one line. Infinities and NaN become null, because JSON cannot represent either.
std::string to_line(const json::Value& value);

} // namespace sinew::cli
