#include "sinew/picture/style_resolver.h"

#include "sinew/scene/check.h"

#include <algorithm>

namespace sinew {
namespace {

/// Merges a look into a style. A colour without a fill of the same look fills areas with a tint of the colour.
void dress(Style& style, const Look& look, const Theme& theme) {
    constexpr float tint = 0.6F;
    if (const auto color = color_in(theme, look.color)) {
        style.color = *color;
        style.fill = mix(*color, theme.background, tint);
        style.fill.alpha = color->alpha;
    }
    if (const auto fill = color_in(theme, look.fill)) style.fill = *fill;
    if (const auto hover = color_in(theme, look.hover)) style.hover = hover;
    if (!look.profile.empty()) style.profile = look.profile;
    if (!look.face.empty()) style.face = look.face;
    if (look.image) style.image = &*look.image;
    if (look.width) style.width = look.width;
    if (look.hidden) style.hidden = look.hidden;
}

bool is_part_of(const std::string& key, const std::string& figure, const std::string& part) {
    return key.size() == figure.size() + 1 + part.size() && key.starts_with(figure) && key.ends_with(part) &&
           key[figure.size()] == '/';
}

/// The figure that an event adds copies of under this name, NAME_1 and so on; null if none does.
const FigureSection* original_of(const Scene& scene, std::string_view name) {
    const auto number = name.find_last_not_of("0123456789");
    if (number == std::string_view::npos || number + 1 == name.size() || name[number] != '_') return nullptr;
    const auto original = name.substr(0, number);
    const bool is_added = std::ranges::any_of(scene.events, [&](const EventSection& section) {
        const auto* add = std::get_if<AddEvent>(&section.event);
        return add && add->figure == original;
    });
    const auto found = std::ranges::find(scene.figures, original, [](const auto& figure) { return name_of(figure); });
    return is_added && found != scene.figures.end() ? &*found : nullptr;
}

} // namespace

StyleResolver::StyleResolver(const Scene& scene, const Theme& theme, std::size_t figure, const std::string& name)
    : scene_(scene), theme_(theme), figure_(figure), name_(name) {
    if (figure < scene.figures.size() && name_of(scene.figures[figure]) == name) {
        section_ = &scene.figures[figure];
    } else if (const auto* original = original_of(scene, name)) {
        section_ = original;
        name_ = name_of(*original);
    }
}

Style StyleResolver::plain(const std::string& part) const {
    Style style;
    const auto* material = theme_.material_of(part);
    style.color = material ? *material : theme_.color_of(figure_);
    constexpr float tint = 0.6F;
    style.fill = part == "torso" ? style.color : mix(style.color, theme_.background, tint);
    return style;
}

const Style& StyleResolver::of(const std::string& part) {
    if (part == last_part_ && dressed_) return last_;
    last_ = plain(part);
    for (const auto& [key, look] : scene_.looks)
        if (key == part) dress(last_, look, theme_);
    for (const auto& [key, look] : scene_.looks)
        if (key == name_) dress(last_, look, theme_);
    if (section_) {
        const auto& own = section_->looks;
        for (const auto& [key, look] : own)
            if (key == "all") dress(last_, look, theme_);
        for (const auto& [key, look] : own)
            if (key == part) dress(last_, look, theme_);
    }
    for (const auto& [key, look] : scene_.looks)
        if (is_part_of(key, name_, part)) dress(last_, look, theme_);
    last_part_ = part;
    dressed_ = true;
    return last_;
}

std::optional<std::uint32_t> image_of(const Piece& piece, const Style& style, const Images& images) {
    if (!style.image || !takes_image(piece)) return std::nullopt;
    for (std::size_t i = 0; i < images.size(); ++i)
        if (images[i].first == style.image->file) return std::uint32_t(i);
    return std::nullopt;
}

} // namespace sinew
