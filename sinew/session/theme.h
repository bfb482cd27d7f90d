#pragma once

#include "sinew/math/color.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace sinew {

/// Colours of what has no looks of its own.
struct Theme {
    /// What parts of that name are made of, in any figure: skin, denim, steel.
    struct Material {
        std::string_view part;
        Color color;
    };

    Color background;
    Color ground;            ///< beyond walls; the floor in 3D
    Color wall;              ///< the line along them
    Color shadow;            ///< on the background
    Color floor_shadow;      ///< on the ground
    Color ink;               ///< darkest: what outlines go towards
    Color pen;               ///< of lines and letters that stand out from the background
    float outline_shade = 0; ///< how far outlines are drawn from a line's colour towards ink
    std::array<Color, 6> palette;
    std::array<Material, 9> materials;

    const Color& color_of(std::size_t figure) const { return palette[figure % palette.size()]; }
    /// Null for parts that are as colourful as their figure.
    const Color* material_of(std::string_view part) const {
        for (const auto& material : materials)
            if (material.part == part) return &material.color;
        return nullptr;
    }
};

/// A colour as a look says it: one of theme_colors, or any that parse_color knows.
std::optional<Color> color_in(const Theme& theme, std::string_view text);

/// "light" or "dark".
const Theme& theme_called(std::string_view name);

} // namespace sinew
