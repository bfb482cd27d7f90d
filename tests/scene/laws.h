#pragma once

#include "sinew/scene/json.h"
#include "sinew/scene/types.h"

#include <algorithm>
#include <string_view>
#include <vector>

/// What every record has to satisfy.
namespace sinew::laws {

/// Whether no two things that can stand in one object of the record have the same name: its own fields, and with each
/// alternative of a variant, that alternative's.
template <Record R> bool each_key_once(std::vector<std::string_view> around = {}) {
    bool once = true;
    R record;
    R::fields(record, [&](auto&, const Field& field) {
        if (!field.name.empty()) around.push_back(field.name);
    });
    R::fields(record, [&](auto& member, const Field&) {
        using T = std::remove_cvref_t<decltype(member)>;
        if constexpr (detail::is_variant<T>)
            detail::each_alternative(std::type_identity<T>{},
                                     [&]<class A>(std::type_identity<A>) { once = once && each_key_once<A>(around); });
    });
    std::sort(around.begin(), around.end());
    return once && std::adjacent_find(around.begin(), around.end()) == around.end();
}

/// Calls visit(value) for the value and all in it.
template <class Visit> void each_value(const json::Value& value, const Visit& visit) {
    visit(value);
    if (const auto* items = value.as<json::Array>())
        for (const auto& item : *items) each_value(item, visit);
    if (const auto* members = value.as<json::Object>())
        for (const auto& member : *members) each_value(member.value, visit);
}

} // namespace sinew::laws
