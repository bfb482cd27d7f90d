#pragma once

#include <imgui.h>
#include <string_view>

namespace sinew::window {

/// Draws the icon around `middle`, `size` pixels from there to the edge; a dot for an unknown name.
void draw_icon(ImDrawList& list, std::string_view name, ImVec2 middle, float size, ImU32 color);

} // namespace sinew::window
