#include "sinew/math/format.h"

#include "sinew/math/decimal.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace sinew {
namespace {

template <class... Part> std::string joined(const Part&... part) {
    std::string out;
    ((out += part), ...);
    return out;
}

std::string scientific(const decimal::Digits& number) {
    const auto& [digits, exponent] = number;
    const std::string power = std::to_string(std::abs(exponent));
    return joined(digits.substr(0, 1), digits.size() > 1 ? "." : "", digits.substr(1), exponent < 0 ? "e-" : "e+",
                  power.size() < 2 ? "0" : "", power);
}
/// Without an exponent; `number` is that of the digits.
std::string fixed(double number, const decimal::Digits& rounded) {
    const auto& [digits, exponent] = rounded;
    if (exponent < 0) return joined("0.", std::string(std::size_t(-exponent - 1), '0'), digits);
    const auto whole = std::size_t(exponent) + 1;
    if (whole >= digits.size()) return decimal::round(number, exponent + 1).digits;
    return joined(digits.substr(0, whole), ".", digits.substr(whole));
}
std::string not_finite(double number) {
    return std::isnan(number) ? "nan" : number < 0 ? "-inf" : "inf";
}

#if defined(SINEW_SMALL)
/// Shortest text that parses back, as std::to_chars writes it, whose tables take 110 KB.
std::string shortest(double number) {
    if (!std::isfinite(number)) return not_finite(number);
    const double size = std::abs(number);
    decimal::Digits digits;
    for (int count = 1; count <= 17; ++count) {
        digits = decimal::round(size, count);
        if (decimal::parse(scientific(digits)) == size) break;
    }
    const auto one = scientific(digits), other = fixed(size, digits);
    return joined(std::signbit(number) ? "-" : "", other.size() <= one.size() ? other : one);
}
#else
std::string shortest(double number) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}
#endif

} // namespace

std::string number_text(double number) {
    const auto text = shortest(number);
    const auto exponent = text.find('e');
    if (exponent == std::string::npos) return text;
    // std::to_chars writes 1e+06 and 1e-06; common notation is 1e6 and 1e-6.
    const bool negative = text[exponent + 1] == '-';
    const auto value = text.substr(text.find_first_not_of("+-0", exponent + 1));
    return joined(text.substr(0, exponent), negative ? "e-" : "e", value);
}

std::string number_text(double number, int digits) {
    if (!std::isfinite(number)) return not_finite(number);
    const double size = std::abs(number);
    auto rounded = decimal::round(size, digits);
    const bool is_fixed = rounded.exponent >= -4 && rounded.exponent < digits;
    while (rounded.digits.size() > 1 && rounded.digits.back() == '0' &&
           (!is_fixed || int(rounded.digits.size()) > rounded.exponent + 1))
        rounded.digits.pop_back();
    return joined(std::signbit(number) ? "-" : "", is_fixed ? fixed(size, rounded) : scientific(rounded));
}

namespace detail {

std::string FormatPart::text(int digits) const {
    switch (type_) {
    case Type::text:
        return std::string(text_);
    case Type::integer:
        return std::to_string(integer_);
    case Type::natural:
        return std::to_string(natural_);
    default:
        return digits > 0 ? number_text(number_, digits) : number_text(number_);
    }
}

std::string format_parts(std::string_view text, std::span<const FormatPart> parts) {
    std::string out;
    for (const auto& part : parts) {
        const auto hole = text.find('{'), end = text.find('}', hole);
        out += text.substr(0, hole);
        out += part.text(end > hole + 2 ? text[hole + 2] - '0' : 0);
        text.remove_prefix(end + 1);
    }
    return out += text;
}

} // namespace detail
} // namespace sinew
