#pragma once

#include "files/in/drawing.h"
#include "files/in/xml.h"

namespace sinew::files {

/// Lines of a basic shape or a path of SVG (SVG 2, chapters 9 and 10), in its own coordinates. `tag`: the name without
/// its prefix. `page`: the size that percentages are of. Empty for other elements; throws ImportError, without a place,
/// where an attribute cannot be read.
std::optional<std::vector<DrawnLine>> svg_lines(const XmlElement& element, std::string_view tag,
                                                const Vec2<double>& page);

/// True for elements that draw nothing by themselves.
bool is_silent_svg(std::string_view tag);

/// Value of an attribute that is a length, in pixels; throws ImportError, without a place.
double svg_length(const XmlElement& element, std::string_view name, double whole, double usual = 0);

} // namespace sinew::files
