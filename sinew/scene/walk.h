#pragma once

#include "sinew/scene/json.h"
#include "sinew/scene/types.h"
#include "sinew/scene/units.h"

#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

/// Walk over the fields of a record whose type is known at run time only: compiled once for a record, whatever is done
/// with the fields.
namespace sinew {

struct Layout;
struct Writing;

namespace detail {

class FieldReader;

/// Operations on a field, by its type.
struct FieldType {
    void (*scale)(void* member, const Field& field, const Units& units);
    /// The value; nothing for an option that is absent, and for a variant.
    std::optional<json::Value> (*write)(const void* member, const Field& field, const Writing& out);
    /// Appends the tag and the fields of the alternative that a variant holds; null for other types.
    void (*write_held)(const void* member, const Field& field, json::Object& object, const Writing& out);
    void (*read)(FieldReader& reader, void* member, const Field& field);
    void (*describe)(const void* member, const Field& field, Layout& part);
    /// Appends the names of the fields of all alternatives of a variant; null for other types.
    void (*add_names)(std::vector<std::string_view>& names);
};
template <class T> const FieldType& field_type(); // reader.h

/// Reference to a function visit(member, type, field).
class FieldVisit {
  public:
    template <class Visit>
    requires(!std::is_same_v<std::remove_cvref_t<Visit>, FieldVisit>)
        FieldVisit(Visit&& visit) // NOLINT: a lambda is a visit
        : context_(&visit), call_([](void* context, void* member, const FieldType& type, const Field& field) {
              (*static_cast<std::remove_reference_t<Visit>*>(context))(member, type, field);
          }) {}

    void operator()(void* member, const FieldType& type, const Field& field) const {
        call_(context_, member, type, field);
    }

  private:
    void* context_;
    void (*call_)(void*, void*, const FieldType&, const Field&);
};

template <Record R> void walk(void* record, const FieldVisit& visit) {
    R::fields(*static_cast<R*>(record), [&](auto& member, const Field& field) {
        visit(&member, field_type<std::remove_cvref_t<decltype(member)>>(), field);
    });
}

/// A record of any type.
struct AnyRecord {
    void* record;
    void (*fields)(void* record, const FieldVisit& visit);

    template <Record R> static AnyRecord of(R& record) { return {&record, walk<R>}; }
    void each(const FieldVisit& visit) const { fields(record, visit); }
};
/// A record whose fields are not changed by the visit.
template <Record R> AnyRecord unchanged(const R& record) {
    return AnyRecord::of(const_cast<R&>(record));
}

/// Appends the names of all keys that the object of a record may have.
void add_names(AnyRecord record, std::vector<std::string_view>& names);

} // namespace detail

/// Names of all keys the record's object may have: its fields and the fields of all alternatives.
template <Record R> std::vector<std::string_view> names_of() {
    std::vector<std::string_view> names;
    R record;
    detail::add_names(detail::AnyRecord::of(record), names);
    return names;
}

} // namespace sinew
