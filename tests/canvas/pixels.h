#pragma once

#include "sinew/session/picture.h"

#include "canvas/cairo_handle.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <ostream>

namespace sinew {

constexpr Color white{1, 1, 1, 1}, black{0, 0, 0, 1}, red{1, 0, 0, 1};

/// A pixel as it lies in memory: 8 bits a channel, premultiplied by alpha.
struct Pixel {
    int red = 0, green = 0, blue = 0, alpha = 255;
    friend bool operator==(const Pixel&, const Pixel&) = default;

    friend std::ostream& operator<<(std::ostream& out, const Pixel& p) {
        return out << '(' << p.red << ' ' << p.green << ' ' << p.blue << ' ' << p.alpha << ')';
    }

    /// The largest difference of a channel.
    friend int difference(const Pixel& a, const Pixel& b) {
        return std::max({std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue),
                         std::abs(a.alpha - b.alpha)});
    }
};

inline Pixel pixel_of(const Color& c) {
    const auto byte = [&](float channel) { return int(channel * c.alpha * 255 + 0.5f); };
    return {byte(c.red), byte(c.green), byte(c.blue), int(c.alpha * 255 + 0.5f)};
}

inline Pixel pixel_from(const void* bytes) {
    std::uint32_t argb = 0;
    std::memcpy(&argb, bytes, sizeof argb);
    return {int(argb >> 16 & 255), int(argb >> 8 & 255), int(argb & 255), int(argb >> 24)};
}

/// Equal but for the rounding of one channel: cairo counts colours in 16 bits.
inline void expect_near(const Pixel& found, const Color& expected, int tolerance = 1) {
    EXPECT_LE(difference(found, pixel_of(expected)), tolerance) << found << " is not " << pixel_of(expected);
}

/// A PNG read back.
class PngFile {
  public:
    explicit PngFile(const std::filesystem::path& path)
        : surface(cairo_image_surface_create_from_png(path.c_str())),
          width(cairo_image_surface_get_width(surface.get())), height(cairo_image_surface_get_height(surface.get())) {}

    Pixel at(int x, int y) const {
        const auto stride = cairo_image_surface_get_stride(surface.get());
        Pixel pixel = pixel_from(cairo_image_surface_get_data(surface.get()) + y * stride + 4 * x);
        if (cairo_image_surface_get_format(surface.get()) == CAIRO_FORMAT_RGB24) pixel.alpha = 255;
        return pixel;
    }

  private:
    canvas::CairoSurface surface;

  public:
    const int width, height;
};

} // namespace sinew
