#pragma once

#include "sinew/session/history.h"
#include "sinew/session/picture.h"
#include "sinew/session/view.h"

namespace sinew {

/// Adds what a scene's traces show: ways where they were gone, and curves over time in their frames (2D).
void draw_traces(const Scene& scene, const History& history, const View& view, Picture& picture);

} // namespace sinew
