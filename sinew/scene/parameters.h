#pragma once

#include "sinew/scene/layout.h"
#include "sinew/scene/scene.h"

#include <string>
#include <string_view>

/// Values of a scene that a form can show: numbers, words, switches and points, as declared by the records.
namespace sinew {

/// True if a field of the scene ("solver.rules", "figures.0.direct") has an effect in the mode; forms hide others.
bool acts_in(std::string_view mode, const std::string& path);

/// Unit of a field in the scene's units, in words: "px/frame^2", "a substep"; may be empty.
std::string unit_text(const Layout& field, const std::string& path, const Units& units, std::string_view mode);

/// Values of a scene: an array of {path, name, value, type, unit, low, high, choices, help}. Paths are those of
/// overrides; low, high and choices are absent where there are none. Figures beyond the first `max_figures` are left
/// out, and so are optional values that the scene does not state.
json::Array parameters_of(const Scene& scene, std::size_t max_figures = 12);

/// Parameters of a prefab with their defaults in metres, kilograms and seconds; paths are names.
json::Array parameters_of(const Layout& prefab);

/// Layout of a section of a scene, which must exist: "world", "solver".
const Layout& section_layout(std::string_view name);

/// Layout of one figure of a scene; the prefabs are the alternatives of the choice in it.
const Layout& figure_layout();

} // namespace sinew
