#include "sinew/scene/writer.h"

namespace sinew::detail {

void scale_record(AnyRecord record, const Units& units) {
    record.each([&](void* member, const FieldType& type, const Field& field) { type.scale(member, field, units); });
}

void add_names(AnyRecord record, std::vector<std::string_view>& names) {
    record.each([&](void*, const FieldType& type, const Field& field) {
        if (!field.name.empty()) names.push_back(field.name);
        if (type.add_names) type.add_names(names);
    });
}

void write_fields(json::Object& object, AnyRecord record, AnyRecord usual, std::string_view key, const Writing& out) {
    std::vector<std::optional<json::Value>> usual_values;
    usual.each([&](void* member, const FieldType& type, const Field& field) {
        usual_values.push_back(type.write(member, field, out));
    });
    std::size_t index = 0;
    record.each([&](void* member, const FieldType& type, const Field& field) {
        const auto& as_usual = usual_values[index++];
        if (type.write_held) return type.write_held(member, field, object, out);
        auto value = type.write(member, field, out);
        if (!value) return;
        const bool needed = out.defaults || field.required || (!key.empty() && field.name == key);
        if (needed || value != as_usual) object.push_back({std::string(field.name), std::move(*value)});
    });
}

} // namespace sinew::detail
