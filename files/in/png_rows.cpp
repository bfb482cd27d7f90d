#include "files/in/png_rows.h"

#include "sinew/scene/text.h"

#include "files/in/import.h"

#include <algorithm>
#include <cstdlib>

namespace sinew::files {
namespace {

/// Pixels of one pass: every `step` from `first` on, across and down.
struct PngPass {
    std::uint32_t first_x, first_y, step_x, step_y;

    std::uint32_t width(const PngForm& form) const { return count(form.width, first_x, step_x); }
    std::uint32_t height(const PngForm& form) const {
        return width(form) == 0 ? 0 : count(form.height, first_y, step_y);
    }

  private:
    static std::uint32_t count(std::uint32_t size, std::uint32_t first, std::uint32_t step) {
        return size > first ? (size - first + step - 1) / step : 0;
    }
};

// ISO/IEC 15948, 8.2: the method of Adam7.
constexpr std::array<PngPass, 7> interlaced = {
    {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};
constexpr std::array<PngPass, 1> whole = {{{0, 0, 1, 1}}};

std::span<const PngPass> passes_of(const PngForm& form) {
    if (form.is_interlaced) return interlaced;
    return whole;
}

/// ISO/IEC 15948, 9.4: the neighbour nearest to left + above - corner.
int paeth(int left, int above, int corner) {
    const int guess = left + above - corner;
    const int a = std::abs(guess - left), b = std::abs(guess - above), c = std::abs(guess - corner);
    return a <= b && a <= c ? left : b <= c ? above : corner;
}

class PngRows {
  public:
    PngRows(const PngForm& form, std::string rows) : form_(form), rows_(std::move(rows)) {
        image_.width = int(form.width), image_.height = int(form.height);
        image_.pixels.resize(std::size_t(form.width) * form.height);
    }

    Image picture() {
        for (const auto& pass : passes_of(form_)) {
            const auto bytes = form_.row_bytes(pass.width(form_));
            const unsigned char* above = nullptr;
            for (std::uint32_t row = 0; row < pass.height(form_); ++row) {
                auto* const here = reinterpret_cast<unsigned char*>(&rows_[at_]);
                const auto y = pass.first_y + row * pass.step_y;
                unfilter(here, above, bytes, y);
                put(here + 1, pass, y);
                above = here + 1;
                at_ += bytes + 1;
            }
        }
        return std::move(image_);
    }

  private:
    const PngForm& form_;
    std::string rows_;
    std::size_t at_ = 0; ///< byte of `rows_`
    Image image_;

    [[noreturn]] static void fail(std::uint32_t row, std::string message) {
        throw ImportError{concat("row ", row), std::move(message)};
    }

    void unfilter(unsigned char* row, const unsigned char* above, std::size_t bytes, std::uint32_t y) const {
        const unsigned filter = row[0];
        if (filter > 4) fail(y, concat("there is no filter ", filter, ": the picture is damaged"));
        const std::size_t pixel = std::max<std::size_t>(form_.channels() * form_.depth / 8, 1);
        auto* const samples = row + 1;
        for (std::size_t i = 0; filter != 0 && i < bytes; ++i) {
            const int left = i >= pixel ? samples[i - pixel] : 0, up = above ? above[i] : 0;
            const int corner = above && i >= pixel ? above[i - pixel] : 0;
            const int guess = filter == 1   ? left
                              : filter == 2 ? up
                              : filter == 3 ? (left + up) / 2
                                            : paeth(left, up, corner);
            samples[i] = static_cast<unsigned char>(samples[i] + guess);
        }
    }

    std::uint32_t sample(const unsigned char* row, std::size_t number) const {
        const unsigned depth = form_.depth;
        if (depth == 16) return std::uint32_t(row[2 * number]) << 8U | row[2 * number + 1];
        const auto bit = number * depth;
        return std::uint32_t(row[bit / 8]) >> (8 - depth - bit % 8) & ((1U << depth) - 1);
    }

    /// A sample as 8 bits.
    std::uint32_t byte_of(std::uint32_t sample) const {
        return form_.depth == 16 ? sample >> 8U : sample * 255 / ((1U << form_.depth) - 1);
    }

    void put(const unsigned char* row, const PngPass& pass, std::uint32_t y) {
        for (std::uint32_t i = 0; i < pass.width(form_); ++i) {
            const auto x = pass.first_x + i * pass.step_x;
            image_.pixels[std::size_t(y) * form_.width + x] = premultiplied(pixel(row, i, y));
        }
    }

    std::uint32_t pixel(const unsigned char* row, std::uint32_t i, std::uint32_t y) const {
        const auto channels = form_.channels();
        std::array<std::uint32_t, 4> samples{};
        for (unsigned k = 0; k < channels; ++k) samples[k] = sample(row, std::size_t(i) * channels + k);
        if (form_.type == 3) {
            if (samples[0] >= form_.palette.size()) fail(y, concat("the palette has no colour ", samples[0]));
            return form_.palette[samples[0]];
        }
        const bool is_gray = form_.type == 0 || form_.type == 4, has_alpha = form_.type >= 4;
        const auto red = samples[0], green = samples[is_gray ? 0 : 1], blue = samples[is_gray ? 0 : 2];
        auto alpha = has_alpha ? byte_of(samples[channels - 1]) : 255U;
        if (form_.see_through && *form_.see_through == std::array{red, green, blue}) alpha = 0;
        return alpha << 24U | byte_of(red) << 16U | byte_of(green) << 8U | byte_of(blue);
    }

    static std::uint32_t premultiplied(std::uint32_t pixel) {
        const auto alpha = pixel >> 24U;
        std::uint32_t result = alpha << 24U;
        for (const auto shift : {16U, 8U, 0U}) result |= ((pixel >> shift & 255U) * alpha + 127) / 255 << shift;
        return result;
    }
};

} // namespace

bool PngForm::is_valid() const {
    const bool is_power = depth == 1 || depth == 2 || depth == 4 || depth == 8 || depth == 16;
    const bool is_small = type == 0 || type == 3;
    return is_power && (type == 0 || type == 2 || type == 3 || type == 4 || type == 6) && (is_small || depth >= 8) &&
           (type != 3 || depth <= 8);
}

std::size_t PngForm::bytes() const {
    std::size_t sum = 0;
    for (const auto& pass : passes_of(*this)) sum += pass.height(*this) * (1 + row_bytes(pass.width(*this)));
    return sum;
}

Image png_picture(const PngForm& form, std::string rows) {
    return PngRows(form, std::move(rows)).picture();
}

} // namespace sinew::files
