#pragma once

#include "player/play.h"

#include <optional>
#include <string>

namespace sinew::window {

/// True if the environment names a display.
bool has_display();

/// Shows the game until the player quits; returns the reason of failure, or nothing.
std::optional<std::string> show(play::Play& play);

} // namespace sinew::window
