#pragma once

#include "player/scene_library.h"

#include <span>
#include <string>

namespace sinew::cli {

/// True for the path of a level: a shared object (.so), or C or C++ (.c, .cpp, .cc, .cxx) to be compiled to one.
bool is_level(const std::string& word);

/// Loads a level (bindings/c/sinew_level.h) and opens its scene. Source is compiled first, by CC or CXX of the
/// environment, else cc or c++. The path that is watched is that of the level. Throws CommandError.
play::Fetched open_level(const std::string& word, std::span<const Override> overrides);

} // namespace sinew::cli
