#include "canvas/png.h"

#include "sinew/scene/text.h"

#include "canvas/cairo_handle.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <span>
#include <sys/stat.h>

namespace sinew::canvas {
namespace {

using Bytes = std::vector<unsigned char>;

ReadImage problem(std::string text, std::string help = {}) {
    return {nullptr, std::move(text), std::move(help)};
}

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Reads the whole file into `bytes`. Returns the reason of a failure, or an empty string.
std::string read_file(const std::filesystem::path& path, std::size_t max, Bytes& bytes) {
    struct stat about {};
    if (stat(path.c_str(), &about) != 0) return std::strerror(errno);
    if (!S_ISREG(about.st_mode)) return "it is not a file"; // reading a pipe would block
    const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rbe"));
    if (!file) return std::strerror(errno);
    if (std::size_t(about.st_size) > max)
        return fmt::format("it has {} bytes, at most {} are allowed", about.st_size, max);
    bytes.resize(std::size_t(about.st_size));
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
    return std::ferror(file.get()) ? std::strerror(errno) : "";
}

std::uint32_t number(std::span<const unsigned char> bytes) {
    return std::uint32_t(bytes[0]) << 24U | std::uint32_t(bytes[1]) << 16U | std::uint32_t(bytes[2]) << 8U | bytes[3];
}

/// Signature and size of a PNG: eight bytes, then the IHDR chunk with width and height (PNG specification, 5.2,
/// 11.2.2).
struct Header {
    bool is_png = false;
    std::uint32_t width = 0, height = 0;

    explicit Header(std::span<const unsigned char> bytes) {
        constexpr std::array<unsigned char, 8> signature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
        constexpr std::size_t at_width = 16, at_height = 20, size = 24;
        if (bytes.size() < size || !std::equal(signature.begin(), signature.end(), bytes.begin())) return;
        is_png = std::memcmp(&bytes[12], "IHDR", 4) == 0;
        width = number(bytes.subspan(at_width));
        height = number(bytes.subspan(at_height));
    }
};

/// True if all chunks, of a length, a type, data and a checksum, end within the file (PNG specification, 5.3): libpng
/// makes room for a chunk before it reads any of it.
bool are_chunks_whole(std::span<const unsigned char> bytes) {
    constexpr std::size_t signature = 8, around = 12;
    for (auto rest = bytes.subspan(signature); rest.size() >= around;) {
        const std::size_t length = number(rest);
        if (length > rest.size() - around) return false;
        if (std::memcmp(&rest[4], "IEND", 4) == 0) return true;
        rest = rest.subspan(around + length);
    }
    return true; // the last one says only that the file ends
}

cairo_status_t next_bytes(void* where, unsigned char* target, unsigned int length) {
    auto& rest = *static_cast<std::span<const unsigned char>*>(where);
    if (rest.size() < length) return CAIRO_STATUS_READ_ERROR;
    std::copy_n(rest.begin(), length, target);
    rest = rest.subspan(length);
    return CAIRO_STATUS_SUCCESS;
}

/// Decodes to 32 bits with or without alpha, as cairo does; null if the data is damaged.
std::shared_ptr<const Image> decoded(std::span<const unsigned char> bytes) {
    const CairoSurface surface(cairo_image_surface_create_from_png_stream(next_bytes, &bytes));
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return nullptr;
    // Other formats (16 bits a channel) are converted by painting.
    Image image{cairo_image_surface_get_width(surface.get()), cairo_image_surface_get_height(surface.get()), {}};
    image.pixels.resize(std::size_t(image.width) * std::size_t(image.height));
    const CairoSurface target(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(image.pixels.data()),
                                                                  CAIRO_FORMAT_ARGB32, image.width, image.height,
                                                                  image.width * int(sizeof image.pixels[0])));
    const CairoContext context(cairo_create(target.get()));
    cairo_set_source_surface(context.get(), surface.get(), 0, 0);
    cairo_paint(context.get());
    cairo_surface_flush(target.get());
    if (cairo_status(context.get()) != CAIRO_STATUS_SUCCESS) return nullptr;
    return with_halves(std::move(image));
}

} // namespace

ReadImage read_png(const std::filesystem::path& path, const std::string& name, const Limits& limits) {
    Bytes bytes;
    if (const auto reason = read_file(path, std::size_t(limits.bytes), bytes); !reason.empty())
        return problem(fmt::format("cannot read the image {}: {}", in_quotes(name), reason),
                       fmt::format("looked for {}", path.string()));
    return read_png(std::as_bytes(std::span(bytes)), name, limits);
}

ReadImage read_png(std::span<const std::byte> content, const std::string& name, const Limits& limits) {
    const std::span bytes(reinterpret_cast<const unsigned char*>(content.data()), content.size());
    const Header header(bytes);
    if (!header.is_png) return problem(fmt::format("{} is not a PNG file", in_quotes(name)), "images are PNG files");
    constexpr std::uint32_t longest_side = 16384;
    if (header.width > longest_side || header.height > longest_side)
        return problem(fmt::format("the image {} is {}x{}: at most {} pixels a side are possible", in_quotes(name),
                                   header.width, header.height, longest_side));
    const auto pixels = std::int64_t(header.width) * header.height;
    if (pixels > limits.pixels)
        return problem(fmt::format("the image {} is {}x{}, {} pixels, of which only {} are left", in_quotes(name),
                                   header.width, header.height, pixels, limits.pixels),
                       "limits.pixels=N allows more for all images together");
    if (auto image = are_chunks_whole(bytes) ? decoded(bytes) : nullptr) return {std::move(image), {}, {}};
    return problem(fmt::format("the image {} is broken", in_quotes(name)), "its data ends early or is damaged");
}

} // namespace sinew::canvas
