#include "sinew/picture/annotator.h"

#include "sinew/math/format.h"

#include <array>
#include <span>
#include <utility>

namespace sinew {
namespace {

/// Sizes in nominal pixels.
constexpr float legend_row = 34, legend_margin = 14, bar_width = 150, bar_height = 7;

} // namespace

Color color_of_share(double share) {
    constexpr Color rest{0.93F, 0.91F, 0.84F, 1};
    return mix(rest, share < 0 ? squeezed : stretched, float(clamp(absolute(share), 0.0, 1.0)));
}

Annotator::Annotator(Picture& picture, const Theme& theme)
    : picture_(picture), theme_(theme), unit_(float(picture.height / Picture::nominal_height)) {}

/// Lower edge of the next legend, pixels.
float Annotator::next_row() {
    return float(picture_.height) - legend_margin * unit_ - float(rows_++) * legend_row * unit_;
}

void Annotator::label(std::string text, float x, float y) {
    picture_.add_text(std::move(text), {{x, y - bar_height * unit_ - 7 * unit_}}, letters * unit_, theme_.pen);
}

void Annotator::add_words(std::string words) {
    label(std::move(words), legend_margin * unit_ + bar_width * unit_, next_row());
}

void Annotator::add_bar(std::string_view what, double scale, std::string_view unit) {
    const float margin = legend_margin * unit_, wide = bar_width * unit_, high = bar_height * unit_, y = next_row();
    constexpr int parts = 30;
    for (int i = 0; i < parts; ++i) {
        const float left = margin + wide * float(i) / parts, right = margin + wide * float(i + 1) / parts + 0.5F;
        const std::array<Vec2<float>, 4> box = {{{{left, y - high}}, {{right, y - high}}, {{right, y}}, {{left, y}}}};
        picture_.add(Shape::polygon, box, 0, color_of_share(2 * (i + 0.5) / parts - 1));
    }
    label(format_text("-{:6} {}", scale, unit), margin + 18 * unit_, y);
    label(std::string(what), margin + wide / 2, y);
    label(format_text("{:6} {}", scale, unit), margin + wide - 15 * unit_, y);
}

void Annotator::add_arrow(std::string_view what, double scale) {
    const float margin = legend_margin * unit_, long_as = longest_arrow * unit_, letter = 0.6F * letters * unit_;
    const float y = next_row();
    const auto text = scale > 0 ? format_text("{}: {:6} N", what, scale) : format_text("{}: none", what);
    const float left = scale > 0 ? margin + long_as + letter : margin;
    picture_.add_text(text, {{left + letter * float(text.size()) / 2, y}}, letters * unit_, theme_.pen);
    if (scale > 0) draw_arrow({{margin, y}}, {{margin + long_as, y}}, theme_.pen);
}

void Annotator::write(const std::string& text, Vec2<float> middle, float height) {
    constexpr float letter_width = 0.6F; // as a fraction of the height
    const Vec2<float> half{{float(text.size()) * letter_width * height * unit_ / 2, height * unit_ / 2}};
    middle[0] = clamp(middle[0], half[0], max(half[0], float(picture_.width) - half[0]));
    middle[1] = clamp(middle[1], half[1], max(half[1], float(picture_.height) - half[1]));
    const Box box{middle, half * 2.0F};
    for (const auto& other : taken_) {
        const auto apart = box.middle - other.middle, room = (box.size + other.size) * 0.5F;
        if (absolute(apart[0]) < room[0] && absolute(apart[1]) < room[1]) return;
    }
    taken_.push_back(box);
    picture_.add_text(text, middle, height * unit_, theme_.pen);
}

void Annotator::draw_arrow(Vec2<float> from, Vec2<float> to, const Color& color) {
    const auto along = to - from;
    const float length = norm(along), head = min(8 * unit_, 0.4F * length);
    if (length < unit_) return;
    const auto ahead = along * (1 / length);
    const Vec2<float> across{{-ahead[1], ahead[0]}};
    const auto neck = to - ahead * head;
    const std::array shaft = {from, neck};
    const std::array<Vec2<float>, 3> tip = {{to, neck + across * (0.5F * head), neck - across * (0.5F * head)}};
    picture_.add(Shape::polyline, shaft, (line + 1.5F) * unit_, theme_.background);
    picture_.add(Shape::polyline, shaft, line * unit_, color);
    picture_.add(Shape::polygon, tip, 0, color);
}

} // namespace sinew
