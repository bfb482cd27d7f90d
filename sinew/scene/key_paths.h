#pragma once

#include "sinew/scene/layout.h"

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Full paths, as overrides write them, at which a record allows `key`: "world.gravity", "figures.rope.segments".
/// Elements of lists are those of the document. Where no field is called so, the field nearest in spelling is meant.
std::vector<std::string> key_paths(const Layout& record, const json::Value& document, std::string_view key);

} // namespace sinew
