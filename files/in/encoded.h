#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sinew::files {

/// Bytes of a text in base64 (RFC 4648); empty where it is none. Blanks between are passed over.
std::optional<std::string> from_base64(std::string_view text);

/// Bytes that were compressed by zlib or gzip; empty where the data is damaged or has more than `max` bytes.
std::optional<std::string> inflated(std::string_view bytes, std::size_t max);

} // namespace sinew::files
