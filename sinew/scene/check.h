#pragma once

#include "sinew/scene/scene.h"

/// What a scene must keep beyond the types and ranges of single values.
namespace sinew {

/// Before anything is built: names used once, sizes within the limits, prefabs that exist in the scene's dimension,
/// constraints that make sense.
void check_values(const Scene& scene, Document& document);

/// Once it is built: every particle, constraint, figure and part that is spoken of exists.
void check_references(const Scene& scene, const AnyWorld& world, Document& document);

/// A place in a document: "/figures/2/looks".
std::string under(std::string_view list, std::size_t index, std::string_view key = {});

/// What the scene calls a figure: its name, else its prefab's.
std::string_view name_of(const FigureSection& figure);

/// A particle's name as figure/name; where it has no figure, of the one that `prefix`, "figure/", says.
std::string full_name(std::string_view name, std::string_view prefix);

} // namespace sinew
