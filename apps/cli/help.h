#pragma once

#include "apps/cli/command.h"

#include <string>

namespace sinew::cli {

/// What `sinew --help` prints.
std::string overview_text();

/// What `sinew help COMMAND` prints.
std::string manual_text(Command& command);

} // namespace sinew::cli
