#pragma once

#include <string>
#include <string_view>

/// Decimal numbers to and from binary ones, exactly: a few hundred bytes of code in place of the C library's, for a
/// small module. Results are those of std::strtod and of printf's %e.
namespace sinew::decimal {

/// The number nearest to a text of digits with an optional sign, point and exponent ("-1.5e3"), ties to even; infinite
/// if too large.
double parse(std::string_view text);

/// Significant digits of a number, and its power of ten: d.ddd * 10^exponent.
struct Digits {
    std::string digits;
    int exponent = 0;
};
/// The number, finite and at least 0, rounded to `count` >= 1 digits, ties to even.
Digits round(double number, int count);

} // namespace sinew::decimal
