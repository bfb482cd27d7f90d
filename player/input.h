#pragma once

#include "sinew/math/scalar.h"
#include "sinew/math/vec.h"

#include <string>
#include <variant>

/// Input of a player, from the mouse of a window or from a script. Positions are pixels of the picture.
namespace sinew::play {

enum class Button { left, middle, right };

/// Distance from the picture's corner up to which positions are told apart, pixels.
constexpr double max_pixel = 1e6;

/// The nearest position within that distance.
inline Vec2<double> within_reach(Vec2<double> pixel) {
    for (int i = 0; i < 2; ++i) pixel[i] = clamp(pixel[i], -max_pixel, max_pixel);
    return pixel;
}

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
}; ///< positive: away from the player, enlarges
struct Pinched {
    Vec2<double> by;
    double factor = 1;
}; ///< gesture of two fingers: displacement of their middle, ratio of their distances
/// Lower case: "p", "[", "escape", "tab", "f1", "ctrl+z".
struct Key {
    std::string name;
};
struct KeyUp {
    std::string name;
};
struct Left {}; ///< the pointer has left the picture

using Input = std::variant<Moved, Pressed, Released, Scrolled, Pinched, Key, KeyUp, Left>;

} // namespace sinew::play
