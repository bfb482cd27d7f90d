#pragma once

#include "files/in/simplify.h"

#include <string_view>

namespace sinew::files {

/// True if an outline crosses itself or another one.
bool have_crossings(const std::vector<Outline>& outlines);

/// Borders of the area that outlines enclose by a fill rule of SVG: none crosses another, the area is on their left in
/// a y-up frame, and each begins in the middle of an edge, which no other touches. Outlines are cut where they cross or
/// touch, and a piece is a border where it is filled on one side only (winding numbers on both sides). Corners lie on a
/// grid of 1/1024 pixel, on which turns are exact up to 65 536 pixels. Nothing where there are too many pieces.
std::vector<Outline> uncrossed(const std::vector<Outline>& outlines, std::string_view fill_rule);

} // namespace sinew::files
