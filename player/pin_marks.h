#pragma once

#include "sinew/picture/picture.h"
#include "sinew/picture/theme.h"
#include "sinew/scene/scene.h"
#include "sinew/session/view.h"

namespace sinew::play {

/// Adds a small mark at every pinned particle, for pictures without the overlay of pins.
void draw_pin_marks(const AnyWorld& world, const View& view, const Theme& theme, Picture& picture);

} // namespace sinew::play
