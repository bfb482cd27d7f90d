#pragma once

#include <string>
#include <string_view>

namespace sinew::cli {

/// Names in a scene file of a prefab's figure: the point placed at `at`, particles and constraints, parts for "looks".
/// The text is derived from built figures, so never out of date. Empty if `prefab` is not a prefab.
std::string prefab_names(std::string_view prefab);

} // namespace sinew::cli
