#pragma once

#include "sinew/math/point.h"
#include "sinew/math/record.h"
#include "sinew/math/scalar.h"

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

/// Drivers that move a pin: "driver" of an entry of "pins". All but the pointer are functions of time alone.
namespace sinew {

struct OrbitDriver {
    static constexpr std::string_view name = "orbit";
    static constexpr std::string_view about = "Circular motion around the held position, in the plane of the screen.";
    double radius = 1;
    double rate = pi<double>;
    double phase = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.radius,
              Field{.name = "radius", .help = "Radius of the circle", .unit = unit::length, .low = 0, .high = 1e6});
        visit(self.rate, Field{.name = "rate",
                               .help = "Angular velocity, counter-clockwise on screen; negative for clockwise",
                               .unit = {.time = -1, .angle = true},
                               .low = -2000 * pi<double>,
                               .high = 2000 * pi<double>});
        visit(self.phase, Field{.name = "phase",
                                .help = "Initial angle: 0 to the right, 90 above",
                                .unit = unit::angle,
                                .low = -100 * pi<double>,
                                .high = 100 * pi<double>});
    }
};

struct BobDriver {
    static constexpr std::string_view name = "bob";
    static constexpr std::string_view about = "Oscillation around the held position, with a period for each axis.";
    Point by{};
    Point period{{1, 1, 1}};
    double phase = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.by,
              Field{.name = "by", .help = "Amplitude along each axis", .unit = unit::length, .required = true});
        visit(self.period, Field{.name = "period",
                                 .help = "Period of the oscillation along each axis",
                                 .unit = unit::time,
                                 .low = 1e-3,
                                 .high = 1e6});
        visit(self.phase, Field{.name = "phase",
                                .help = "Initial phase; 0 in the middle",
                                .unit = unit::angle,
                                .low = -100 * pi<double>,
                                .high = 100 * pi<double>});
    }
};

struct Keyframe {
    double at = 0;
    Point to{};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.at,
              Field{.name = "at", .help = "Time", .unit = unit::time, .low = 0, .high = 1e12, .required = true});
        visit(self.to, Field{.name = "to", .help = "Position at that time", .unit = unit::length, .required = true});
    }
};

struct PathDriver {
    static constexpr std::string_view name = "path";
    static constexpr std::string_view about = "Motion along keyframes.";
    std::vector<Keyframe> keys;
    bool smooth = false;
    bool repeat = false;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.keys, Field{.name = "keys",
                               .help = "Keyframes in order of time; the path begins at the held position",
                               .required = true});
        visit(self.smooth,
              Field{.name = "smooth", .help = "Smooth curve through the positions instead of straight lines"});
        visit(self.repeat, Field{.name = "repeat", .help = "Repetition from time 0 after the last key"});
    }
};

struct PointerDriver {
    static constexpr std::string_view name = "pointer";
    static constexpr std::string_view about = "The pointer's position; without a pointer, a substitute path.";
    std::vector<Keyframe> keys;
    bool smooth = true;
    bool repeat = false;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.keys, Field{.name = "keys", .help = "Keyframes of a substitute path, in order of time"});
        visit(self.smooth,
              Field{.name = "smooth", .help = "Smooth curve through the positions instead of straight lines"});
        visit(self.repeat, Field{.name = "repeat", .help = "Repetition from time 0 after the last key"});
    }
};

using Driver = std::variant<OrbitDriver, BobDriver, PathDriver, PointerDriver>;

} // namespace sinew
