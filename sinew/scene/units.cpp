#include "sinew/scene/units.h"

#include "sinew/math/decimal.h"
#include "sinew/math/scalar.h"
#include "sinew/scene/text.h"

#include <cstdint>
#include <cstdlib>

namespace sinew {
namespace {

double power(double base, int exponent) {
    double product = 1;
    for (int i = 0; i < std::abs(exponent); ++i) product *= base;
    return exponent < 0 ? 1 / product : product;
}

std::string with_exponent(std::string_view name, int exponent) {
    return exponent == 1 ? std::string(name) : concat(name, "^", exponent);
}

} // namespace

double rounded(double number) {
    if (!is_finite(number)) return number;
    const auto text = decimal::round(absolute(number), 15);
    std::int64_t digits = 0;
    for (const char c : text.digits) digits = 10 * digits + (c - '0');
    const int exponent = text.exponent - 14;
    // For |exponent| <= 22 both the digits and the power of ten are exact in double, so the quotient or product is the
    // nearest double.
    if (std::abs(exponent) > 22) return number;
    const double size = exponent < 0 ? double(digits) / power(10, -exponent) : double(digits) * power(10, exponent);
    return number < 0 ? -size : size;
}

double Units::scale(Unit unit) const {
    return power(per_metre, unit.length) * power(per_kilogram, unit.mass) * power(per_second, unit.time);
}

std::string Units::text(Unit unit) const {
    struct Part {
        std::string_view name;
        int exponent;
    };
    const std::array<Part, 4> parts = {
        {{mass, unit.mass}, {length, unit.length}, {"degrees", unit.angle ? 1 : 0}, {time, unit.time}}};
    std::string above, below;
    for (const auto& [name, exponent] : parts) {
        if (exponent > 0) above += concat(above.empty() ? "" : " ", with_exponent(name, exponent));
        if (exponent < 0) below += concat("/", with_exponent(name, -exponent));
    }
    return concat(above.empty() && !below.empty() ? "1" : "", above, below);
}

double in_file(Unit unit) {
    return unit.angle ? 180 / pi<double> : 1;
}

double in_program(Unit unit) {
    return unit.angle ? pi<double> / 180 : 1;
}

Range range_in_file(const Field& field, const Units& units) {
    const double factor = units.scale(field.unit) * in_file(field.unit);
    return {rounded(field.low * factor), rounded(field.high * factor)};
}

std::string range_text(const Range& range) {
    if (is_finite(range.low) && is_finite(range.high)) {
        if (range.low == range.high) return concat("equal to ", number_text(range.low));
        return concat("from ", number_text(range.low), " to ", number_text(range.high));
    }
    if (is_finite(range.low)) return concat("of at least ", number_text(range.low));
    if (is_finite(range.high)) return concat("of at most ", number_text(range.high));
    return {};
}

} // namespace sinew
