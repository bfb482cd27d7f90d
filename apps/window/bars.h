#pragma once

#include "apps/window/arrangement.h"
#include "apps/window/look.h"
#include "player/play.h"

namespace sinew::window {

/// Tools in a column, or in two columns in a low window.
void tool_bar(play::Play& play, const Arrangement& layout, const Look& look, float scale);
/// Restart, step back, pause, step; the timeline of the last minute; the speed.
void time_bar(play::Play& play, const Arrangement& layout, const Look& look, const Fonts& fonts, float scale);
/// Choices: physical, classic or both; light or dark.
void mode_switch(play::Play& play, const Look& look, float scale);
void overlay_chips(play::Play& play, const Look& look);

} // namespace sinew::window
