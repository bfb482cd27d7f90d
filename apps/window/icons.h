#pragma once

#include <imgui.h>
#include <string_view>

namespace sinew::window {

/// Draws an icon about a place, so many pixels from its middle to its edge. An unknown name is a dot.
void draw_icon(ImDrawList& list, std::string_view name, ImVec2 middle, float size, ImU32 color);

} // namespace sinew::window
