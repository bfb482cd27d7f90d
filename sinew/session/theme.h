#pragma once

#include "sinew/math/color.h"

#include <array>
#include <cstddef>
#include <string_view>

namespace sinew {

/// Colours of what has no looks of its own.
struct Theme {
    Color background, wall, ink;
    float outline_shade = 0; ///< how far outlines are drawn from a line's colour towards ink
    std::array<Color, 6> palette;

    const Color& color_of(std::size_t figure) const { return palette[figure % palette.size()]; }
};

/// "light" or "dark".
const Theme& theme_called(std::string_view name);

} // namespace sinew
