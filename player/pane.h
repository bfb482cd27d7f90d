#pragma once

#include "player/camera_controller.h"
#include "player/timeline.h"

#include <cstddef>

namespace sinew::play {

/// A session in its part of the picture. A split view has two panes side by side, which step together.
struct Pane {
    Timeline timeline;
    CameraController camera;
    std::size_t told = 0; ///< number of the session's events reported so far
};

} // namespace sinew::play
