#pragma once

#include "sinew/picture/picture.h"
#include "sinew/picture/theme.h"
#include "sinew/session/view.h"

namespace sinew {

/// What is behind all figures: adds to a picture what the scene's bounds look like.

/// In 3D: a pool of light on each plane that is seen from above, below what the camera looks at.
void draw_floors(const Scene& scene, const View& view, const Theme& theme, Picture& picture);

/// In 2D: what is beyond the walls, and a line along them so many pixels thick.
void draw_walls(const Scene& scene, const View& view, const Theme& theme, float thickness, Picture& picture);

} // namespace sinew
