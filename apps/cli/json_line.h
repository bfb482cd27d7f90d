#pragma once

#include "sinew/scene/json.h"

#include <string>

namespace sinew::cli {

/// The value on one line. What is infinite or not a number is null: JSON has no word for it.
std::string to_line(const json::Value& value);

} // namespace sinew::cli
