#pragma once

#include "apps/play/play.h"
#include "apps/window/look.h"

#include <string>
#include <string_view>

namespace sinew::window {

/// The scene's numbers and words, as its records declare them; a change is applied at once.
void sliders(play::Play& play, const Look& look, const Fonts& fonts);

/// Whether a part of a scene ("solver.rules", "figures.0.direct") changes anything in a mode; others are not shown.
bool acts_in(std::string_view mode, const std::string& path);

/// Which prefab the spawn tool makes, and with which parameters.
void prefab_form(play::Play& play, const Look& look);

} // namespace sinew::window
