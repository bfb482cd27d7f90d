#pragma once

#include "sinew/math/point.h"
#include "sinew/math/record.h"
#include "sinew/scene/figure_section.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// What happens when: the section "events" of a scene file. Times are in the scene's time unit, from its start.
namespace sinew {

struct GrabEvent {
    static constexpr std::string_view name = "grab";
    static constexpr std::string_view about = "Takes hold of a particle and carries it to a place.";
    std::string particle;
    std::optional<Point> to;
    double over = 0;
    double within = 0;
    double compliance = 0;
    double max_force = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.particle, Field{.name = "grab", .help = "Which particle, as figure/name", .required = true});
        visit(self.to, Field{.name = "to", .help = "Where it is carried; left out: held", .unit = unit::length});
        visit(self.over,
              Field{.name = "over", .help = "How long that takes", .unit = unit::time, .low = 0, .high = 1e9});
        visit(self.within,
              Field{.name = "within",
                    .help = "What of its figure is as near is carried along; in classic mode, what is as near to "
                            "its way",
                    .unit = unit::length,
                    .low = 0,
                    .high = 1e6});
        visit(self.compliance, Field{.name = "compliance",
                                     .help = "How much the hold gives under a force; 0 holds fast",
                                     .unit = unit::compliance,
                                     .low = 0,
                                     .high = 1e12});
        visit(self.max_force, Field{.name = "max_force",
                                    .help = "Most it pulls with; 0 means no limit",
                                    .unit = unit::force,
                                    .low = 0,
                                    .high = 1e15});
    }
};

struct ReleaseEvent {
    static constexpr std::string_view name = "release";
    static constexpr std::string_view about = "Lets go of a particle that is grabbed or pinned; it keeps its velocity.";
    std::string particle;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.particle, Field{.name = "release", .help = "Which particle, as figure/name", .required = true});
    }
};

struct ImpulseEvent {
    static constexpr std::string_view name = "impulse";
    static constexpr std::string_view about = "A blow: a change of momentum at once.";
    std::string target;
    Point by{};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.target, Field{.name = "impulse",
                                 .help = "A particle as figure/name, or a figure, whose particles share it by mass",
                                 .required = true});
        visit(self.by, Field{.name = "by", .help = "Mass times velocity", .unit = unit::impulse, .required = true});
    }
};

struct KickEvent {
    static constexpr std::string_view name = "kick";
    static constexpr std::string_view about =
        "A random change of velocity, another one each time and for each particle.";
    std::string target;
    Point by{};
    std::int64_t seed = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.target, Field{.name = "kick",
                                 .help = "Which particle, as figure/name; figure/stem_* are all that begin so",
                                 .required = true});
        visit(self.by, Field{.name = "by",
                             .help = "The largest change, to either side along each axis",
                             .unit = unit::speed,
                             .required = true});
        visit(self.seed, Field{.name = "seed", .help = "Another number, other kicks"});
    }
};

struct JoinEvent {
    static constexpr std::string_view name = "join";
    static constexpr std::string_view about =
        "Joins particles by a constraint of the figure of the first, unless one of its name is there; snip parts them.";
    ConstraintSection constraint;
    double within = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        ConstraintSection::fields(self.constraint, [&](auto& member, Field field) {
            if (field.name == "between") field.name = "join";
            visit(member, field);
        });
        visit(self.within, Field{.name = "within",
                                 .help = "Only if the first two are as near as that; 0: however far",
                                 .unit = unit::length,
                                 .low = 0,
                                 .high = 1e8});
    }
};

struct GustEvent {
    static constexpr std::string_view name = "gust";
    static constexpr std::string_view about = "A wind that blows for a while.";
    Point velocity{};
    double strength = 0.1;
    double over = 1;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.velocity,
              Field{.name = "gust", .help = "Velocity of the air", .unit = unit::speed, .required = true});
        visit(self.strength, Field{.name = "strength",
                                   .help = "Force on one particle over its speed against the air",
                                   .unit = unit::drag,
                                   .low = 0,
                                   .high = 1e9});
        visit(self.over, Field{.name = "over", .help = "How long", .unit = unit::time, .low = 0, .high = 1e9});
    }
};

struct CutEvent {
    static constexpr std::string_view name = "cut";
    static constexpr std::string_view about =
        "Cuts every distance that crosses a line, as seen in the picture; cloth is sliced along it.";
    std::array<Point, 2> line{};
    std::optional<double> within;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.line, Field{.name = "cut", .help = "From here to there", .unit = unit::length, .required = true});
        visit(self.within, Field{.name = "within",
                                 .help = "What comes as near to the line is cut too; left out: as a pointer does",
                                 .unit = unit::length,
                                 .low = 0,
                                 .high = 1e6});
    }
};

struct SnipEvent {
    static constexpr std::string_view name = "snip";
    static constexpr std::string_view about = "Removes constraints by name.";
    std::vector<std::string> constraints;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.constraints, Field{.name = "snip", .help = "Which, as figure/name", .required = true});
    }
};

/// What can be changed while a scene runs; what is left out stays.
struct Changes {
    std::optional<Point> gravity;
    std::optional<double> damping, bounce, friction, time_scale;
    std::optional<int> substeps, iterations, passes;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.gravity, Field{.name = "gravity", .help = "As in world", .unit = unit::acceleration});
        visit(self.damping, Field{.name = "damping", .help = "As in world", .low = 0, .high = 1e6});
        visit(self.bounce, Field{.name = "bounce", .help = "Of all walls", .low = 0, .high = 1});
        visit(self.friction, Field{.name = "friction", .help = "Of all walls", .low = 0, .high = 100});
        visit(self.time_scale, Field{.name = "time_scale", .help = "As in solver.rules", .low = 0, .high = 100});
        visit(self.substeps, Field{.name = "substeps", .help = "As in solver", .low = 0, .high = 1000});
        visit(self.iterations, Field{.name = "iterations", .help = "As in solver", .low = 1, .high = 1000});
        visit(self.passes, Field{.name = "passes", .help = "As in solver", .low = 0, .high = 1000});
    }
};

struct SetEvent {
    static constexpr std::string_view name = "set";
    static constexpr std::string_view about = "Changes how the world behaves from now on.";
    Changes changes;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.changes, Field{.name = "set", .help = "What is changed, and to what", .required = true});
    }
};

struct EventSection {
    double at = 0;
    double every = 0;
    int times = 0;
    std::variant<GrabEvent, ReleaseEvent, ImpulseEvent, KickEvent, GustEvent, CutEvent, SnipEvent, JoinEvent, SetEvent>
        event;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.at,
              Field{.name = "at", .help = "When", .unit = unit::time, .low = 0, .high = 1e12, .required = true});
        visit(self.every, Field{.name = "every",
                                .help = "Again and again, after as long each time; 0: once",
                                .unit = unit::time,
                                .low = 0,
                                .high = 1e12});
        visit(self.times,
              Field{.name = "times", .help = "How often in all, if again; 0: without end", .low = 0, .high = 1e9});
        visit(self.event, Field{.required = true});
    }
};

} // namespace sinew
