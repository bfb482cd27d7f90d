#pragma once

#include "apps/play/play.h"
#include "apps/window/look.h"

namespace sinew::window {

/// The bar at the top: File, Edit, View, Help. Where the panel is a drawer, `drawer` is opened and closed from it.
void menu_bar(play::Play& play, bool docked, bool& drawer);

} // namespace sinew::window
