#pragma once

#include <cstdint>
#include <filesystem>

namespace sinew::play {

/// The file that keeps unsaved edits.
struct Draft {
    std::filesystem::path path; ///< empty if no drafts are kept
    std::int64_t edits = 0;     ///< the timeline's edits at the last draft
    double age = 0;             ///< seconds since the last draft
};

} // namespace sinew::play
