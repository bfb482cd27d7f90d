#pragma once

#include "sinew/scene/diagnostic.h"
#include "sinew/scene/limits.h"

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

/// JSON values that keep the order of members and the source span of every value and key.
namespace sinew::json {

struct Value;
struct Member;
using Null = std::monostate;
using Array = std::vector<Value>;
using Object = std::vector<Member>; ///< in document order, without duplicate keys

struct Number {
    double value = 0;
    std::optional<std::int64_t> integer; ///< exact value of a whole number that fits 64 bits: 7, 1e9 and 3.0, not 3.5
    friend constexpr bool operator==(const Number&, const Number&) = default;
};

struct Value {
    std::variant<Null, bool, Number, std::string, Array, Object> data;
    Span span;

    Value();
    Value(bool truth);
    Value(Number number);
    Value(double number);
    Value(std::string text);
    Value(std::string_view text);
    Value(const char* text);
    Value(Array items);
    Value(Object members);
    template <std::integral I>
    requires(!std::same_as<I, bool>) Value(I number);

    template <class T> const T* as() const { return std::get_if<T>(&data); }
    template <class T> T* as() { return std::get_if<T>(&data); }
    bool is_null() const { return std::holds_alternative<Null>(data); }

    /// Equality of values; spans are ignored.
    friend bool operator==(const Value& a, const Value& b);
};

struct Member {
    std::string key;
    Value value;
    Span key_span = {};
    friend bool operator==(const Member& a, const Member& b) { return a.key == b.key && a.value == b.value; }
};

// Defined here, where Member is a complete type.
inline Value::Value() = default;
inline Value::Value(bool truth) : data(truth) {}
inline Value::Value(Number number) : data(number) {}
template <std::integral I>
requires(!std::same_as<I, bool>) Value::Value(I number) : data(Number{double(number), std::int64_t(number)}) {}
inline Value::Value(std::string text) : data(std::move(text)) {}
inline Value::Value(std::string_view text) : data(std::string(text)) {}
inline Value::Value(const char* text) : data(std::string(text)) {}
inline Value::Value(Array items) : data(std::move(items)) {}
inline Value::Value(Object members) : data(std::move(members)) {}
inline bool operator==(const Value& a, const Value& b) {
    return a.data == b.data;
}

/// The member with that key, or null.
const Member* find(const Object& object, std::string_view key);
Member* find(Object& object, std::string_view key);

/// The value at a JSON pointer (RFC 6901) such as "/figures/0/name", or null.
const Value* find(const Value& root, std::string_view pointer);

/// `key` as one step of a JSON pointer, including the leading slash.
std::string pointer_step(std::string_view key);

/// Parses a source of the diagnostics: JSON with // and /* */ comments. Errors are reported to the diagnostics. Returns
/// nothing if the text is no JSON or exceeds a limit.
std::optional<Value> parse(std::uint32_t source, Diagnostics& diagnostics, const Limits& limits = {});

/// Formats a value as JSON text; short arrays and objects stay on one line.
std::string to_text(const Value& value);

/// Describes a value for a message: `the number 3`, `the string "abc"`, `an array of 2`.
std::string describe(const Value& value);

} // namespace sinew::json
