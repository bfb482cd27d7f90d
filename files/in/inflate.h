#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sinew::files {

/// Bytes of a compressed stream, as far as they could be read.
struct Inflated {
    std::string bytes{};
    std::string problem{}; ///< empty for a whole stream
    std::size_t at = 0;    ///< byte of the stream behind the last one that was read
};

/// Reads a stream of zlib (RFC 1950) or gzip (RFC 1952), whose blocks are those of RFC 1951, and compares its checksum.
/// More than `max` bytes are a problem.
Inflated inflate(std::string_view stream, std::size_t max);

} // namespace sinew::files
