#pragma once

#include "sinew/math/color.h"

#include <imgui.h>
#include <string>

namespace sinew::window {

/// Colours of the panel; scenes have themes of their own.
struct Look {
    ImVec4 surface, raised, line, text, faint, accent, on_accent, good, cool;
};
const Look& look_called(const std::string& theme);

/// Fonts of the panel; all the same on a machine without the preferred ones.
struct Fonts {
    ImFont *normal = nullptr, *large = nullptr, *small = nullptr, *fixed = nullptr;
};

/// Sets ImGui's style, scaled by `density`; makes the fonts again if the density has changed.
void dress(const Look& look, double density, double& dressed_density, Fonts& fonts);

inline ImVec4 to_gui(const Color& color) {
    return {color.red, color.green, color.blue, color.alpha};
}
inline ImU32 packed(const ImVec4& color, float alpha = 1) {
    return ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, color.w * alpha});
}

} // namespace sinew::window
