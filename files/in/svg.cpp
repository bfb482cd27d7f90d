#include "sinew/collide/decompose.h"

#include "files/in/formats.h"
#include "files/in/svg_shapes.h"
#include "files/in/svg_style.h"
#include "files/in/svg_values.h"

#include <algorithm>
#include <array>
#include <map>

namespace sinew::files {
namespace {

/// Elements of any file that are drawn more often than this are those of a bomb.
constexpr std::size_t most_visits = 50'000;

class SvgReader {
  public:
    SvgReader(const ImportFile& file, const ImportOptions& options)
        : file_(file), options_(options), document_(file.bytes), root_(document_.root()) {
        if (local(root_) != "svg")
            throw ImportError{place_of(root_),
                              concat("an SVG drawing begins with <svg>, found <", printable(root_.name), ">")};
        collect(root_);
    }

    Imported read() {
        const auto page = page_size();
        const double scale = options_.scale.value_or(1);
        constexpr double usual_error = 0.5; // pixels
        Drawing drawing(page * scale, options_.error.value_or(usual_error));
        drawing_ = &drawing;
        if (options_.role.empty())
            usual_ = std::nullopt;
        else
            usual_ = role_called(options_.role);
        const auto style = rules_.style_of(root_, {});
        read_children(root_, scaled_by(scale, scale) * view_box(root_, page), style, 0);
        for (const auto& [place, selector] : unknown_selectors_)
            drawing.notes().count(place, concat("the rule for ", in_quotes(selector),
                                                " is not applied: selectors are a tag, a class or an id"));
        return drawing.finish(concat("Imported from ", file_.name));
    }

  private:
    const ImportFile& file_;
    const ImportOptions& options_;
    XmlDocument document_;
    const XmlElement& root_;
    SvgRules rules_;
    std::vector<std::pair<std::string, std::string>> unknown_selectors_; ///< place, selector
    std::map<std::string_view, const XmlElement*> by_id_;
    std::optional<Role> usual_;
    Drawing* drawing_ = nullptr;
    Vec2<double> page_{};
    std::size_t visits_ = 0, points_ = 0;

    static std::string_view local(const XmlElement& node) {
        const auto name = node.name;
        return name.starts_with("svg:") ? name.substr(4) : name;
    }
    std::string place_of(const XmlElement& node) const { return document_.place_of(node); }
    std::string described(const XmlElement& node) const {
        const std::string_view id = node.value("id");
        return concat(place_of(node), ": <", printable(node.name), id.empty() ? "" : concat(" id=", in_quotes(id)),
                      ">");
    }

    /// Finds ids and style sheets before anything refers to them.
    void collect(const XmlElement& node) {
        if (node.has("id")) by_id_.emplace(node.value("id"), &node);
        if (local(node) == "style")
            for (auto& selector : rules_.add(node.text))
                unknown_selectors_.emplace_back(described(node), std::move(selector));
        for (const auto& child : node.children) collect(child);
    }

