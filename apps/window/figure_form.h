#pragma once

#include "apps/window/look.h"
#include "player/play.h"

namespace sinew::window {

/// Names of the chosen figures, or of the selected particle's figure.
std::vector<std::string> chosen_figures(const play::Play& play);

/// Colour, contact and friction of the chosen figures, and buttons that copy and delete them.
void figure_form(play::Play& play, const Look& look, float scale);

/// The kind of the next joint.
void joint_form(play::Play& play, const Look& look);

} // namespace sinew::window
