#pragma once

#include "apps/window/look.h"
#include "player/play.h"

namespace sinew::window {

/// State and constraints of the selected particle, or else of the hovered one.
void inspector(play::Play& play, const Look& look, const Fonts& fonts);

} // namespace sinew::window
