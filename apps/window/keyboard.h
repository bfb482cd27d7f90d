#pragma once

#include <SDL.h>
#include <algorithm>
#include <cctype>
#include <string>

namespace sinew::window {

/// What the game calls a key: "p", "[", "ctrl+z", "delete".
inline std::string name_of_key(const SDL_Keysym& key) {
    std::string name = SDL_GetKeyName(key.sym);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return (key.mod & KMOD_CTRL) != 0 ? "ctrl+" + name : name;
}

} // namespace sinew::window
