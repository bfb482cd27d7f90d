#pragma once

#include "apps/play/play.h"

#include <span>
#include <string_view>

namespace sinew::play {

struct KeyAction {
    std::string_view key, about;
    void (*act)(Play&);
};

/// What keys do, beside choosing tools, in the order of the help. A new one is a line in keys.cpp.
std::span<const KeyAction> key_actions();

void press_key(Play& play, std::string_view key);

} // namespace sinew::play
