#pragma once

#include "sinew/scene/scene.h"

#include <functional>

/// Checks of a scene beyond the types and ranges of single values.
namespace sinew {

/// Checks before building: sizes within the limits, prefabs that exist in the scene's dimension, constraints with
/// consistent values. Returns true if a world can be built nevertheless, to look for more errors in.
bool check_values(const Scene& scene, Document& document);

/// True if the name of a figure, by index, is known to be meant so.
using KnowsName = std::function<bool(std::size_t figure)>;

/// Checks names: no two figures or colliders of one name, none beyond the reach of references. `knows`: figures to look
/// at; all without it.
void check_names(const Scene& scene, Document& document, const KnowsName& knows = {});

/// The part of check_values about limits: numbers of figures, events, particles and constraints.
void check_sizes(const Scene& scene, Document& document);

/// Checks after building: every particle, constraint, figure and part referred to exists. Of `incomplete` figures any
/// name may exist; with an empty name in the list, any figure.
void check_references(const Scene& scene, const AnyWorld& world, Document& document,
                      std::span<const std::string> incomplete = {});

/// Warns of values that a valid scene can hardly mean: strains that no link reaches, a mesh in several parts, welded
/// points, figures in each other that cannot touch, events that never happen or do nothing, holds that begin far away,
/// values unknown to classic mode, places too far out for floats.
void warn_of_traps(const Scene& scene, const AnyWorld& world, Document& document);

/// A JSON pointer in a document: "/figures/2/looks".
std::string under(std::string_view list, std::size_t index, std::string_view key = {});

/// Name of a figure in the scene, or of its prefab if the figure has none.
std::string_view name_of(const FigureSection& figure);

/// Full name figure/name of a particle. A name without a figure gets `prefix`, which ends in a slash: "figure/".
std::string full_name(std::string_view name, std::string_view prefix);

} // namespace sinew
