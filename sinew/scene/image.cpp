#include "sinew/scene/image.h"

#include <algorithm>
#include <array>

namespace sinew {
namespace {

/// Mean of four pixels, channel by channel, rounded. Premultiplied colours can be averaged directly.
std::uint32_t mean(const std::array<std::uint32_t, 4>& pixels) {
    std::uint32_t sum = 0;
    for (const unsigned shift : {0U, 8U, 16U, 24U}) {
        std::uint32_t channel = 2;
        for (const auto pixel : pixels) channel += pixel >> shift & 255U;
        sum |= channel / 4 << shift;
    }
    return sum;
}

Image halved(const Image& image) {
    Image half{(image.width + 1) / 2, (image.height + 1) / 2, {}};
    half.pixels.reserve(std::size_t(half.width) * std::size_t(half.height));
    const auto at = [&](int x, int y) {
        return image.pixels[std::size_t(std::min(y, image.height - 1)) * std::size_t(image.width) +
                            std::size_t(std::min(x, image.width - 1))];
    };
    for (int y = 0; y < image.height; y += 2)
        for (int x = 0; x < image.width; x += 2)
            half.pixels.push_back(mean({at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)}));
    return half;
}

} // namespace

std::shared_ptr<const Image> with_halves(Image image) {
    constexpr int smallest = 4;
    if (std::min(image.width, image.height) > smallest) image.half = with_halves(halved(image));
    return std::make_shared<const Image>(std::move(image));
}

} // namespace sinew
