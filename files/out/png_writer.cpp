#include "files/out/png_writer.h"

#include "files/checksum.h"
#include "files/out/bytes.h"
#include "files/out/deflate.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

namespace sinew::files {
namespace {

void put_chunk(std::string& file, std::string_view type, std::string_view data) {
    put_big(file, std::uint32_t(data.size()));
    const auto begin = file.size();
    file.append(type).append(data);
    put_big(file, crc32(std::string_view(file).substr(begin)));
}

/// A channel without its opacity.
char straight(std::uint32_t channel, std::uint32_t alpha) {
    return char(alpha == 0 ? 0 : std::min((channel * 255 + alpha / 2) / alpha, std::uint32_t(255)));
}

/// Bytes of red, green, blue and opacity, row by row.
std::string bytes_of(const Image& image) {
    std::string bytes;
    bytes.reserve(image.pixels.size() * 4);
    for (const auto pixel : image.pixels) {
        for (const auto shift : {16U, 8U, 0U}) bytes += straight(pixel >> shift & 255U, pixel >> 24U);
        bytes += char(pixel >> 24U);
    }
    return bytes;
}

/// Rows as differences from the pixel to the left (filter 1), or above (2): whichever are smaller.
std::string filtered_rows(const Image& image) {
    const auto bytes = bytes_of(image);
    const auto width = 4 * std::size_t(image.width);
    std::string rows;
    rows.reserve(bytes.size() + std::size_t(image.height));
    for (std::size_t begin = 0; begin < bytes.size(); begin += width) {
        std::array<std::string, 2> choices;
        std::array<int, 2> sizes{};
        for (std::size_t k = 0; k < 2; ++k)
            for (std::size_t i = 0; i < width; ++i) {
                const bool has_neighbor = k == 0 ? i >= 4 : begin > 0;
                const char neighbor = has_neighbor ? bytes[begin + i - (k == 0 ? 4 : width)] : '\0';
                choices[k] += char(bytes[begin + i] - neighbor);
                sizes[k] += std::abs(static_cast<signed char>(choices[k].back()));
            }
        const std::size_t best = sizes[1] < sizes[0] ? 1 : 0;
        rows += char(best + 1);
        rows += choices[best];
    }
    return rows;
}

} // namespace

std::string png_of(const Image& image) {
    std::string file("\x89PNG\r\n\x1a\n"), header;
    put_big(header, std::uint32_t(image.width));
    put_big(header, std::uint32_t(image.height));
    constexpr std::string_view eight_bits_with_alpha("\x08\x06\0\0\0", 5);
    header += eight_bits_with_alpha;
    put_chunk(file, "IHDR", header);
    put_chunk(file, "IDAT", deflated(filtered_rows(image)));
    put_chunk(file, "IEND", {});
    return file;
}

} // namespace sinew::files