    /// Size of the page in pixels: its width and height, or those of its view box.
    Vec2<double> page_size() {
        const auto box = box_of(root_);
        Vec2<double> size{};
        for (int i = 0; i < 2; ++i) {
            const std::string_view text = root_.value(i == 0 ? "width" : "height");
            const double whole = box ? (*box)[std::size_t(i) + 2] : 0;
            size[i] = svg_value::length(text, whole).value_or(whole);
        }
        constexpr double most = 100'000;
        if (!(size[0] > 0 && size[1] > 0)) size = {{640, 480}};
        if (size[0] > most || size[1] > most)
            throw ImportError{place_of(root_),
                              format_text("the page has {:6} x {:6} pixels, at most {:6} a side are possible", size[0],
                                          size[1], most)};
        page_ = box ? Vec2<double>{{(*box)[2], (*box)[3]}} : size;
        return size;
    }
    static std::optional<std::array<double, 4>> box_of(const XmlElement& node) {
        const auto numbers = svg_value::numbers(node.value("viewBox"));
        if (!numbers || numbers->size() != 4 || !((*numbers)[2] > 0) || !((*numbers)[3] > 0)) return std::nullopt;
        return std::array{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
    }
    /// Map from the view box to a viewport of that size: as large as fits, in the middle, unless told otherwise.
    static Affine view_box(const XmlElement& node, const Vec2<double>& size) {
        const auto box = box_of(node);
        if (!box) return {};
        const auto [x, y, w, h] = *box;
        const std::string_view aspect = node.value("preserveAspectRatio");
        if (aspect.starts_with("none")) return scaled_by(size[0] / w, size[1] / h) * moved_by({{-x, -y}});
        const bool slice = aspect.find("slice") != aspect.npos;
        const double scale = slice ? std::max(size[0] / w, size[1] / h) : std::min(size[0] / w, size[1] / h);
        const auto share = [&](std::string_view low, std::string_view high) {
            return aspect.find(low) != aspect.npos ? 0 : aspect.find(high) != aspect.npos ? 1 : 0.5;
        };
        const Vec2<double> rest{
            {(size[0] - w * scale) * share("xMin", "xMax"), (size[1] - h * scale) * share("YMin", "YMax")}};
        return moved_by(rest) * scaled_by(scale, scale) * moved_by({{-x, -y}});
    }

    void read_children(const XmlElement& parent, const Affine& map, const SvgStyle& style, std::size_t depth) {
        for (const auto& child : parent.children) read_element(child, map, style, depth + 1);
    }

    void read_element(const XmlElement& node, const Affine& outer, const SvgStyle& parent, std::size_t depth) {
        if (++visits_ > most_visits)
            throw ImportError{described(node), concat("more than ", most_visits, " elements are drawn")};
        if (depth > ImportLimits::depth)
            throw ImportError{described(node),
                              concat("elements nest more than ", ImportLimits::depth, " deep, or refer to themselves")};
        const auto tag = local(node);
        if (is_silent_svg(tag)) return;
        const auto style = rules_.style_of(node, parent);
        if (!style.is_displayed) return drawing_->notes().count(described(node), "hidden elements are not taken");
        try {
            for (const auto& property : style.not_taken)
                drawing_->notes().count(described(node), concat("its ", property, " is not taken"));
            read_drawn(node, tag, outer * transform_of(node), style, depth);
        } catch (ImportError& error) {
            if (error.place.empty()) error.place = described(node);
            throw;
        }
    }

    Affine transform_of(const XmlElement& node) const {
        const std::string_view text = node.value("transform");
        if (const auto map = svg_value::transform(text)) return *map;
        throw ImportError{"", concat("its transform cannot be read: ", in_quotes(text))};
    }

    void read_drawn(const XmlElement& node, std::string_view tag, const Affine& map, const SvgStyle& style,
                    std::size_t depth) {
        if (tag == "g" || tag == "a") return read_children(node, map, style, depth);
        if (tag == "switch") return read_switch(node, map, style, depth);
        const auto moved = [&] {
            return map * moved_by({{svg_length(node, "x", page_[0]), svg_length(node, "y", page_[1])}});
        };
        if (tag == "svg") {
            const Vec2<double> size{
                {svg_length(node, "width", page_[0], page_[0]), svg_length(node, "height", page_[1], page_[1])}};
            return read_children(node, moved() * view_box(node, size), style, depth);
        }
        if (tag == "use") return read_use(node, moved(), style, depth);
        auto lines = svg_lines(node, tag, page_);
        if (!lines) return drawing_->notes().count(described(node), concat("<", printable(tag), "> is not taken"));
        if (!style.is_visible) return drawing_->notes().count(described(node), "hidden elements are not taken");
        if (lines->empty()) return drawing_->notes().count(described(node), "it has no extent: nothing is made of it");
        for (const auto& child : node.children) // such as <animate>
            if (!is_silent_svg(local(child)))
                drawing_->notes().count(described(child), concat("<", printable(child.name), "> is not taken"));
        add(node, tag, std::move(*lines), map, style);
    }

    /// Draws the first child that needs no language and no extension.
    void read_switch(const XmlElement& node, const Affine& map, const SvgStyle& style, std::size_t depth) {
        const XmlElement* drawn = nullptr;
        for (const auto& child : node.children) {
            const bool is_special =
                child.has("systemLanguage") || child.has("requiredExtensions") || local(child) == "foreignObject";
            if (!drawn && !is_special)
                read_element(*(drawn = &child), map, style, depth + 1);
            else if (!is_silent_svg(local(child)))
                drawing_->notes().count(described(child), "of a <switch> one child is taken");
        }
    }

    void read_use(const XmlElement& node, const Affine& map, const SvgStyle& style, std::size_t depth) {
        std::string_view target = node.value("href");
        if (target.empty()) target = node.value("xlink:href");
        const auto found = target.starts_with('#') ? by_id_.find(target.substr(1)) : by_id_.end();
        if (found == by_id_.end())
            return drawing_->notes().add(described(node),
                                         concat("it refers to ", in_quotes(target), ", which is not in this file"));
        if (local(*found->second) != "symbol") return read_element(*found->second, map, style, depth + 1);
        const Vec2<double> size{
            {svg_length(node, "width", page_[0], page_[0]), svg_length(node, "height", page_[1], page_[1])}};
        read_children(*found->second, map * view_box(*found->second, size), style, depth + 1);
    }

    /// Colour of a paint; that of a gradient is its first one.
    std::string paint(const XmlElement& node, std::string text, const SvgStyle& style, double opacity) {
        if (text == "currentColor") text = style.color;
        if (text.starts_with("url(")) {
            const auto begin = text.find('#'), end = text.find_first_of(")\"'", begin == text.npos ? 0 : begin);
            const auto id =
                begin == text.npos || end == text.npos ? std::string() : text.substr(begin + 1, end - begin - 1);
            drawing_->notes().count(described(node), "gradients and patterns become one colour");
            text = first_stop(id, 0);
        }
        if (const auto color = svg_value::color(text, opacity)) return *color;
        drawing_->notes().count(described(node), concat("the colour ", in_quotes(text), " is not known: gray"));
        return "gray";
    }
    std::string first_stop(const std::string& id, int depth) const {
        const auto found = by_id_.find(id);
        constexpr int most_references = 8;
        if (found == by_id_.end() || depth > most_references) return "gray";
        for (const auto& stop : found->second->children)
            if (local(stop) == "stop") {
                const std::string style(stop.value("style"));
                const auto at = style.find("stop-color:");
                if (at != style.npos) return style.substr(at + 11, style.find(';', at) - at - 11);
                return std::string(stop.has("stop-color") ? stop.value("stop-color") : "black");
            }
        const auto href = found->second->value(found->second->has("xlink:href") ? "xlink:href" : "href");
        return href.starts_with('#') ? first_stop(std::string(href.substr(1)), depth + 1) : "gray";
    }

    void add(const XmlElement& node, std::string_view tag, std::vector<DrawnLine> lines, const Affine& map,
             const SvgStyle& style) {
        DrawnShape shape;
        shape.place = described(node);
        const auto label = node.value(node.has("inkscape:label") ? "inkscape:label" : "id");
        shape.name = label.empty() ? tag : label;
        shape.fill = paint(node, style.fill, style, style.opacity * style.fill_opacity);
        shape.stroke = paint(node, style.stroke, style, style.opacity * style.stroke_opacity);
        shape.stroke_width =
            svg_value::length(style.stroke_width, norm(page_) / std::sqrt(2)).value_or(1) * map.scale();
        shape.fill_rule = style.fill_rule == "evenodd" ? "evenodd" : "nonzero";
        const bool has_fill = shape.fill != "none" && tag != "line";
        const bool has_stroke = shape.stroke != "none";
        if (!has_fill && !has_stroke && !style.role)
            return drawing_->notes().count(shape.place, "neither filled nor stroked: not taken");
        bool is_open = false, has_area = false;
        for (auto& line : lines) {
            for (auto& p : line.points) p = map(p);
            points_ += line.points.size();
            is_open |= !line.closed;
            has_area |= collide::twice_area(line.points) != 0;
        }
        if (points_ > ImportLimits::points)
            throw ImportError{shape.place, concat("the outlines have more than ", ImportLimits::points, " points")};
        const bool is_line = is_open && (!has_fill || !has_area);
        shape.role = style.role.value_or(is_line ? Role::rope : usual_.value_or(Role::solid));
        // The fill of an open path closes it.
        if (shape.role != Role::rope && !(is_line && shape.role == Role::collider))
            for (auto& line : lines) line.closed = line.closed || !is_line;
        if (const double scale = map.similarity(); scale > 0) set_exact(shape, node, tag, map, scale);
        shape.lines = std::move(lines);
        drawing_->add(shape);
    }

    /// Circles and rectangles that are still such in the scene.
    void set_exact(DrawnShape& shape, const XmlElement& node, std::string_view tag, const Affine& map,
                   double scale) const {
        if (tag == "circle") {
            shape.circle = svg_length(node, "r", norm(page_) / std::sqrt(2)) * scale;
            shape.middle = map({{svg_length(node, "cx", page_[0]), svg_length(node, "cy", page_[1])}});
        }
        if (tag != "rect" || node.has("rx") || node.has("ry")) return;
        const Vec2<double> size{{svg_length(node, "width", page_[0]), svg_length(node, "height", page_[1])}};
        shape.box = size * scale;
        shape.middle =
            map(Vec2<double>{{svg_length(node, "x", page_[0]), svg_length(node, "y", page_[1])}} + size * 0.5);
        shape.turn = map.turn();
    }
};

bool looks_like_svg(std::string_view bytes) {
    const auto head = bytes.substr(0, 4096);
    const auto begin = head.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (begin == head.npos || head[begin] != '<') return false;
    return head.find("<svg") != head.npos || head.find("<svg:svg") != head.npos;
}

} // namespace

const ImportFormat reader::svg{
    "SVG", "svg", "shapes and paths as stiff or soft figures, ropes, cloth and colliders", looks_like_svg,
    [](const ImportFile& file, const ImportOptions& options) { return SvgReader(file, options).read(); }};

} // namespace sinew::files
