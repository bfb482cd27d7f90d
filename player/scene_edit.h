#pragma once

#include "sinew/scene/scene.h"
#include "sinew/session/session.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

/// Edits of a running scene through its document: every change is read again and checked like a file.
namespace sinew::play {

/// A changed scene, or the reason why the change is invalid.
struct Edited {
    std::optional<Scene> scene;
    std::string problem;
    Diagnostics diagnostics{};
};

/// Text of a scene file, without values equal to their defaults. Cut constraints of the scene's figures are listed by
/// name in an event at the start; figures that calls and events have added are left out.
std::string text_of(const Session& session);
/// Number of figures that text_of() leaves out.
std::size_t figures_beside_scene(const Session& session);

/// Applies a change to the JSON object of the scene.
Edited edited(const Scene& scene, const std::function<void(json::Object& root)>& change);
/// Sets values by path: figures.bob.height=200
Edited edited(const Scene& scene, std::span<const Override> overrides);

/// A name unused by figures: box, box_2, box_3.
std::string free_name(const Scene& scene, const std::string& stem);

/// Appends an element to a list of the object; a missing list is created.
void append(json::Object& root, std::string_view list, json::Value element);

} // namespace sinew::play
