#include "files/in/svg_style.h"

#include "files/in/svg_values.h"

#include <algorithm>
#include <array>

namespace sinew::files {
namespace {

using svg_value::trimmed;

bool has_word(std::string_view list, std::string_view word) {
    for (std::size_t begin = 0; begin < list.size();) {
        const auto end = std::min(list.find_first_of(" \t\r\n", begin), list.size());
        if (list.substr(begin, end - begin) == word) return true;
        begin = end + 1;
    }
    return false;
}

constexpr std::array<std::string_view, 10> unknown_properties = {
    "clip-path",    "mask",       "filter",     "stroke-dasharray", "marker",
    "marker-start", "marker-mid", "marker-end", "transform",        "mix-blend-mode"};

void set_opacity(double& target, std::string_view text, double before = 1) {
    if (const auto value = svg_value::length(text, 1)) target = before * std::clamp(*value, 0.0, 1.0);
}

/// Sets one property; properties without a meaning for scenes are passed over.
void set_property(SvgStyle& style, std::string_view name, std::string_view value, const SvgStyle& parent) {
    value = trimmed(value.substr(0, value.find("!important")));
    if (value.empty() || value == "inherit") return;
    if (name == "fill") style.fill = value;
    if (name == "stroke") style.stroke = value;
    if (name == "color") style.color = value;
    if (name == "fill-rule") style.fill_rule = value == "evenodd" ? "evenodd" : "nonzero";
    if (name == "stroke-width") style.stroke_width = value;
    if (name == "opacity") set_opacity(style.opacity, value, parent.opacity);
    if (name == "fill-opacity") set_opacity(style.fill_opacity, value);
    if (name == "stroke-opacity") set_opacity(style.stroke_opacity, value);
    if (name == "visibility") style.is_visible = value == "visible";
    const bool has_meaning = value != "none" && value != "normal";
    if (std::ranges::count(unknown_properties, name) > 0 && has_meaning) style.not_taken.emplace_back(name);
    if (name == "display") style.is_displayed = value != "none";
}

void set_declarations(SvgStyle& style, std::string_view text, const SvgStyle& parent) {
    while (!text.empty()) {
        const auto end = std::min(text.find(';'), text.size());
        const auto one = text.substr(0, end);
        if (const auto colon = one.find(':'); colon != one.npos)
            set_property(style, trimmed(one.substr(0, colon)), one.substr(colon + 1), parent);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

std::string without_comments(std::string_view css) {
    std::string text;
    while (!css.empty()) {
        const auto begin = std::min(css.find("/*"), css.size());
        text += css.substr(0, begin);
        const auto end = css.find("*/", begin);
        css.remove_prefix(begin == css.size() || end == css.npos ? css.size() : end + 2);
    }
    return text;
}

std::optional<Role> role_of(const XmlElement& element) {
    for (const auto* const name : {"id", "class", "inkscape:label", "data-name"})
        if (const auto role = role_in(element.value(name))) return role;
    return std::nullopt;
}

/// Place behind the block that an opening brace begins, with the blocks in it.
std::size_t end_of_block(std::string_view css, std::size_t open) {
    int depth = 0;
    for (auto i = open; i < css.size(); ++i) {
        depth += css[i] == '{' ? 1 : css[i] == '}' ? -1 : 0;
        if (depth == 0) return i + 1;
    }
    return css.size();
}

/// A tag, a class, an id, or one of each in this order.
bool is_simple(std::string_view selector) {
    const bool is_plain = std::ranges::all_of(selector, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
               c == '.' || c == '#' || c == '*';
    });
    return is_plain && !selector.empty() && std::ranges::count(selector, '.') <= 1 &&
           std::ranges::count(selector, '#') <= 1;
}

} // namespace

SvgRules::Rule SvgRules::rule_of(std::string_view selector, std::string declarations) {
    Rule rule{.declarations = std::move(declarations)};
    auto* part = &rule.tag;
    for (const char c : selector)
        if (c == '.' || c == '#')
            part = c == '.' ? &rule.word : &rule.id;
        else if (c != '*')
            *part += c;
    return rule;
}

std::vector<std::string> SvgRules::add(std::string_view css) {
    std::vector<std::string> unknown;
    const auto text = without_comments(css);
    for (std::size_t begin = 0; begin < text.size();) {
        const auto open = text.find('{', begin), statement = text.find(';', begin);
        begin = text.find_first_not_of(" \t\r\n", begin);
        if (begin == text.npos) break;
        if (text[begin] == '@' && statement < open) { // such as @import
            unknown.push_back(text.substr(begin, statement - begin));
            begin = statement + 1;
            continue;
        }
        if (open == text.npos) {
            unknown.push_back(text.substr(begin));
            break;
        }
        const auto end = end_of_block(text, open);
        std::string_view selectors = std::string_view(text).substr(begin, open - begin);
        while (!selectors.empty()) {
            const auto comma = std::min(selectors.find(','), selectors.size());
            const auto selector = trimmed(selectors.substr(0, comma));
            selectors.remove_prefix(std::min(comma + 1, selectors.size()));
            if (is_simple(selector))
                rules_.push_back(rule_of(selector, text.substr(open + 1, end - open - 2)));
            else
                unknown.emplace_back(selector);
        }
        begin = end;
    }
    std::ranges::stable_sort(rules_, {}, &Rule::weight);
    return unknown;
}

bool SvgRules::matches(const Rule& rule, const XmlElement& element) {
    return (rule.tag.empty() || rule.tag == element.name) && (rule.id.empty() || rule.id == element.value("id")) &&
           (rule.word.empty() || has_word(element.value("class"), rule.word));
}

SvgStyle SvgRules::style_of(const XmlElement& element, const SvgStyle& parent) const {
    SvgStyle style = parent;
    style.not_taken.clear();
    constexpr std::array properties = {"fill",
                                       "stroke",
                                       "color",
                                       "fill-rule",
                                       "stroke-width",
                                       "opacity",
                                       "fill-opacity",
                                       "stroke-opacity",
                                       "visibility",
                                       "clip-path",
                                       "mask",
                                       "filter",
                                       "stroke-dasharray",
                                       "display",
                                       "marker-start",
                                       "marker-mid",
                                       "marker-end",
                                       "mix-blend-mode"};
    for (const auto* const name : properties)
        if (element.has(name)) set_property(style, name, element.value(name), parent);
    for (const auto& rule : rules_)
        if (matches(rule, element)) set_declarations(style, rule.declarations, parent);
    set_declarations(style, element.value("style"), parent);
    if (const auto role = role_of(element)) style.role = role;
    return style;
}

} // namespace sinew::files
