#pragma once

#include "sinew/picture/picture.h"
#include "sinew/session/history.h"
#include "sinew/session/view.h"

namespace sinew {

/// Adds the scene's traces: paths in space, and curves over time in their frames (2D).
void draw_traces(const Scene& scene, const History& history, const View& view, Picture& picture);

} // namespace sinew
