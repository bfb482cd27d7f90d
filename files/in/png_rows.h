#pragma once

#include "sinew/scene/image.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::files {

/// Form of the pixels of a PNG (ISO/IEC 15948, 11.2.2): gray 0, colour 2, palette 3, and with opacity 4 and 6.
struct PngForm {
    std::uint32_t width = 0, height = 0;
    unsigned depth = 8; ///< bits of a sample
    unsigned type = 6;
    bool is_interlaced = false;
    std::vector<std::uint32_t> palette{};                      ///< 0xAARRGGBB, not premultiplied
    std::optional<std::array<std::uint32_t, 3>> see_through{}; ///< samples of the one colour that is transparent

    bool is_valid() const;
    unsigned channels() const { return type == 2 ? 3 : type == 4 ? 2 : type == 6 ? 4 : 1; }
    std::size_t row_bytes(std::uint32_t pixels) const { return (std::size_t(pixels) * channels() * depth + 7) / 8; }
    /// Bytes of all rows, each after the number of its filter.
    std::size_t bytes() const;
};

/// The picture of filtered rows. Throws ImportError with the row that is damaged.
Image png_picture(const PngForm& form, std::string rows);

} // namespace sinew::files
