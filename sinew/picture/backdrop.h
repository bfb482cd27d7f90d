#pragma once

#include "sinew/picture/picture.h"
#include "sinew/picture/theme.h"
#include "sinew/session/view.h"

namespace sinew {

/// The backdrop of a picture: the bounds of the scene, drawn before all figures.

/// 3D: a pool of light on every plane seen from above, centred below the camera's target. The first thing drawn.
void draw_floors(const Scene& scene, const View& view, const Theme& theme, Picture& picture);

/// 2D: the ground beyond the walls, and a line of `thickness` pixels along each wall.
void draw_walls(const Scene& scene, const View& view, const Theme& theme, float thickness, Picture& picture);

} // namespace sinew
