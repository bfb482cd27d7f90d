#pragma once

#include <algorithm>

namespace sinew::window {

/// A rectangle of the window, pixels.
struct Area {
    int left = 0, top = 0, width = 1, height = 1;

    bool contains(double x, double y) const { return x >= left && y >= top && x < left + width && y < top + height; }
};

/// Layout of a window of any size. Bars shrink in small windows; in narrow ones the panel becomes a drawer over the
/// scene, and a window too small for bars shows the scene alone.
struct Arrangement {
    static constexpr int tool_buttons = 15; ///< all tools, undo, redo

    Area scene, menu, tools, time, side;
    bool bars = false;
    bool docked = false;  ///< the panel is beside the scene, not over it
    float tool_side = 40; ///< side of a tool's button, pixels
    int tool_columns = 1;
    float time_side = 38; ///< side of a button in the time bar, pixels

    /// `scale`: pixels per nominal pixel.
    static Arrangement of(int width, int height, float scale, bool panel, bool drawer) {
        Arrangement layout;
        layout.scene = {0, 0, std::max(width, 1), std::max(height, 1)};
        const float wide = float(width) / scale, high = float(height) / scale; // nominal pixels
        constexpr float min_width = 330, min_height = 190, dock_width = 860, side_width = 340;
        if (!panel || wide < min_width || high < min_height) return layout;
        layout.bars = true;
        layout.docked = wide >= dock_width;
        const auto pixels = [&](float nominal) { return int(nominal * scale); };
        const int menu = pixels(28), time = pixels(high < 520 ? 46 : 64);
        layout.time_side = (high < 520 ? 32 : 38) * scale;
        layout.choose_tools(float(height - menu - time), scale);
        const int tools = int((layout.tool_side + 4 * scale) * float(layout.tool_columns) + 12 * scale);
        const int side = std::min(pixels(side_width), width - tools - pixels(40));
        const int right = layout.docked ? side : 0;
        layout.menu = {0, 0, width, menu};
        layout.tools = {0, menu, tools, height - menu - time};
        layout.time = {0, height - time, width - right, time};
        layout.scene = {tools, menu, width - tools - right, height - menu - time};
        if (layout.docked)
            layout.side = {width - side, menu, side, height - menu};
        else if (drawer)
            layout.side = {width - side, menu, side, height - menu - time};
        else
            layout.side = {width, 0, 0, 0};
        return layout;
    }

  private:
    /// Chooses one column of buttons, as large as the height allows, or two or three where they would be too small.
    void choose_tools(float room, float scale) {
        constexpr float largest = 40, smallest = 22, gap = 4, margins = 26; // nominal pixels
        const auto fitting = [&](int rows) { return (room / scale - margins) / float(rows) - gap; };
        int rows = tool_buttons;
        for (tool_columns = 1; tool_columns < 3 && fitting(rows) < smallest;) {
            ++tool_columns;
            rows = (tool_buttons + tool_columns - 1) / tool_columns;
        }
        tool_side = std::clamp(fitting(rows), 14.0F, largest) * scale;
    }
};

} // namespace sinew::window
