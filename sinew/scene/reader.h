#pragma once

#include "sinew/scene/diagnostic.h"
#include "sinew/scene/json.h"
#include "sinew/scene/layout.h"
#include "sinew/scene/types.h"
#include "sinew/scene/units.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Fills records from JSON by walking their `fields`. Reading continues after an error, so one run reports all errors;
/// a value with an error keeps its default.
namespace sinew {

/// State shared while one scene is read.
struct Reading {
    Diagnostics& diagnostics;
    int dimension = 2;
    Units units = {};
    mutable std::int64_t memory = Limits{}.memory; ///< remaining bytes for lists
    /// Full paths at which a misplaced key of an override is allowed.
    std::function<std::vector<std::string>(std::string_view key)> elsewhere = {};
    /// Full paths at which a misplaced key of a file is allowed, outside of lists: "world.gravity".
    std::function<std::vector<std::string>(std::string_view key)> in_sections = {};
    /// Full paths at which a misplaced key of a file is allowed, in the records around a place.
    std::function<std::vector<std::string>(std::string_view place, std::string_view key)> around = {};
};

/// Position of the reader in the document: a linked list on the stack, converted to text only for a message.
class Path {
  public:
    Path() = default;
    Path(const Path& parent, std::string_view key) : parent_(&parent), key_(key) {}
    Path(const Path& parent, std::size_t index) : parent_(&parent), index_(index), is_index_(true) {}
    Path(Path&& parent, std::string_view key) = delete; // the parent must outlive the path
    Path(Path&& parent, std::size_t index) = delete;
    /// The path as a JSON pointer.
    std::string text() const;

  private:
    const Path* parent_ = nullptr;
    std::string_view key_;
    std::size_t index_ = 0;
    bool is_index_ = false;
};

namespace detail {

/// Reports "expected ..., found ..."; always returns false.
bool refuse(const json::Value& value, const Field& field, const Path& path, const Reading& in,
            std::string_view expected);
bool read_truth(const json::Value& value, bool& target, const Field& field, const Path& path, const Reading& in);
bool read_number(const json::Value& value, double& target, const Field& field, const Path& path, const Reading& in);
bool read_integer(const json::Value& value, std::int64_t& target, Range range, const Field& field, const Path& path,
                  const Reading& in);
bool read_string(const json::Value& value, std::string& target, const Field& field, const Path& path,
                 const Reading& in);
/// The array if the value is one with `size` items; otherwise null, with an error reported.
const json::Array* array_of(const json::Value& value, std::size_t size, const Field& field, const Path& path,
                            const Reading& in);

void report_missing(const json::Value& object, const Field& field, const Path& path, const Reading& in);
/// Reports unknown keys; true if there was one.
bool report_unknown(const json::Object& object, const std::vector<std::string_view>& allowed, const Path& path,
                    const Reading& in);

/// Reserves memory for `count` elements, or reports an error and returns false.
bool take_memory(const json::Value& list, std::size_t count, std::size_t bytes_each, const Path& path,
                 const Reading& in);

/// Alternatives of a variant field, as named in files.
struct Alternatives {
    std::span<const std::string_view> names;
    const Field& field;
};
/// Index of the alternative an object selects, `none` if the object selects none, or `wrong` after an error was
/// reported.
inline constexpr std::size_t none = std::size_t(-1), wrong = std::size_t(-2);
std::size_t choose(const json::Value& value, const Alternatives& alternatives, const Path& path, const Reading& in);

/// Reads the fields of one object into a record, including the fields of selected alternatives, and collects the names
/// allowed in the object.
class FieldReader {
  public:
    FieldReader(const json::Value& value, const json::Object& object, const Path& path, const Reading& in)
        : value_(value), object_(object), path_(path), in_(in) {}

    void read_fields(AnyRecord record);
    /// Reads a field of a record.
    template <class T> static void read_member(FieldReader& reader, void* member, const Field& field) {
        if constexpr (is_variant<T>)
            reader.read_variant(*static_cast<T*>(member), field);
        else
            reader.read_field(*static_cast<T*>(member), field);
    }
    /// Reports members that no field has read. True if the whole object is valid.
    bool finish();

