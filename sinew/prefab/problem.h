#pragma once

#include "sinew/math/limit.h"
#include "sinew/math/record.h"
#include "sinew/world/edit.h"

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Reasons why a prefab cannot be built with its parameters, for programs; a scene's reader has messages with places.
namespace sinew {

namespace detail {

std::optional<std::string> problem_of(const Field& field, double value);
std::optional<std::string> problem_of(const Field& field, std::string_view word);
std::optional<std::string> problem_of_sizes(const Sizes& sizes);
/// Reason why particles would be lighter than a particle can be.
std::optional<std::string> problem_of_mass(double mass, std::size_t particles);

template <class Member> std::optional<std::string> problem_of_member(const Field& field, const Member& member) {
    if constexpr (std::is_same_v<Member, std::string>)
        return problem_of(field, std::string_view(member));
    else if constexpr (std::is_arithmetic_v<Member> && !std::is_same_v<Member, bool>)
        return problem_of(field, double(member));
    else if constexpr (std::is_same_v<Member, std::optional<double>>)
        return member ? problem_of(field, *member) : std::nullopt;
    else if constexpr (std::is_same_v<Member, std::vector<double>>)
        for (const double each : member)
            if (auto problem = problem_of(field, each)) return problem;
    return std::nullopt;
}

} // namespace detail

/// The first parameter that is out of its range or no word of its list; nothing if all are right.
template <class Prefab> std::optional<std::string> problem_of_parameters(const Prefab& prefab) {
    std::optional<std::string> problem;
    Prefab::fields(prefab, [&](const auto& member, const Field& field) {
        if (!problem) problem = detail::problem_of_member(field, member);
    });
    return problem;
}

/// Reason why a prefab cannot be built in a world of that dimension: a parameter, parameters that do not go together,
/// too many particles, or too light ones. Ranges are those of the fields, in metres, kilograms, seconds and radians.
template <class Prefab> std::optional<std::string> problem_of_all(const Prefab& prefab, int dimension) {
    if (auto problem = problem_of_parameters(prefab)) return problem;
    if constexpr (requires { prefab.problem(dimension); })
        if (auto problem = prefab.problem(dimension)) return problem;
    if (auto problem = detail::problem_of_sizes(prefab.sizes())) return problem;
    if constexpr (requires { prefab.mass; }) return detail::problem_of_mass(prefab.mass, prefab.sizes().particles);
    return std::nullopt;
}

} // namespace sinew
