#pragma once

#include "sinew/scene/layout.h"

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Full paths, in the notation of overrides, at which a record allows `key`: "world.gravity", "figures.rope.segments".
/// List elements are those of the document. If no field has that name, the field renamed from it is used, or the one
/// nearest in spelling.
std::vector<std::string> key_paths(const Layout& record, const json::Value& document, std::string_view key);
/// The same for fields of exactly that name.
std::vector<std::string> exact_key_paths(const Layout& record, const json::Value& document, std::string_view key);
/// The same for a key, or the word of the format for it, in the records around the one at a JSON pointer, the innermost
/// first and without the whole document: "figures.rope.contact.bounce" for the "restitution" of a particle.
std::vector<std::string> key_paths_around(const Layout& record, const json::Value& document, std::string_view place,
                                          std::string_view key);

} // namespace sinew
