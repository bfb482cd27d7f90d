#pragma once

#include "sinew/math/vec.h"

#include <string>
#include <variant>

/// What a player does, whether with a mouse in a window or by a script. Places are pixels of the picture.
namespace sinew::play {

enum class Button { left, middle, right };

struct Moved {
    Vec2<double> to;
};
struct Pressed {
    Button button = Button::left;
};
struct Released {
    Button button = Button::left;
};
struct Scrolled {
    double notches = 0;
}; ///< positive: away from the player, larger
struct Pinched {
    Vec2<double> by;
    double factor = 1;
}; ///< two fingers: moved and spread
/// "p", "[", "escape", "tab", "f1", "ctrl+z"; lower case.
struct Key {
    std::string name;
};
struct KeyUp {
    std::string name;
};
struct Left {}; ///< the pointer is no longer over the picture

using Input = std::variant<Moved, Pressed, Released, Scrolled, Pinched, Key, KeyUp, Left>;

} // namespace sinew::play