  private:
    template <class T> void read_field(T& target, const Field& field);
    /// Value of a field in the object, or null.
    const json::Value* taken(const Field& field);
    template <class T> void read_variant(T& target, const Field& field);

    /// Allows the names of all alternatives of a variant, when the selected one is unknown.
    template <class T> void allow_all();
    /// Adds an allowed name. Names are used in messages only, so none are added once no more messages are stored.
    void allow(std::string_view name) {
        if (!in_.diagnostics.full()) allowed_.push_back(name);
    }

    const json::Value& value_;
    const json::Object& object_;
    const Path& path_;
    const Reading& in_;
    std::vector<std::string_view> allowed_;
    std::size_t taken_ = 0;
    bool good_ = true;
};

} // namespace detail

/// Reads a value into any type a field can have (types.h). Returns false if there was an error, reported to the
/// diagnostics.
template <class T>
bool read(const json::Value& value, T& target, const Field& field, const Path& path, const Reading& in);

namespace detail {

template <Integer T>
bool read_whole(const json::Value& value, T& target, const Field& field, const Path& path, const Reading& in) {
    static_assert(sizeof(T) < 8 || std::signed_integral<T>, "numbers of JSON are read as 64 bits with a sign");
    Range range = range_in_file(field, in.units);
    if constexpr (sizeof(T) < 8) {
        range.low = max(range.low, double(std::numeric_limits<T>::min()));
        range.high = min(range.high, double(std::numeric_limits<T>::max()));
    }
    std::int64_t number = 0;
    if (!read_integer(value, number, range, field, path, in)) return false;
    target = T(number);
    return true;
}

/// Reads an array of exactly `size` items into the elements of an array.
template <class Elements>
bool read_elements(const json::Value& value, Elements& elements, std::size_t size, const Field& field, const Path& path,
                   const Reading& in) {
    const auto* items = array_of(value, size, field, path, in);
    if (!items) return false;
    bool good = true;
    for (std::size_t i = 0; i < items->size(); ++i)
        good &= read((*items)[i], elements[i], element_of(field), Path(path, i), in);
    return good;
}

/// Reads an object into a map from names to values.
template <class T>
bool read_map(const json::Value& value, T& target, const Field& field, const Path& path, const Reading& in) {
    const auto* members = value.as<json::Object>();
    if (!members) return refuse(value, field, path, in, "an object");
    if (!take_memory(value, members->size(), sizeof(target[0]), path, in)) return false;
    target.clear();
    target.reserve(members->size());
    bool good = true;
    for (const auto& [key, item, span] : *members) {
        target.emplace_back(key, fresh<typename T::value_type::second_type>(field, in.units));
        good &= read(item, target.back().second, element_of(field), Path(path, key), in);
    }
    return good;
}

/// Reads an array of any length.
template <class T>
bool read_list(const json::Value& value, T& target, const Field& field, const Path& path, const Reading& in) {
    static_assert(!std::same_as<T, std::vector<bool>>, "a vector of bool has no elements to read into");
    const auto* items = value.as<json::Array>();
    if (!items) return refuse(value, field, path, in, "an array");
    if (!take_memory(value, items->size(), sizeof(target[0]), path, in)) return false;
    target.clear();
    target.reserve(items->size());
    bool good = true;
    for (std::size_t i = 0; i < items->size(); ++i) {
        target.push_back(fresh<typename T::value_type>(field, in.units));
        good &= read((*items)[i], target.back(), element_of(field), Path(path, i), in);
    }
    return good;
}

template <Record R>
bool read_object(const json::Value& value, R& target, const Field& field, const Path& path, const Reading& in) {
    const auto* object = value.as<json::Object>();
    if (!object) return refuse(value, field, path, in, "an object");
    FieldReader reader(value, *object, path, in);
    reader.read_fields(AnyRecord::of(target));
    return reader.finish();
}

} // namespace detail

template <class T>
bool read(const json::Value& value, T& target, const Field& field, const Path& path, const Reading& in) {
    using namespace detail;
    if constexpr (std::same_as<T, bool>) {
        return read_truth(value, target, field, path, in);
    } else if constexpr (Integer<T>) {
        return read_whole(value, target, field, path, in);
    } else if constexpr (std::floating_point<T>) {
        double number = 0;
        if (!read_number(value, number, field, path, in)) return false;
        target = T(number);
        return true;
    } else if constexpr (std::same_as<T, std::string>) {
        return read_string(value, target, field, path, in);
    } else if constexpr (std::same_as<T, json::Value>) {
        target = value;
        return true;
    } else if constexpr (std::same_as<T, Point>) {
        return read_elements(value, target.component, std::size_t(in.dimension), field, path, in);
    } else if constexpr (array_size<T> > 0) {
        return read_elements(value, elements(target), array_size<T>, field, path, in);
    } else if constexpr (is_map<T>) {
        return read_map(value, target, field, path, in);
    } else if constexpr (is_vector<T>) {
        return read_list(value, target, field, path, in);
    } else if constexpr (is_optional<T>) {
        if (!target) target = fresh<typename T::value_type>(field, in.units);
        return read(value, *target, field, path, in);
    } else {
        static_assert(Record<T>, "types.h lists what a field can be");
        return read_object(value, target, field, path, in);
    }
}

/// Reads a whole record, with defaults converted to the units of the scene.
template <Record R> bool read(const json::Value& value, R& record, const Reading& in) {
    record = detail::fresh<R>({}, in.units);
    return read(value, record, Field{}, Path{}, in);
}

namespace detail {

template <class T> void FieldReader::read_field(T& target, const Field& field) {
    if (const auto* value = taken(field)) good_ &= read(*value, target, field, Path(path_, field.name), in_);
}

template <class T> void FieldReader::read_variant(T& target, const Field& field) {
    const Alternatives alternatives{alternative_names<T>, field};
    if (!field.name.empty()) {
        allow(field.name);
        if (json::find(object_, field.name)) ++taken_;
    }

    const auto chosen = choose(value_, alternatives, path_, in_);
    good_ &= chosen != wrong;
    if (chosen == none) {
        if (field.name.empty())
            for (const auto name : alternatives.names) allow(name);
        return visit_held(target, [&](auto& record) { this->read_fields(AnyRecord::of(record)); });
    }
    if (chosen == wrong) return allow_all<T>();
    std::size_t index = 0;
    each_alternative(std::type_identity<T>{}, [&]<class A>(std::type_identity<A>) {
        if (index++ != chosen) return;
        auto record = fresh<A>({}, in_.units);
        this->read_fields(AnyRecord::of(record));
        target = std::move(record);
    });
}

template <class T> void FieldReader::allow_all() {
    if (in_.diagnostics.full())
        taken_ = object_.size();
    else
        each_alternative(std::type_identity<T>{}, [&]<class A>(std::type_identity<A>) {
            for (const auto name : names_of<A>()) allow(name);
        });
}

template <class T> constexpr FieldType make_field_type() {
    FieldType type{[](void* member, const Field& field, const Units& units) {
                       scale_defaults(*static_cast<T*>(member), field, units);
                   },
                   [](const void* member, const Field& field, const Writing& out) {
                       return write_if_present(*static_cast<const T*>(member), field, out);
                   },
                   nullptr,
                   FieldReader::read_member<T>,
                   [](const void* member, const Field& field, Layout& part) {
                       part = layout_of(*static_cast<const T*>(member), field);
                   },
                   nullptr};
    if constexpr (is_variant<T>) {
        type.write_held = [](const void* member, const Field& field, json::Object& object, const Writing& out) {
            write_alternative(*static_cast<const T*>(member), field, object, out);
        };
        type.add_names = [](std::vector<std::string_view>& names) {
            each_alternative(std::type_identity<T>{}, [&]<class A>(std::type_identity<A>) {
                for (const auto name : names_of<A>()) names.push_back(name);
            });
        };
    }
    return type;
}
template <class T> const FieldType& field_type() {
    static constexpr FieldType type = make_field_type<T>();
    return type;
}

} // namespace detail

} // namespace sinew
