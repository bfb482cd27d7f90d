#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::files {

/// Characters of an XML text: the encoding, and the meaning of &name; and &#number;.
class XmlReferences {
  public:
    struct Problem {
        std::size_t at; ///< byte of the text
        std::string message;
    };

    /// False for encodings that are not read.
    bool set_encoding(std::string_view name);
    /// An entity of the document type, whose value has no references.
    void declare(std::string_view name, std::string value) { entities_.emplace(name, std::move(value)); }

    /// Appends a text with its references replaced.
    std::optional<Problem> append(std::string_view raw, std::string& target);
    /// Appends a text in which nothing is replaced.
    void append_plain(std::string_view raw, std::string& target) const;

  private:
    std::map<std::string, std::string, std::less<>> entities_{
        {"lt", "<"}, {"gt", ">"}, {"amp", "&"}, {"quot", "\""}, {"apos", "'"}};
    bool is_latin_ = false;
    std::size_t replaced_ = 0; ///< bytes of entities

    std::optional<std::string> replace(std::string_view name, std::string& target);
};

} // namespace sinew::files
