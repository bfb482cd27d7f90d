#pragma once

#include "files/in/affine.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Values of SVG's attributes. Values that cannot be read are empty.
namespace sinew::files::svg_value {

/// Numbers with commas or blanks between: "1,2 3-4".
std::optional<std::vector<double>> numbers(std::string_view text);
/// A length in pixels; percentages are of `whole`.
std::optional<double> length(std::string_view text, double whole);
/// A list of transforms.
std::optional<Affine> transform(std::string_view text);
/// A colour of SVG as one of a scene: a name, #rrggbb or #rrggbbaa.
std::optional<std::string> color(std::string_view text, double opacity);
std::string_view trimmed(std::string_view text);

} // namespace sinew::files::svg_value
