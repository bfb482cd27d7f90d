#include "files/in/png_pieces.h"

#include "files/in/hex_color.h"
#include "files/in/import.h"

#include <algorithm>
#include <cmath>

namespace sinew::files {
namespace {

constexpr std::uint32_t half_opaque = 128;

std::uint32_t alpha_of(std::uint32_t pixel) {
    return pixel >> 24U;
}

/// Labels of opaque pixels that touch, 1, 2, ..., by filling.
class PixelLabels {
  public:
    explicit PixelLabels(const Image& image) : image_(image), labels_(image.pixels.size()) {
        for (std::size_t i = 0; i < labels_.size(); ++i)
            if (labels_[i] == 0 && alpha_of(image_.pixels[i]) >= half_opaque) fill(i);
    }

    struct Box {
        int left, top, right, bottom;
        std::size_t pixels;
    };
    const std::vector<Box>& boxes() const { return boxes_; }

    ImagePart part(std::size_t number) const {
        const auto& box = boxes_[number];
        // A pixel of margin keeps the smooth border, whose pixels are less than half opaque.
        const int left = std::max(box.left - 1, 0), top = std::max(box.top - 1, 0);
        const int right = std::min(box.right + 2, image_.width), bottom = std::min(box.bottom + 2, image_.height);
        ImagePart part{{right - left, bottom - top, {}}, left, top, box.pixels};
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                const auto i = index(x, y);
                const bool is_border = labels_[i] == 0 && touches(x, y, std::uint32_t(number) + 1);
                part.image.pixels.push_back(labels_[i] == number + 1 || is_border ? image_.pixels[i] : 0);
            }
        return part;
    }

  private:
    const Image& image_;
    std::vector<std::uint32_t> labels_;
    std::vector<Box> boxes_;

    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(image_.width) + std::size_t(x); }

    template <class Visit> void around(int x, int y, const Visit& visit) const {
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image_.height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image_.width - 1); ++u) visit(index(u, v));
    }
    bool touches(int x, int y, std::uint32_t label) const {
        bool found = false;
        around(x, y, [&](std::size_t i) { found |= labels_[i] == label; });
        return found;
    }

    void fill(std::size_t start) {
        boxes_.push_back({image_.width, image_.height, 0, 0, 0});
        const auto label = std::uint32_t(boxes_.size());
        std::vector<std::size_t> waiting{start};
        labels_[start] = label;
        while (!waiting.empty()) {
            const auto i = waiting.back();
            waiting.pop_back();
            const int x = int(i % std::size_t(image_.width)), y = int(i / std::size_t(image_.width));
            auto& box = boxes_.back();
            box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x), std::max(box.bottom, y),
                   box.pixels + 1};
            const auto visit = [&](int u, int v) {
                if (u < 0 || v < 0 || u >= image_.width || v >= image_.height) return;
                const auto k = index(u, v);
                if (labels_[k] != 0 || alpha_of(image_.pixels[k]) < half_opaque) return;
                labels_[k] = label;
                waiting.push_back(k);
            };
            // Not across corners: the outline of a part is then one, and its holes.
            visit(x - 1, y), visit(x + 1, y), visit(x, y - 1), visit(x, y + 1);
        }
    }
};

/// Bilinear sample of an image, transparent outside.
std::uint32_t sample(const Image& image, double x, double y) {
    x -= 0.5, y -= 0.5;
    const int left = int(std::floor(x)), top = int(std::floor(y));
    std::array<double, 4> sum{};
    for (const int dy : {0, 1})
        for (const int dx : {0, 1}) {
            const int u = left + dx, v = top + dy;
            if (u < 0 || v < 0 || u >= image.width || v >= image.height) continue;
            const double weight = std::abs(1 - dx - (x - left)) * std::abs(1 - dy - (y - top));
            const auto pixel = image.pixels[std::size_t(v) * std::size_t(image.width) + std::size_t(u)];
            for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * double(pixel >> (8 * k) & 255U);
        }
    std::uint32_t result = 0;
    for (std::size_t k = 0; k < 4; ++k) result |= std::uint32_t(sum[k] + 0.5) << (8 * k);
    return result;
}

} // namespace

void each_part(const Image& image, const std::function<void(const ImagePart&)>& visit) {
    const PixelLabels labels(image);
    std::vector<std::size_t> order(labels.boxes().size());
    double covered = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto& box = labels.boxes()[i];
        order[i] = i;
        covered += double(box.right - box.left + 1) * double(box.bottom - box.top + 1);
    }
    if (covered > 4 * double(image.pixels.size())) throw ImportError{"", "its parts lie within each other too often"};
    std::ranges::stable_sort(order, std::greater(), [&](auto i) { return labels.boxes()[i].pixels; });
    for (const auto i : order) visit(labels.part(i));
}

Image cut_out(const Image& image, const std::array<Vec2<double>, 4>& corners, double density) {
    const auto& [a, b, c, d] = corners;
    constexpr double most = 2048; // pixels a side
    const auto pixels = [&](double length) { return std::max(int(std::ceil(std::fmin(length * density, most))), 2); };
    Image part{pixels(std::max(distance(a, b), distance(d, c))), pixels(std::max(distance(a, d), distance(b, c))), {}};
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x) {
            const double u = (x + 0.5) / part.width, v = (y + 0.5) / part.height;
            const auto at = (a * (1 - u) + b * u) * (1 - v) + (d * (1 - u) + c * u) * v;
            part.pixels.push_back(sample(image, at[0], at[1]));
        }
    return part;
}

std::string mean_color(const Image& image) {
    std::array<double, 4> sum{};
    for (const auto pixel : image.pixels)
        for (std::size_t k = 0; k < 4; ++k) sum[k] += double(pixel >> (8 * k) & 255U);
    const auto channel = [&](std::size_t k) { return sum[3] > 0 ? int(std::min(sum[k] / sum[3] * 255, 255.0)) : 0; };
    return hex_color({channel(2), channel(1), channel(0)});
}

} // namespace sinew::files
