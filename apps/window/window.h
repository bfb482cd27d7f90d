#pragma once

#include "apps/play/play.h"

#include <optional>
#include <string>

namespace sinew::window {

/// Whether there is a display that a window could be opened on.
bool has_display();

/// Shows the game until the player quits; what went wrong, or nothing.
std::optional<std::string> show(play::Play& play);

} // namespace sinew::window
