#pragma once

#include "apps/window/look.h"
#include "player/play.h"

namespace sinew::window {

/// The menu bar: File, Edit, View, Help; also opens and closes the panel's drawer if not docked.
void menu_bar(play::Play& play, bool docked, bool& drawer);

} // namespace sinew::window
