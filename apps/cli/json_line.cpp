#include "apps/cli/json_line.h"

#include "sinew/math/scalar.h"

namespace sinew::cli {
namespace {

void append(std::string& out, const json::Value& value) {
    const char* between = "";
    if (const auto* items = value.as<json::Array>()) {
        out += '[';
        for (const auto& item : *items) out += between, append(out, item), between = ", ";
        out += ']';
    } else if (const auto* members = value.as<json::Object>()) {
        out += '{';
        for (const auto& [key, item, span] : *members) {
            out += between + json::to_text(key) + ": ";
            append(out, item);
            between = ", ";
        }
        out += '}';
    } else {
        const auto* number = value.as<json::Number>();
        out += number && !is_finite(number->value) ? "null" : json::to_text(value);
    }
}

} // namespace

std::string to_line(const json::Value& value) {
    std::string out;
    append(out, value);
    return out += '\n';
}

} // namespace sinew::cli
