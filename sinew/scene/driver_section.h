#pragma once

#include "sinew/math/point.h"
#include "sinew/math/record.h"
#include "sinew/math/scalar.h"

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

/// What moves a pin by itself: "driver" of an entry of "pins". All are functions of time alone but the pointer.
namespace sinew {

struct OrbitDriver {
    static constexpr std::string_view name = "orbit";
    static constexpr std::string_view about = "Goes round the place where it is held, in the plane of the screen.";
    double radius = 1;
    double rate = pi<double>;
    double phase = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.radius,
              Field{.name = "radius", .help = "Of the circle", .unit = unit::length, .low = 0, .high = 1e6});
        visit(self.rate, Field{.name = "rate",
                               .help = "How fast it turns, counter-clockwise as seen; negative the other way",
                               .unit = {.time = -1, .angle = true},
                               .low = -2000 * pi<double>,
                               .high = 2000 * pi<double>});
        visit(self.phase, Field{.name = "phase",
                                .help = "Where it begins: 0 to the right, 90 above",
                                .unit = unit::angle,
                                .low = -100 * pi<double>,
                                .high = 100 * pi<double>});
    }
};

struct BobDriver {
    static constexpr std::string_view name = "bob";
    static constexpr std::string_view about =
        "Swings to and fro about the place where it is held, each axis in its own "
        "time.";
    Point by{};
    Point period{{1, 1, 1}};
    double phase = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.by, Field{.name = "by", .help = "How far to either side", .unit = unit::length, .required = true});
        visit(self.period, Field{.name = "period",
                                 .help = "How long a swing to and fro lasts, along each axis",
                                 .unit = unit::time,
                                 .low = 1e-3,
                                 .high = 1e6});
        visit(self.phase, Field{.name = "phase",
                                .help = "Where in its swing it begins; 0 in the middle",
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
              Field{.name = "at", .help = "When", .unit = unit::time, .low = 0, .high = 1e12, .required = true});
        visit(self.to, Field{.name = "to", .help = "Where it is then", .unit = unit::length, .required = true});
    }
};

struct PathDriver {
    static constexpr std::string_view name = "path";
    static constexpr std::string_view about = "Goes from place to place on a timetable.";
    std::vector<Keyframe> keys;
    bool smooth = false;
    bool repeat = false;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.keys, Field{.name = "keys",
                               .help = "Where it is when, in the order of time; it sets out from where it is held",
                               .required = true});
        visit(self.smooth, Field{.name = "smooth", .help = "On a curve through the places, not straight"});
        visit(self.repeat, Field{.name = "repeat", .help = "Again from time 0 after the last"});
    }
};

struct PointerDriver {
    static constexpr std::string_view name = "pointer";
    static constexpr std::string_view about =
        "Follows the pointer; where there is none, the path that stands in for it.";
    std::vector<Keyframe> keys;
    bool smooth = true;
    bool repeat = false;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.keys, Field{.name = "keys", .help = "Where a pointer would be when, in the order of time"});
        visit(self.smooth, Field{.name = "smooth", .help = "On a curve through the places, not straight"});
        visit(self.repeat, Field{.name = "repeat", .help = "Again from time 0 after the last"});
    }
};

using Driver = std::variant<OrbitDriver, BobDriver, PathDriver, PointerDriver>;

} // namespace sinew
