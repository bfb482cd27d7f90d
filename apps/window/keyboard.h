#pragma once

#include <SDL.h>
#include <algorithm>
#include <cctype>
#include <string>

namespace sinew::window {

/// Name of a key for play::Key: "p", "[", "ctrl+z", "ctrl+shift+s", "delete".
inline std::string name_of_key(const SDL_Keysym& key) {
    std::string name = SDL_GetKeyName(key.sym);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if ((key.mod & KMOD_CTRL) == 0) return name;
    return ((key.mod & KMOD_SHIFT) != 0 ? "ctrl+shift+" : "ctrl+") + name;
}

} // namespace sinew::window
