#pragma once

#include "sinew/scene/json.h"

#include "player/reshape.h"

#include <string_view>
#include <utility>
#include <vector>

/// Names in a scene's document: who is meant by them, and other ones.
namespace sinew::play {

/// True if a name belongs to the figure or to a part of the figure.
bool belongs(std::string_view name, std::string_view figure);

/// True if a text anywhere in the value, or a key of it, belongs to the figure or obstacle.
bool mentions(const json::Value& value, std::string_view name);

/// Replaces names, and those of parts, in every text of the value.
void rename(json::Value& value, const std::vector<std::pair<std::string, std::string>>& names);

/// A name without the number that tells copies apart: box of box_2.
std::string unnumbered(const std::string& name);

/// A name unused by obstacles and figures: wall, wall_2.
std::string free_obstacle(const Scene& scene, const std::string& like);

/// The parts, and the figures without particles of their own, such as joints, that join no others.
std::vector<Part> with_joints(const Scene& scene, std::span<const Part> parts);

/// The scene without parts and whatever refers to them; joints that lose an end go too. The figures that are left keep
/// their colours.
std::optional<Scene> without(const Scene& scene, const AnyWorld& world, std::span<const Part> parts,
                             std::string& problem);

} // namespace sinew::play
