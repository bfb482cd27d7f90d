#pragma once

#include "apps/window/look.h"

#include <string>
#include <vector>

namespace sinew::window {

/// The longest beginning of the text that fits `width` pixels, followed by an ellipsis if shortened.
std::string elided(const std::string& text, float width);

void tooltip(const std::string& text);

/// Name of a value, with `help` as tooltip, in the left `share` of the width; the value follows in the rest.
void label(const std::string& name, const std::string& help, const ImVec4& color, float share = 0.42F);

/// A label and a value with its unit.
void row(const std::string& name, const std::string& help, const std::string& value, const Look& look);

/// ImGui format of a number with its unit: "%.4g m".
std::string number_format(const char* number, const std::string& unit);

/// A word to choose, with a tooltip.
struct Choice {
    const char* word;
    const char* help = "";
};

/// A row of words in one frame, with the word number `chosen` marked. Returns the number of the word pressed, or -1.
int choice(const char* id, const std::vector<Choice>& words, int chosen, const Look& look, float width);

/// A square button with an icon, filled if `on`.
bool icon_button(std::string_view icon, float side, bool on, const Look& look, const std::string& tip);

} // namespace sinew::window
