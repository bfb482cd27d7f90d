#pragma once

#include "sinew/picture/theme.h"
#include "sinew/scene/scene.h"

#include <string>

namespace sinew {

struct ColliderColors {
    Color fill, line;
    bool hidden = false;
};

/// Colours of a collider: the theme's, or those of the scene's look with its name, as for figures.
inline ColliderColors colors_of(const std::string& name, const Scene& scene, const Theme& theme) {
    constexpr float tint = 0.6F;
    ColliderColors colors{theme.ground, theme.wall};
    for (const auto& [key, look] : scene.looks) {
        if (key != name || name.empty()) continue;
        if (const auto color = color_in(theme, look.color))
            colors.line = *color, colors.fill = mix(*color, theme.background, tint);
        if (const auto fill = color_in(theme, look.fill)) colors.fill = *fill;
        colors.hidden = look.hidden.value_or(colors.hidden);
    }
    return colors;
}

} // namespace sinew
