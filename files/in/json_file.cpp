#include "files/in/json_file.h"

#include "sinew/scene/diagnostic.h"
#include "sinew/scene/text.h"

namespace sinew::files {

JsonFile::JsonFile(std::string name, std::string text) : places_(text) {
    Diagnostics diagnostics;
    constexpr std::int64_t most_values = 2'000'000;
    Limits limits;
    limits.values = most_values;
    limits.string_bytes = limits.bytes; // buffers and layers are strings
    const auto source = diagnostics.add_source(std::move(name), std::move(text));
    auto root = json::parse(source, diagnostics, limits);
    if (!diagnostics.ok()) {
        const auto first = diagnostics.in_order().front();
        const auto [line, column] = sinew::place_of(diagnostics, first.span);
        throw ImportError{concat(line, ":", column), first.message, first.help};
    }
    root_ = std::move(*root);
}

std::string JsonFile::place_of(const json::Value& value) const {
    return places_.at(value.span.begin);
}

std::string JsonNode::place() const {
    const auto* const known = value_ ? value_ : parent_;
    const auto where = known ? file_->place_of(*known) : std::string("1:1");
    return path_.empty() ? where : concat(where, " (", printable(path_), ")");
}

void JsonNode::fail(const std::string& message) const {
    throw ImportError{place(), message};
}

JsonNode JsonNode::operator[](std::string_view key) const {
    const auto* const members = object();
    const auto* const found = members ? json::find(*members, key) : nullptr;
    return {file_, found ? &found->value : nullptr, path_ + json::pointer_step(key), value_ ? value_ : parent_};
}

JsonNode JsonNode::operator[](std::size_t index) const {
    const auto* const items = exists() ? value_->as<json::Array>() : nullptr;
    return {file_, items && index < items->size() ? &(*items)[index] : nullptr, concat(path_, "/", index),
            value_ ? value_ : parent_};
}

std::size_t JsonNode::size() const {
    if (!exists()) return 0;
    if (const auto* items = value_->as<json::Array>()) return items->size();
    fail(concat("expected an array, found ", json::describe(*value_)));
}

double JsonNode::number() const {
    if (!exists()) fail("a number is missing here");
    if (const auto* number = value_->as<json::Number>()) return number->value;
    fail(concat("expected a number, found ", json::describe(*value_)));
}

std::size_t JsonNode::index(std::size_t max) const {
    if (!exists()) fail("a number is missing here");
    const auto* const number = value_->as<json::Number>();
    if (!number || !number->integer || *number->integer < 0 || std::uint64_t(*number->integer) > max)
        fail(concat("expected a whole number from 0 to ", max, ", found ", json::describe(*value_)));
    return std::size_t(*number->integer);
}

std::string JsonNode::text() const {
    if (!exists()) fail("a text is missing here");
    if (const auto* text = value_->as<std::string>()) return *text;
    fail(concat("expected a text, found ", json::describe(*value_)));
}

bool JsonNode::truth_or(bool usual) const {
    if (!exists()) return usual;
    if (const auto* truth = value_->as<bool>()) return *truth;
    fail(concat("expected true or false, found ", json::describe(*value_)));
}

std::vector<double> JsonNode::numbers(std::size_t count) const {
    if (size() != count) fail(concat("expected ", count, " numbers, found ", size()));
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back((*this)[i].number());
    return numbers;
}

} // namespace sinew::files
