#pragma once

#include "apps/play/play.h"
#include "apps/window/layout.h"
#include "apps/window/look.h"

namespace sinew::window {

/// The tools, one below the other, in two columns where the window is low.
void tool_bar(play::Play& play, const Layout& layout, const Look& look, float scale);
/// Back, pause, on; the last minute to go back in; how fast time passes.
void time_bar(play::Play& play, const Layout& layout, const Look& look, const Fonts& fonts, float scale);
/// Physical, classic or both, light or dark.
void mode_switch(play::Play& play, const Look& look, float scale);
void overlay_chips(play::Play& play, const Look& look);

} // namespace sinew::window
