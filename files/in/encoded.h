#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sinew::files {

/// Bytes of a text in base64 (RFC 4648); empty where it is none. Blanks between are passed over.
std::optional<std::string> from_base64(std::string_view text);

} // namespace sinew::files
