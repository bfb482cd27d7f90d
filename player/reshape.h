#pragma once

#include "sinew/scene/scene.h"

#include <optional>
#include <span>
#include <string>

/// Figures and obstacles of a scene moved, turned, made larger and copied: edits of the description, which the running
/// world follows (sinew/session/migrate_state.h).
namespace sinew::play {

/// Change of a part of a scene, about a middle: scale, turn (radians, about z by the axes of the scene), shift.
struct Reshape {
    Point shift{};
    double turn = 0, scale = 1;
};

/// A figure or an obstacle, by name; obstacles without a name are called #0, #1, ... in their order.
struct Part {
    std::string name;
    bool is_obstacle = false;
    friend bool operator==(const Part&, const Part&) = default;
};

/// Name of an obstacle of a scene.
std::string obstacle_name(const Scene& scene, std::size_t number);
/// Number of an obstacle; nothing if none is called so.
std::optional<std::size_t> obstacle_called(const Scene& scene, const std::string& name);

/// The scene with parts reshaped together about the middle of all of them in `world`, the present state. A turn and a
/// scale act on each part about its own middle, which goes round the common one. The description is changed where it
/// begins, by as much.
std::optional<Scene> reshaped(const Scene& scene, const AnyWorld& world, std::span<const Part> parts, const Reshape& by,
                              std::string& problem);

/// The scene with copies of the parts, shifted by so much; the names of the copies are added to `made`. Pins and
/// joints of the copies are copied with them.
std::optional<Scene> duplicated(const Scene& scene, const AnyWorld& world, std::span<const Part> parts,
                                const Point& shift, std::vector<Part>& made, std::string& problem);

/// Present middle of a part; nothing where the scene has no such part.
std::optional<Point> middle_of(const Scene& scene, const AnyWorld& world, const Part& part);

} // namespace sinew::play
