#pragma once

#include "files/in/role.h"
#include "files/in/xml.h"

#include <string>
#include <utility>
#include <vector>

namespace sinew::files {

/// Looks of an element of SVG, inherited by those in it.
struct SvgStyle {
    std::string fill = "black", stroke = "none", color = "black", fill_rule = "nonzero", stroke_width = "1";
    double opacity = 1, fill_opacity = 1, stroke_opacity = 1;
    bool is_visible = true, is_displayed = true;
    std::vector<std::string> not_taken{}; ///< properties of this element alone that scenes have not
    std::optional<Role> role{};           ///< by an id, a class or a label
};

/// Rules of the `style` elements of a drawing, as far as a selector is a tag, a class, an id or one of each.
class SvgRules {
  public:
    /// Adds the rules of a style sheet. Returns the selectors that are not understood.
    std::vector<std::string> add(std::string_view css);

    /// Style of an element: its parent's, then attributes, rules and its own `style`.
    SvgStyle style_of(const XmlElement& element, const SvgStyle& parent) const;

  private:
    struct Rule {
        std::string tag{}, word{}, id{}, declarations{};
        int weight() const { return (id.empty() ? 0 : 100) + (word.empty() ? 0 : 10) + (tag.empty() ? 0 : 1); }
    };
    std::vector<Rule> rules_; ///< by weight

    static Rule rule_of(std::string_view selector, std::string declarations);
    static bool matches(const Rule& rule, const XmlElement& element);
};

} // namespace sinew::files
