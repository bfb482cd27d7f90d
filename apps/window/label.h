#pragma once

#include "apps/window/look.h"

#include <string>

namespace sinew::window {

/// As much of the text as fits, with dots where some is missing.
std::string elided(const std::string& text, float width);

void tooltip(const std::string& text);

/// The name of a value with what it means as its tooltip; the value comes next, in a column of its own.
void label(const std::string& name, const std::string& help, const ImVec4& color, float share = 0.42F);

/// A label and a value with its unit.
void row(const std::string& name, const std::string& help, const std::string& value, const Look& look);

/// A format for ImGui: a number with its unit.
std::string number_format(const char* number, const std::string& unit);

/// Some words of which one is chosen, in one frame. The number of the one that is pressed, or -1.
int choice(const char* id, std::initializer_list<const char*> words, int chosen, const Look& look, float width);

/// A square with an icon; `on` fills it.
bool icon_button(std::string_view icon, float side, bool on, const Look& look, const std::string& tip);

} // namespace sinew::window
