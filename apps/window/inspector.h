#pragma once

#include "apps/play/play.h"
#include "apps/window/look.h"

namespace sinew::window {

/// The particle that is selected, or else hovered, what holds it, and its figure.
void inspector(play::Play& play, const Look& look, const Fonts& fonts);

} // namespace sinew::window
