#include "player/grow.h"

#include "sinew/constraint/kind_table.h"

#include <algorithm>
#include <cstdlib>

namespace sinew::play {
namespace {

using json::Array;
using json::Object;
using json::Value;

double power_of(double base, int power) {
    double product = 1;
    for (int i = 0; i < std::abs(power); ++i) product *= base;
    return power < 0 ? 1 / product : product;
}

/// Makes lengths, areas and volumes of a record larger, those with default values too.
class Grower {
  public:
    Grower(double factor, const Units& units) : factor_(factor), units_(units) {}

    void record(Value& value, const Layout& layout) const {
        auto* object = value.as<Object>();
        if (!object) return;
        for (const auto& part : layout.parts) field(*object, part);
        constraint(*object, layout);
    }

  private:
    double factor_;
    Units units_;

    static bool is_size(const Unit& unit) { return unit.length != 0 && unit.mass == 0 && unit.time == 0; }

    void field(Object& object, const Layout& part) const {
        using Type = Layout::Type;
        const std::string name(part.field.name);
        if (name == "at" && part.type == Type::point && object_is_placed_) return;
        if (part.type == Type::choice) return alternative(object, part);
        auto* own = json::find(object, name);
        if (!own && part.type == Type::number && is_size(part.field.unit) && !part.optional)
            if (const auto* usual = part.usual.as<json::Number>(); usual && usual->value != 0) {
                object.push_back({name, Value(usual->value * units_.scale(part.field.unit))});
                own = &object.back();
            }
        if (own) grow(own->value, part);
    }

    void grow(Value& value, const Layout& part) const {
        using Type = Layout::Type;
        if (part.type == Type::record) return inner().record(value, part);
        if (part.type == Type::number && is_size(part.field.unit)) return times(value, part.field.unit.length);
        if (part.type == Type::point && is_size(part.field.unit)) {
            if (auto* items = value.as<Array>())
                for (auto& item : *items) times(item, part.field.unit.length);
            return;
        }
        if (part.parts.empty()) return;
        if (auto* items = value.as<Array>(); items && part.type == Type::list)
            for (auto& item : *items) inner().grow(item, part.parts[0]);
        if (auto* members = value.as<Object>(); members && part.type == Type::map)
            for (auto& member : *members) inner().grow(member.value, part.parts[0]);
    }

    void alternative(Object& object, const Layout& part) const {
        const auto* said = json::find(object, part.field.name);
        const auto* name = said ? said->value.as<std::string>() : nullptr;
        for (const auto& one : part.parts)
            if (name ? one.name == *name : &one == &part.parts[0])
                for (const auto& own : one.parts) inner().field(object, own);
    }

    /// Limits of a constraint have the unit of its kind.
    void constraint(Object& object, const Layout& layout) const {
        const auto is_limit = [](const Layout& part) { return part.field.name == "rest"; };
        if (std::ranges::none_of(layout.parts, is_limit)) return;
        const auto* said = json::find(object, "kind");
        const auto* kind = said ? said->value.as<std::string>() : nullptr;
        const auto info = kind_called(kind ? std::string_view(*kind) : "distance");
        for (const char* name : {"rest", "low", "high"})
            if (auto* own = json::find(object, name); own && info) times(own->value, info->length_power);
    }

    void times(Value& value, int power) const {
        if (const auto* number = value.as<json::Number>()) value = Value(number->value * power_of(factor_, power));
    }

    /// Grower of the inner records: an "at" there is a place in the figure.
    Grower inner() const {
        Grower grower = *this;
        grower.object_is_placed_ = false;
        return grower;
    }

    bool object_is_placed_ = true; ///< "at" of the record itself is moved, not scaled
};

} // namespace

void grow(json::Value& record, const Layout& layout, double factor, const Units& units) {
    Grower(factor, units).record(record, layout);
}

} // namespace sinew::play
