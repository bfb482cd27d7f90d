#include "apps/cli/recording_file.h"

#include "apps/cli/console.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/session_file.h"
#include "player/recording_format.h"

#include <limits>

namespace sinew::cli {

bool is_recording_file(const std::string& path) {
    const auto head = head_of(path);
    return play::is_recording(head);
}

RecordingFile read_recording_file(const std::string& path) {
    const auto text = read_text(path, std::numeric_limits<std::size_t>::max() - 1);
    const auto open = opener_for(path);
    SnapshotError error;
    auto recording = play::read_recording(std::as_bytes(std::span(text)), open, error);
    if (!recording) refuse(path, error.text());
    const auto steps = recording->steps;
    const auto cut_short = recording->cut_short;
    auto replay = play::Replay::begin(std::move(*recording), open, error);
    if (!replay) refuse(path, error.text());
    return {std::move(*replay), steps, cut_short};
}

} // namespace sinew::cli
