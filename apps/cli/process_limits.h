#pragma once

#include <optional>

namespace CLI {
class App;
}

/// Limits of the whole process, for scenes of strangers: options of every command.
namespace sinew::cli {

struct ProcessLimits {
    std::optional<int> megabytes;
    std::optional<double> seconds;
};

void declare_limits(CLI::App& parser, ProcessLimits& target);

/// From now on a process that needs more ends at once, with a message and exit code 1; unfinished files are removed.
/// Throws CommandError where the system has no such limit.
void set_limits(const ProcessLimits& limits);

} // namespace sinew::cli
