#pragma once

#include "apps/play/play.h"
#include "apps/window/look.h"

namespace sinew::window {

/// The scene's numbers and words, as its records declare them; a change is applied at once.
void sliders(play::Play& play, const Look& look, const Fonts& fonts);

/// Which prefab the spawn tool makes, and with which parameters.
void prefab_form(play::Play& play, const Look& look);

} // namespace sinew::window
