#include "sinew/scene/document.h"

#include "player/recording.h"

#include <cstdint>
#include <cstdlib>

namespace {

using namespace sinew;

/// Small scenes only: a fuzzer's seconds are for readers.
std::optional<Opened> opened(const std::string& text, const std::string&) {
    auto document = load(text, "fuzz.json");
    if (document.limits.particles > 2000) document.limits.particles = 2000;
    return open_scene(document);
}

} // namespace

/// Any bytes are read as a recording, whole or up to where they end, and played; or refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    SnapshotError error;
    auto recording = play::read_recording(bytes, opened, error);
    if (!recording) {
        if (error.at > size || error.what.empty()) std::abort();
        return 0;
    }
    auto replay = play::Replay::begin(std::move(*recording), opened, error);
    for (int i = 0; replay && i < 20 && replay->step(); ++i) {
    }
    return 0;
}
