#pragma once

#include "apps/window/look.h"
#include "player/play.h"

#include <string>
#include <string_view>

namespace sinew::window {

/// Widgets for the numbers and words of the scene, as declared by its records; changes apply at once.
void sliders(play::Play& play, const Look& look, const Fonts& fonts);

/// Choice of the prefab for the spawn tool, with parameters.
void prefab_form(play::Play& play, const Look& look);

} // namespace sinew::window
