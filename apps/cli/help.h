#pragma once

#include "apps/cli/command.h"

#include <string>

namespace sinew::cli {

/// Output of `sinew --help`.
std::string overview_text();

/// Output of `sinew help COMMAND`.
std::string manual_text(Command& command);

} // namespace sinew::cli
