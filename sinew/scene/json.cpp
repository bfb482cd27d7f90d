#include "sinew/scene/json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace sinew::json {
namespace {

std::optional<std::int64_t> whole(double number) {
    constexpr double limit = 9223372036854775808.0; // 2^63
    if (!(number >= -limit && number < limit) || std::trunc(number) != number) return {};
    return std::int64_t(number);
}

} // namespace

/// Negative zero is zero, as the text of a value has no other.
Value::Value(double number) : data(Number{number + 0.0, whole(number)}) {}

const Member* find(const Object& object, std::string_view key) {
    const auto found = std::ranges::find(object, key, &Member::key);
    return found == object.end() ? nullptr : &*found;
}

Member* find(Object& object, std::string_view key) {
    return const_cast<Member*>(find(std::as_const(object), key));
}

namespace {

/// The key that a step of a JSON pointer stands for: ~1 is a slash, ~0 a tilde.
std::string key_of(std::string_view step) {
    std::string key;
    for (std::size_t i = 0; i < step.size(); ++i) {
        const auto rest = step.substr(i);
        if (rest.starts_with("~0") || rest.starts_with("~1"))
            key += step[++i] == '0' ? '~' : '/';
        else
            key += step[i];
    }
    return key;
}

const Value* element(const Array& items, std::string_view digits) {
    std::size_t index = 0;
    const auto [stop, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    const bool whole = problem == std::errc() && stop == digits.data() + digits.size();
    return whole && index < items.size() ? &items[index] : nullptr;
}

} // namespace

const Value* find(const Value& root, std::string_view pointer) {
    const Value* value = &root;
    while (value && !pointer.empty()) {
        if (pointer[0] != '/') return nullptr;
        const auto end = std::min(pointer.find('/', 1), pointer.size());
        const auto step = pointer.substr(1, end - 1);
        pointer.remove_prefix(end);
        const Member* member = nullptr;
        if (const auto* object = value->as<Object>()) member = find(*object, key_of(step));
        const auto* items = value->as<Array>();
        value = member ? &member->value : items ? element(*items, step) : nullptr;
    }
    return value;
}

std::string pointer_step(std::string_view key) {
    std::string step = "/";
    for (const char c : key) {
        if (c == '~')
            step += "~0";
        else if (c == '/')
            step += "~1";
        else
            step += c;
    }
    return step;
}

} // namespace sinew::json
