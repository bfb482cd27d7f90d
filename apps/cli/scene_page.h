#pragma once

#include <string>
#include <vector>

/// What can be told of a scene of the catalogue without playing it.
namespace sinew::cli {

/// A value that a scene file states.
struct Parameter {
    std::string path;  ///< as it is overridden: "figures.rope.length"
    std::string value; ///< as the file has it
    std::string unit;  ///< "px/frame^2", or empty
    std::string help;  ///< one line
};

struct ScenePage {
    std::string name, about, source;
    std::string made_of; ///< "2 ropes, a box"
    std::string text;    ///< the file
    double seconds = 0;  ///< that it is worth watching
    std::vector<Parameter>
        parameters; ///< of its world, its solver, the first figure of each prefab and pin of each driver
};

/// Throws GiveUp where the scene is broken.
ScenePage page_of(const std::string& name);

} // namespace sinew::cli
