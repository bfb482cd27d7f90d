#pragma once

#include "sinew/prefab/prefabs.h"

#include "tests/dice.h"
#include "tests/prefab/make.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

/// Figures of any kind with any parameters, for laws that hold for all of them.
namespace sinew::test {

/// Any value that a field allows: compliances from 0 and 1e-9 to 1, masses over six decades, lengths of one figure
/// over one decade around a common size, counts as a test has time for. A third of the fields keep their defaults.
struct AnyParameter {
    Dice& dice;
    int max_count;
    double size; ///< metres

    void operator()(int& value, const Field& field) const {
        if (dice.one_of(3)) return;
        const double low = std::max(field.low, 1.0);
        value = int(dice.scale(low, std::max(low, std::min(field.high, double(max_count))) + 0.99));
    }
    void operator()(double& value, const Field& field) const {
        const bool stays = dice.one_of(3);
        if (field.unit == unit::length)
            value *= size * (stays ? 1 : dice.scale(0.3, 3));
        else if (stays)
            return;
        else if (field.unit == unit::mass)
            value = std::max(value, 1e-3) * dice.scale(1e-3, 1e3);
        else if (field.unit == unit::compliance)
            value = dice.one_of(4) ? 0 : dice.scale(1e-9, 1);
        else
            value = any_of(field);
        value = std::clamp(value, field.low, field.high);
    }
    double any_of(const Field& field) const {
        constexpr double smallest = 1e-3, largest = 1e3;
        if (field.low <= 0 && dice.one_of(3)) return std::max(field.low, 0.0);
        const double value = dice.scale(std::max(field.low, smallest), std::min(field.high, largest));
        return field.low < 0 && dice.one_of(2) ? -value : value;
    }
    void operator()(bool& value, const Field&) const { value = dice.one_of(2); }
    void operator()(std::string& value, const Field& field) const {
        if (!field.choices.empty()) value = field.choices[std::size_t(dice.below(int(field.choices.size())))];
    }
    void operator()(std::vector<double>&, const Field&) const {}
};

/// Sets any parameters that a prefab allows together, of a common size in metres; false if fifty draws find none.
template <class Prefab>
bool draw(Prefab& prefab, Dice& dice, int dimension, int max_count, double smallest = 0.1, double largest = 10) {
    for (int tries = 0; tries <= 50; ++tries) {
        prefab = {};
        Prefab::fields(prefab, AnyParameter{dice, max_count, dice.scale(smallest, largest)});
        if (!problem_of(prefab, dimension)) return true;
    }
    return false;
}

template <class Prefab> std::string description_of(const Prefab& prefab) {
    std::ostringstream text;
    text << Prefab::name;
    Prefab::fields(const_cast<Prefab&>(prefab), [&](auto& member, const Field& field) {
        if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(member)>> ||
                      std::is_same_v<std::remove_cvref_t<decltype(member)>, std::string>)
            text << ' ' << field.name << '=' << member;
    });
    return text.str();
}

} // namespace sinew::test
