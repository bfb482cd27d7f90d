#pragma once

#include "files/in/simplify.h"

#include <optional>
#include <string_view>

namespace sinew::files {

/// An area: its outline, then its holes.
using Area = std::vector<Outline>;

/// True if an outline crosses itself or another one.
bool have_crossings(const std::vector<Outline>& outlines);

/// Areas that outlines enclose by a fill rule of SVG, none of whose borders cross. Outlines are cut where they cross or
/// touch, and a piece is a border where it is filled on one side only (winding numbers on both sides). Corners lie on a
/// grid of 1/1024 pixel. Nothing where there are too many pieces.
std::optional<std::vector<Area>> uncrossed(const std::vector<Outline>& outlines, std::string_view fill_rule);

} // namespace sinew::files
