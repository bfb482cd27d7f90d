#include "files/in/svg_shapes.h"

#include "sinew/scene/svg_path.h"
#include "sinew/scene/text.h"

#include "files/in/svg_values.h"

#include <algorithm>
#include <array>

namespace sinew::files {
namespace {

constexpr std::array<std::string_view, 14> silent_tags = {
    "defs",           "title",          "desc",    "metadata", "style",
    "linearGradient", "radialGradient", "symbol",  "marker",   "sodipodi:namedview",
    "clipPath",       "mask",           "pattern", "filter"};

std::vector<DrawnLine> along_path(std::string_view data) {
    auto path = read_svg_path(data);
    if (!path.error.empty()) throw ImportError{"", path.error};
    std::vector<DrawnLine> lines;
    for (auto& outline : path.outlines) lines.push_back({std::move(outline.points), outline.closed});
    return lines;
}

std::vector<DrawnLine> ellipse_lines(double x, double y, double rx, double ry) {
    if (rx <= 0 || ry <= 0) return {};
    return along_path(
        format_text("M{} {}A{} {} 0 0 1 {} {}A{} {} 0 0 1 {} {}Z", x - rx, y, rx, ry, x + rx, y, rx, ry, x - rx, y));
}

std::vector<DrawnLine> rectangle_lines(const XmlElement& element, const Vec2<double>& page) {
    const double x = svg_length(element, "x", page[0]), y = svg_length(element, "y", page[1]);
    const double w = svg_length(element, "width", page[0]), h = svg_length(element, "height", page[1]);
    if (w <= 0 || h <= 0) return {};
    double rx = svg_length(element, "rx", page[0], -1), ry = svg_length(element, "ry", page[1], -1);
    if (rx < 0) rx = ry;
    if (ry < 0) ry = rx;
    rx = std::clamp(rx, 0.0, w / 2), ry = std::clamp(ry, 0.0, h / 2);
    if (rx <= 0 || ry <= 0) return {{{Vec2<double>{{x, y}}, {{x + w, y}}, {{x + w, y + h}}, {{x, y + h}}}, true}};
    const auto arc = [&](double dx, double dy) { return format_text("a{} {} 0 0 1 {} {}", rx, ry, dx, dy); };
    return along_path(format_text("M{} {}H{}{}V{}{}H{}{}V{}{}Z", x + rx, y, x + w - rx, arc(rx, ry), y + h - ry,
                                  arc(-rx, ry), x + rx, arc(-rx, -ry), y + ry, arc(rx, -ry)));
}

std::vector<DrawnLine> corner_lines(const XmlElement& element, bool closed) {
    const auto numbers = svg_value::numbers(element.value("points"));
    if (!numbers || numbers->size() % 2 != 0) throw ImportError{"", "its points are pairs of numbers, found others"};
    DrawnLine line{{}, closed};
    for (std::size_t i = 0; i + 1 < numbers->size(); i += 2)
        line.points.push_back({{(*numbers)[i], (*numbers)[i + 1]}});
    if (line.points.size() < 2) return {};
    return {std::move(line)};
}

} // namespace

double svg_length(const XmlElement& element, std::string_view name, double whole, double usual) {
    const std::string_view text = element.value(name);
    if (text.empty() || text == "auto") return usual;
    if (const auto length = svg_value::length(text, whole)) return *length;
    throw ImportError{"", concat("its ", name, " is a length, found ", in_quotes(text))};
}

std::optional<std::vector<DrawnLine>> svg_lines(const XmlElement& element, std::string_view tag,
                                                const Vec2<double>& page) {
    const auto number = [&](std::string_view name, int axis) { return svg_length(element, name, page[axis]); };
    if (tag == "path") return along_path(element.value("d"));
    if (tag == "rect") return rectangle_lines(element, page);
    if (tag == "circle") {
        const double radius = svg_length(element, "r", norm(page) / std::sqrt(2));
        return ellipse_lines(number("cx", 0), number("cy", 1), radius, radius);
    }
    if (tag == "ellipse") return ellipse_lines(number("cx", 0), number("cy", 1), number("rx", 0), number("ry", 1));
    if (tag == "line")
        return std::vector{
            DrawnLine{{{{number("x1", 0), number("y1", 1)}}, {{number("x2", 0), number("y2", 1)}}}, false}};
    if (tag == "polygon") return corner_lines(element, true);
    if (tag == "polyline") return corner_lines(element, false);
    return std::nullopt;
}

bool is_silent_svg(std::string_view tag) {
    return std::ranges::count(silent_tags, tag) > 0 || tag.starts_with("inkscape:") || tag.starts_with("sodipodi:");
}

} // namespace sinew::files
