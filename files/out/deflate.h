#pragma once

#include <string>
#include <string_view>

namespace sinew::files {

/// Bytes as a stream of zlib (RFC 1950), compressed with the fixed codes of RFC 1951.
std::string deflated(std::string_view data);

} // namespace sinew::files
