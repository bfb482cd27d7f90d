#pragma once

#include <string>

namespace sinew::files {

/// A .glb of a glTF document and its only buffer, whose length is a multiple of four.
std::string glb_bytes(std::string text, const std::string& binary);

} // namespace sinew::files
