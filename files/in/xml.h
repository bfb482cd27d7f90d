#pragma once

#include "files/in/text_place.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::files {

/// An attribute, its references replaced.
struct XmlAttribute {
    std::string_view name;
    std::string value;
};

/// An element of a document, with the elements in it.
struct XmlElement {
    std::string_view name{};
    std::size_t offset = 0; ///< of the name, bytes
    std::vector<XmlAttribute> attributes{};
    std::vector<XmlElement> children{};
    std::string text{}; ///< directly in it, before, between and behind the children

    bool has(std::string_view attribute) const { return find(attribute) != nullptr; }
    /// Value of an attribute; empty where it is missing.
    std::string_view value(std::string_view attribute) const {
        const auto* const found = find(attribute);
        return found ? std::string_view(found->value) : std::string_view();
    }
    /// The first child of that name, or null.
    const XmlElement* child(std::string_view wanted) const;

  private:
    const XmlAttribute* find(std::string_view attribute) const;
};

/// A document of XML 1.0 (W3C, fifth edition) in UTF-8 or Latin-1, not validated. Entities are those of XML and of its
/// own document type.
class XmlDocument {
  public:
    /// Throws ImportError for a text that is no XML, nests deeper than ImportLimits::depth or has too many elements.
    explicit XmlDocument(std::string text);

    const XmlElement& root() const { return root_; }
    /// Line and column: "12:5".
    std::string place_of(const XmlElement& element) const { return places_.at(element.offset); }
    std::string place_of(std::size_t offset) const { return places_.at(offset); }

  private:
    std::unique_ptr<const std::string> text_; ///< names of elements are parts of it
    TextPlaces places_;
    XmlElement root_;
};

} // namespace sinew::files
