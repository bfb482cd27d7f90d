#pragma once

#include "sinew/math/color.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace sinew {

/// Default colours, for everything without a look.
struct Theme {
    /// Colour of every part with this name, in any figure: skin, denim, steel.
    struct Material {
        std::string_view part;
        Color color;
    };

    Color background;
    Color ground;            ///< beyond walls; the floor in 3D
    Color wall;              ///< line along the walls
    Color shadow;            ///< on the background
    Color floor_shadow;      ///< on the ground
    Color ink;               ///< darkest colour; outlines are mixed towards ink
    Color pen;               ///< lines and letters that stand out from the background
    float outline_shade = 0; ///< share of ink in an outline, 0 to 1
    std::array<Color, 6> palette;
    std::array<Material, 9> materials;

    const Color& color_of(std::size_t figure) const { return palette[figure % palette.size()]; }
    /// Null for parts coloured like the figure.
    const Color* material_of(std::string_view part) const {
        for (const auto& material : materials)
            if (material.part == part) return &material.color;
        return nullptr;
    }
};

/// Colour named in a look: one of theme_colors, or any colour parse_color knows.
std::optional<Color> color_in(const Theme& theme, std::string_view text);

/// Theme by name: "dark", or else the light one.
const Theme& theme_called(std::string_view name);

} // namespace sinew
