#pragma once

#include <string>
#include <string_view>

namespace sinew::cli {

/// How a scene file speaks of a prefab's figure: the place of `at`, names of particles and constraints, parts for
/// "looks". All of it is read from built figures, so it is never out of date. Empty for what is no prefab.
std::string prefab_names(std::string_view prefab);

} // namespace sinew::cli
