#pragma once

#include "sinew/math/color.h"

#include <imgui.h>
#include <string>

namespace sinew::window {

/// Colours of the panel, beside those of the theme.
struct Look {
    ImVec4 surface, raised, line, text, faint, accent, on_accent, good, cool;
};
const Look& look_called(const std::string& theme);

/// Letters of the panel. All may be the same where a machine has no others.
struct Fonts {
    ImFont *normal = nullptr, *large = nullptr, *small = nullptr, *fixed = nullptr;
};

/// Makes the panel look so, `density` times as large as usual. Fonts are made anew where the density is another.
void dress(const Look& look, double density, double& dressed_density, Fonts& fonts);

inline ImVec4 to_gui(const Color& color) {
    return {color.red, color.green, color.blue, color.alpha};
}
inline ImU32 packed(const ImVec4& color, float alpha = 1) {
    return ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, color.w * alpha});
}

} // namespace sinew::window
