#pragma once

#include <concepts>
#include <limits>
#include <span>
#include <string_view>

/// A record is a struct that states once the names, units and valid ranges of its fields:
///
///     struct Rope {
///         int segments = 20;
///         template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
///             visit(self.segments, Field{.name = "segments", .help = "Number of links", .low = 1, .high = 100000});
///         }
///     };
///
/// Scene reading, range checks, `sinew describe`, the JSON Schema, sliders and web forms all walk `fields`. The default
/// of a field is its member initialiser.
namespace sinew {

/// Unit of a number, as powers of length, mass and time. A file states numbers in the units its scene declares.
struct Unit {
    int length = 0, mass = 0, time = 0;
    bool angle = false; ///< degrees in a file, radians in the program
    friend constexpr bool operator==(const Unit&, const Unit&) = default;
};

namespace unit {
inline constexpr Unit none{};
inline constexpr Unit length{.length = 1};
inline constexpr Unit mass{.mass = 1};
inline constexpr Unit time{.time = 1};
inline constexpr Unit angle{.angle = true};
inline constexpr Unit per_time{.time = -1};
inline constexpr Unit spin{.time = -1, .angle = true};
inline constexpr Unit speed{.length = 1, .time = -1};
inline constexpr Unit acceleration{.length = 1, .time = -2};
inline constexpr Unit force{.length = 1, .mass = 1, .time = -2};
inline constexpr Unit impulse{.length = 1, .mass = 1, .time = -1};
inline constexpr Unit drag{.mass = 1, .time = -1}; ///< force / speed
inline constexpr Unit density{.length = -3, .mass = 1};
inline constexpr Unit compliance{.mass = -1, .time = 2}; ///< length / force: 1/k of a spring
} // namespace unit

struct Field {
    std::string_view name = {};
    std::string_view help = {}; ///< a single line
    Unit unit = {};
    double low = -std::numeric_limits<double>::infinity(); ///< lowest value allowed, in SI units and radians
    double high = std::numeric_limits<double>::infinity();
    std::span<const std::string_view> choices = {}; ///< the words a string field allows; empty allows any
    bool required = false;
};

namespace detail {
struct AnyVisit {
    template <class T> void operator()(T&, const Field&) const {}
};
} // namespace detail

template <class T>
concept Record = requires(T& record) {
    T::fields(record, detail::AnyVisit{});
};

} // namespace sinew
