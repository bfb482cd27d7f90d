#pragma once

#include "sinew/scene/json.h"

#include "files/in/import.h"
#include "files/in/text_place.h"

#include <functional>
#include <memory>

namespace sinew::files {

/// A JSON text read within the limits of imports, and where each value is.
class JsonFile {
  public:
    /// Throws ImportError with the first mistake.
    JsonFile(std::string name, std::string text);
    const json::Value& root() const { return root_; }
    /// Line and column of a value: "12:5".
    std::string place_of(const json::Value& value) const;

  private:
    TextPlaces places_;
    json::Value root_;
};

/// A value of a JSON file by its path; reading throws ImportError with line, column and path. A missing member is a
/// node without a value.
class JsonNode {
  public:
    JsonNode(const JsonFile& file) : file_(&file), value_(&file.root()) {} // NOLINT

    bool exists() const { return value_ != nullptr && !value_->is_null(); }
    /// "12:5 (/nodes/3)"
    std::string place() const;
    [[noreturn]] void fail(const std::string& message) const;

    JsonNode operator[](std::string_view key) const;
    JsonNode operator[](std::size_t index) const;
    /// Number of items; 0 for what does not exist. Throws for anything but an array.
    std::size_t size() const;
    const json::Object* object() const { return exists() ? value_->as<json::Object>() : nullptr; }
    const json::Value* value() const { return value_; }

    double number() const;
    double number_or(double usual) const { return exists() ? number() : usual; }
    /// A whole number from 0 to `max`.
    std::size_t index(std::size_t max = 0xffffffff) const;
    std::string text() const;
    std::string text_or(std::string_view usual) const { return exists() ? text() : std::string(usual); }
    bool truth_or(bool usual) const;
    /// So many numbers.
    std::vector<double> numbers(std::size_t count) const;

  private:
    JsonNode(const JsonFile* file, const json::Value* value, std::string path, const json::Value* parent)
        : file_(file), value_(value), parent_(parent), path_(std::move(path)) {}

    const JsonFile* file_;
    const json::Value* value_;
    const json::Value* parent_ = nullptr; ///< whose place stands for that of a missing value
    std::string path_;
};

} // namespace sinew::files
