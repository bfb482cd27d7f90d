#pragma once

#include "sinew/scene/scene.h"
#include "sinew/session/session.h"

#include <functional>
#include <optional>
#include <span>
#include <string>

/// A running scene as a document that can be changed and read again, so that every change is checked as a file is.
namespace sinew::play {

/// A changed scene, or what is wrong with it.
struct Edited {
    std::optional<Scene> scene;
    std::string problem;
};

/// The text of a file: what has its default is left out. What was cut is said in an event at the start, by name.
std::string text_of(const Session& session);

/// Changes the scene's object.
Edited edited(const Scene& scene, const std::function<void(json::Object& root)>& change);
/// Sets values by path: figures.bob.height=200
Edited edited(const Scene& scene, std::span<const Override> overrides);

/// A name that no figure has: box, box_2, box_3.
std::string free_name(const Scene& scene, const std::string& stem);

/// Adds an element to a list of the object, which is made where it is missing.
void append(json::Object& root, std::string_view list, json::Value element);

} // namespace sinew::play
