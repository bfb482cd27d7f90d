#pragma once

#include "player/recording.h"

#include <cstdint>
#include <optional>
#include <string>

namespace sinew::cli {

/// A recording from a file, at its first step.
struct RecordingFile {
    play::Replay replay;
    std::uint64_t steps = 0;
    std::optional<std::size_t> cut_short; ///< Recording::cut_short
};

/// True for a file that begins like a recording.
bool is_recording_file(const std::string& path);
/// Throws CommandError with the place of the fault.
RecordingFile read_recording_file(const std::string& path);

} // namespace sinew::cli
