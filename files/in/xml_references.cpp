#include "files/in/xml_references.h"

#include "sinew/scene/text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace sinew::files {
namespace {

void append_utf8(std::uint32_t code, std::string& target) {
    const auto tail = [&](unsigned shift) { target += char(0x80U | (code >> shift & 0x3fU)); };
    if (code < 0x80) {
        target += char(code);
    } else if (code < 0x800) {
        target += char(0xc0U | code >> 6U), tail(0);
    } else if (code < 0x10000) {
        target += char(0xe0U | code >> 12U), tail(6), tail(0);
    } else {
        target += char(0xf0U | code >> 18U), tail(12), tail(6), tail(0);
    }
}

/// A character by its number: "#65" or "#x41".
bool append_number(std::string_view name, std::string& target) {
    const int base = name.starts_with("#x") ? 16 : 10;
    name.remove_prefix(base == 16 ? 2 : 1);
    std::uint32_t code = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), code, base);
    const bool is_half = code >= 0xd800 && code < 0xe000; // of a pair of UTF-16
    if (error != std::errc() || end != name.data() + name.size() || code == 0 || is_half || code > 0x10ffff)
        return false;
    append_utf8(code, target);
    return true;
}

} // namespace

bool XmlReferences::set_encoding(std::string_view name) {
    std::string small(name);
    std::ranges::transform(small, small.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    is_latin_ = small == "iso-8859-1" || small == "latin1";
    return is_latin_ || small == "utf-8" || small == "utf8" || small == "us-ascii" || small == "ascii";
}

void XmlReferences::append_plain(std::string_view raw, std::string& target) const {
    if (!is_latin_) return void(target += raw);
    for (const char c : raw) append_utf8(static_cast<unsigned char>(c), target);
}

std::optional<std::string> XmlReferences::replace(std::string_view name, std::string& target) {
    if (name.starts_with('#')) {
        if (append_number(name, target)) return std::nullopt;
        return concat("&", printable(name), "; is no character");
    }
    const auto found = entities_.find(name);
    if (found == entities_.end()) return concat("the entity &", printable(name), "; is not known");
    constexpr std::size_t most = 1'000'000; // bytes
    if ((replaced_ += found->second.size()) > most) return concat("entities stand for more than ", most, " bytes");
    target += found->second;
    return std::nullopt;
}

std::optional<XmlReferences::Problem> XmlReferences::append(std::string_view raw, std::string& target) {
    for (std::size_t at = 0; at < raw.size();) {
        const auto mark = std::min(raw.find('&', at), raw.size());
        append_plain(raw.substr(at, mark - at), target);
        if (mark == raw.size()) break;
        const auto end = raw.find(';', mark);
        constexpr std::size_t longest = 64; // bytes of a name
        if (end == raw.npos || end - mark > longest)
            return Problem{mark, "an & begins a reference such as &amp;, which ends with a semicolon"};
        if (auto message = replace(raw.substr(mark + 1, end - mark - 1), target))
            return Problem{mark, std::move(*message)};
        at = end + 1;
    }
    return std::nullopt;
}

} // namespace sinew::files
