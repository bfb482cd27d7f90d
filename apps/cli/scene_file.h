#pragma once

#include "sinew/scene/scene.h"

#include <span>
#include <string>

namespace sinew::cli {

struct NamedScene {
    std::string name; ///< as it was asked for: "ragdoll", "scenes/mine.json", "-"
    Scene scene;
};

/// Finds, reads and checks a scene: the path of a file, the name of one of the catalogue, or - for standard input.
/// Throws GiveUp with all that is wrong with it.
NamedScene open_scene(const std::string& word, std::span<const Override> overrides = {});

/// The file as it is, unchecked; what is wrong with it is in its diagnostics.
Document open_document(const std::string& word, std::span<const Override> overrides = {});

/// What files made of the scene are called: "ragdoll", "mine", "scene".
std::string title_of(const std::string& word);

} // namespace sinew::cli
