#pragma once

#include "apps/play/eye.h"
#include "apps/play/tape.h"

#include <cstddef>

namespace sinew::play {

/// A session in its own part of the picture. In a split view there are two, side by side, which step together.
struct Pane {
    Tape tape;
    Eye eye;
    std::size_t told = 0; ///< of the session's happenings
};

} // namespace sinew::play
