#pragma once

#include <string>
#include <vector>

/// Description of a catalogue scene, without running the scene.
namespace sinew::cli {

/// A value stated in a scene file.
struct Parameter {
    std::string path;  ///< path in an override: "figures.rope.length"
    std::string value; ///< text in the file
    std::string unit;  ///< "px/frame^2", or empty
    std::string help;  ///< a line of help
};

struct ScenePage {
    std::string name, about, source;
    std::string made_of;               ///< "2 ropes, a box"
    std::string text;                  ///< contents of the file
    double seconds = 0;                ///< length worth watching
    std::vector<Parameter> parameters; ///< world, solver, first figure of each prefab, first pin of each driver
};

/// Throws CommandError if the scene is broken.
ScenePage page_of(const std::string& name);

} // namespace sinew::cli
