#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

/// Texts with numbers in them, for messages. A small formatter: the library for it would weigh as much as a solver room
/// in a WebAssembly module.
namespace sinew {

/// The shortest text that parses back to the same number.
std::string number_text(double number);
/// The number with so many significant digits, without trailing zeros: printf's %g.
std::string number_text(double number, int digits);

namespace detail {

/// A value for a hole of a format.
class FormatPart {
  public:
    FormatPart(std::string_view text) : type_(Type::text), text_(text) {}                    // NOLINT
    FormatPart(const char* text) : FormatPart(std::string_view(text)) {}                     // NOLINT
    FormatPart(const std::string& text) : FormatPart(std::string_view(text)) {}              // NOLINT
    FormatPart(std::signed_integral auto number) : type_(Type::integer), integer_(number) {} // NOLINT
    FormatPart(std::unsigned_integral auto number)                                           // NOLINT
        : type_(Type::natural), natural_(std::uint64_t(number)) {}
    FormatPart(std::floating_point auto number) : type_(Type::number), number_(double(number)) {} // NOLINT

    /// The text; a number has so many digits, or the shortest text for 0.
    std::string text(int digits) const;

  private:
    enum class Type : std::uint8_t { text, integer, natural, number };
    Type type_;
    std::string_view text_{};
    std::int64_t integer_ = 0;
    std::uint64_t natural_ = 0;
    double number_ = 0;
};

std::string format_parts(std::string_view text, std::span<const FormatPart> parts);

void a_format_has_a_hole_for_every_part(); ///< called where it has not: no constant, so it does not compile

/// A text with a hole for every part, which is checked when it is compiled.
template <class... Part> struct Format {
    std::string_view text;
    consteval Format(const char* given) : text(given) { // NOLINT: a literal is a format
        std::size_t holes = 0;
        for (const char c : text) holes += c == '{';
        if (holes != sizeof...(Part)) a_format_has_a_hole_for_every_part();
    }
};

} // namespace detail

/// The text with its holes filled in: {} for a text or a number, {:4} for a number with four significant digits.
template <class... Part>
std::string format_text(detail::Format<std::type_identity_t<Part>...> format, const Part&... part) {
    const detail::FormatPart parts[] = {detail::FormatPart(part)..., detail::FormatPart("")};
    return detail::format_parts(format.text, std::span(parts, sizeof...(Part)));
}

} // namespace sinew
