#pragma once

#include "sinew/math/point.h"
#include "sinew/math/record.h"
#include "sinew/scene/figure_section.h"
#include "sinew/scene/world_section.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// Events at given times, or on contact: the section "events" of a scene file. Times are in the scene's time unit, from
/// the start of the scene.
namespace sinew {

struct GrabEvent {
    static constexpr std::string_view name = "grab";
    static constexpr std::string_view about = "A grab that holds a particle and carries it to a destination.";
    std::string particle;
    std::optional<Point> to;
    double duration = 0;
    double within = 0;
    GripSection grip;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.particle, Field{.name = "grab", .help = "Particle, as figure/name", .required = true});
        visit(self.to, Field{.name = "to",
                             .help = "Destination; if left out, the particle is held in place",
                             .unit = unit::length});
        visit(self.duration,
              Field{.name = "duration", .help = "Duration of the motion", .unit = unit::time, .low = 0, .high = 1e9});
        visit(self.within, Field{.name = "within",
                                 .help = "Distance within which particles of the same figure move along; in classic "
                                         "mode, distance from the path",
                                 .unit = unit::length,
                                 .low = 0,
                                 .high = 1e6});
        GripSection::fields(self.grip, visit, "Compliance of the hold; 0 is rigid");
    }
};

struct ReleaseEvent {
    static constexpr std::string_view name = "release";
    static constexpr std::string_view about = "A release of a grabbed or pinned particle, which keeps its velocity.";
    std::string particle;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.particle, Field{.name = "release", .help = "Particle, as figure/name", .required = true});
    }
};

struct ImpulseEvent {
    static constexpr std::string_view name = "impulse";
    static constexpr std::string_view about = "A blow: an instantaneous change of momentum.";
    std::string target;
    Point by{};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.target,
              Field{.name = "impulse",
                    .help = "Particle as figure/name, or a figure, whose particles share the impulse by mass",
                    .required = true});
        visit(self.by, Field{.name = "by", .help = "Change of momentum", .unit = unit::impulse, .required = true});
    }
};

struct KickEvent {
    static constexpr std::string_view name = "kick";
    static constexpr std::string_view about = "A random change of velocity, different each time and for each particle.";
    std::string target;
    Point by{};
    std::int64_t seed = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.target, Field{.name = "kick",
                                 .help = "Particle, as figure/name; figure/stem_* for all names with that stem",
                                 .required = true});
        visit(self.by, Field{.name = "by",
                             .help = "Largest change along each axis, in both directions",
                             .unit = unit::speed,
                             .required = true});
        visit(self.seed, Field{.name = "seed", .help = "Seed of the random kicks"});
    }
};

struct JoinEvent {
    static constexpr std::string_view name = "join";
    static constexpr std::string_view about = "A new constraint between particles, owned by the first particle's "
                                              "figure, unless one of that name exists; `remove` takes it out again.";
    ConstraintSection constraint;
    double within = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        ConstraintSection::fields(self.constraint, [&](auto& member, Field field) {
            if (field.name == "between") field.name = "join";
            visit(member, field);
        });
        visit(self.within,
              Field{.name = "within",
                    .help =
                        "Largest distance between the first two particles at which they are joined; 0 for any distance",
                    .unit = unit::length,
                    .low = 0,
                    .high = 1e8});
    }
};

struct GustEvent {
    static constexpr std::string_view name = "gust";
    static constexpr std::string_view about = "A wind of limited duration.";
    Point velocity{};
    std::optional<double> strength;
    double density = 0;
    double drag_coefficient = 1.2;
    double duration = 1;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.velocity,
              Field{.name = "gust", .help = "Velocity of the air", .unit = unit::speed, .required = true});
        visit(self.strength,
              Field{.name = "strength",
                    .help =
                        "Force on each particle divided by its speed relative to the air; on cloth on each 0.01 m^2, "
                        "across it (physical mode). 0.1 kg/s where neither it nor a density is given",
                    .unit = unit::drag,
                    .low = 0,
                    .high = 1e9});
        air_fields(self, visit);
        visit(self.duration, Field{.name = "duration", .help = "Duration", .unit = unit::time, .low = 0, .high = 1e9});
    }
};

struct CutEvent {
    static constexpr std::string_view name = "cut";
    static constexpr std::string_view about =
        "A cut of every distance that crosses a line in the picture; cloth is sliced along the line.";
    std::array<Point, 2> line{};
    std::optional<double> within;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.line, Field{.name = "cut",
                               .help = "Line of the cut, from one point to the other",
                               .unit = unit::length,
                               .required = true});
        visit(self.within,
              Field{.name = "within",
                    .help = "Distance from the line within which links are cut too; pointer.cut_radius if left out",
                    .unit = unit::length,
                    .low = 0,
                    .high = 1e6});
    }
};

struct RemoveEvent {
    static constexpr std::string_view name = "remove";
    static constexpr std::string_view about = "Removal of constraints, figures and colliders by name.";
    std::vector<std::string> names;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(
            self.names,
            Field{
                .name = "remove",
                .help =
                    "Constraints, as figure/name, with figure/stem_* for all names with that stem; figures; colliders",
                .required = true});
    }
};

struct AddEvent {
    static constexpr std::string_view name = "add";
    static constexpr std::string_view about =
        "One more of a figure of the scene, as it is at the start; the copies are called NAME_1, NAME_2, ...";
    static constexpr std::uint64_t most = 10'000; ///< copies by one event
    std::string figure;
    std::optional<Point> to, velocity;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.figure, Field{.name = "add", .help = "Figure of the scene", .required = true});
        visit(self.to,
              Field{.name = "to", .help = "Position of the origin; the figure's if left out", .unit = unit::length});
        visit(self.velocity, Field{.name = "velocity",
                                   .help = "Initial velocity of the whole figure; the figure's if left out",
                                   .unit = unit::speed});
    }
};

struct ColliderEvent {
    static constexpr std::string_view name = "collider";
    static constexpr std::string_view about =
        "A change of a collider: moved, switched off or on, its surface set running.";
    std::string collider;
    std::optional<Point> to;
    std::optional<double> turn;
    double duration = 0;
    std::optional<bool> enabled;
    std::optional<Point> surface_velocity;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.collider,
              Field{.name = "collider", .help = "Name of a collider without a motion", .required = true});
        visit(self.to,
              Field{.name = "to", .help = "New position; what touches it is carried along", .unit = unit::length});
        visit(self.turn,
              Field{.name = "turn", .help = "New rotation, as in the collider's section", .unit = unit::angle});
        visit(self.duration, Field{.name = "duration",
                                   .help = "Duration of the motion; 0 for a single step",
                                   .unit = unit::time,
                                   .low = 0,
                                   .high = 1e9});
        visit(self.enabled, Field{.name = "enabled",
                                  .help = "false: touches nothing, and is not drawn, until it is switched on again"});
        visit(
            self.surface_velocity,
            Field{.name = "surface_velocity", .help = "New velocity of the surface along itself", .unit = unit::speed});
    }
};

/// New values for constraints while a scene runs; absent members keep their values.
struct AdjustEvent {
    static constexpr std::string_view name = "adjust";
    static constexpr std::string_view about = "New values for constraints: their limits, compliance and strength.";
    std::vector<std::string> constraints;
    std::optional<double> rest, low, high, compliance, max_force, breaking_strain, break_force;

    bool has_values() const { return rest || low || high || compliance || max_force || breaking_strain || break_force; }

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.constraints, Field{.name = "adjust",
                                      .help = "Constraints, as figure/name; figure/stem_* for all names with that stem",
                                      .required = true});
        visit(self.rest, Field{.name = "rest", .help = "Value of the measure to keep (degrees for an angle)"});
        visit(self.low, Field{.name = "low", .help = "Smallest value of the measure"});
        visit(self.high, Field{.name = "high", .help = "Largest value of the measure"});
        visit(self.compliance,
              Field{.name = "compliance", .help = "Compliance (1/stiffness); 0 is rigid", .low = 0, .high = 1e12});
        visit(self.max_force,
              Field{.name = "max_force", .help = "Largest force; 0 for no limit", .low = 0, .high = 1e15});
        visit(self.breaking_strain,
              Field{.name = "breaking_strain", .help = "Strain at which it tears; 0 for never", .low = 0, .high = 1e6});
        visit(self.break_force, Field{.name = "break_force",
                                      .help = "Force above which it tears; 0 for never",
                                      .unit = unit::force,
                                      .low = 0,
                                      .high = 1e15});
    }
};

struct ResizeEvent {
    static constexpr std::string_view name = "resize";
    static constexpr std::string_view about = "A new collision radius of particles.";
    std::string particles;
    double radius = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.particles, Field{.name = "resize",
                                    .help = "Particle, as figure/name; figure/stem_* for all names with that stem",
                                    .required = true});
        visit(self.radius, Field{.name = "radius",
                                 .help = "Collision radius",
                                 .unit = unit::length,
                                 .low = 0,
                                 .high = 1e6,
                                 .required = true});
    }
};

/// Settings that can change while a scene runs; absent members keep their values.
struct Changes {
    std::optional<Point> gravity;
    std::optional<double> damping, bounce, friction, time_scale;
    std::optional<int> substeps, iterations, passes;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.gravity, Field{.name = "gravity", .help = "New value of world.gravity", .unit = unit::acceleration});
        visit(self.damping, Field{.name = "damping", .help = "New value of world.damping", .low = 0, .high = 1e6});
        visit(self.bounce, Field{.name = "bounce", .help = "New bounce of all walls", .low = 0, .high = 1});
        visit(self.friction, Field{.name = "friction", .help = "New friction of all walls", .low = 0, .high = 100});
        visit(self.time_scale,
              Field{.name = "time_scale", .help = "New value of solver.rules.time_scale", .low = 0, .high = 100});
        visit(self.substeps, Field{.name = "substeps", .help = "New value of solver.substeps", .low = 0, .high = 1000});
        visit(self.iterations,
              Field{.name = "iterations", .help = "New value of solver.iterations", .low = 1, .high = 1000});
        visit(self.passes, Field{.name = "passes", .help = "New value of solver.passes", .low = 0, .high = 1000});
    }
};

struct SetEvent {
    static constexpr std::string_view name = "set";
    static constexpr std::string_view about = "A permanent change of settings.";
    Changes changes;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.changes, Field{.name = "set", .help = "New values", .required = true});
    }
};

/// Controls of a character or a car for some time; absent members keep those of events before.
struct SteerEvent {
    static constexpr std::string_view name = "steer";
    static constexpr std::string_view about =
        "Controls of a character or a car while the event lasts; the player's keys take over.";
    std::string figure;
    std::optional<double> along, up;
    std::optional<bool> jump, hold;
    double duration = 1;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.figure, Field{.name = "steer", .help = "Figure of the prefab character or car", .required = true});
        visit(self.along,
              Field{.name = "along",
                    .help = "Share of the speed at which it walks or drives: 1 to the right, -1 to the left",
                    .low = -1,
                    .high = 1});
        visit(self.up, Field{.name = "up",
                             .help = "Share of the speed at which a character climbs; a car in the air leans back by "
                                     "this share of its torque",
                             .low = -1,
                             .high = 1});
        visit(self.jump, Field{.name = "jump", .help = "A character jumps whenever it is on the ground; a car brakes"});
        visit(self.hold, Field{.name = "hold", .help = "A character reaches for ropes and planks, and holds on"});
        visit(self.duration, Field{.name = "duration", .help = "Duration", .unit = unit::time, .low = 0, .high = 1e9});
    }
};

/// A comment in the log of a scene: a goal, a round.
struct NoteEvent {
    static constexpr std::string_view name = "note";
    static constexpr std::string_view about = "A line in the log of events; nothing else happens.";
    std::string text;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.text, Field{.name = "note", .help = "Text of the line", .required = true});
    }
};

/// Name of the planes of world.bounds as a side of a contact.
inline constexpr std::string_view bounds_name = "bounds";

/// Contact at which an event happens, in place of a time.
struct ContactRule {
    static constexpr std::array<std::string_view, 4> phases{"begin", "persist", "end", "hit"};
    std::string phase{"begin"};
    std::string of, with;
    double above = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.phase,
              Field{.name = "contact",
                    .help = "begin: in the step in which a touch begins; persist: in every step of a touch but the "
                            "first; end: when the touch has ended; hit: when the impulse of a blow reaches `above`",
                    .choices = phases});
        visit(self.of, Field{.name = "of", .help = "Figure, or particle as figure/name", .required = true});
        visit(self.with,
              Field{.name = "with",
                    .help =
                        "What it touches: a collider, \"bounds\" for a wall of world.bounds, a figure, or a particle "
                        "as figure/name; anything if left out"});
        visit(self.above, Field{.name = "above",
                                .help = "Impulse in a step, or of a hit, below which a contact does not count",
                                .unit = unit::impulse,
                                .low = 0,
                                .high = 1e12});
    }
};

struct EventSection {
    std::optional<double> at;
    std::optional<ContactRule> on;
    double every = 0;
    int times = 0;
    std::variant<GrabEvent, ReleaseEvent, ImpulseEvent, KickEvent, GustEvent, CutEvent, RemoveEvent, JoinEvent,
                 AdjustEvent, ResizeEvent, SetEvent, AddEvent, ColliderEvent, SteerEvent, NoteEvent>
        event;

    /// Time of the first occurrence, or before which no contact counts.
    double first() const { return at.value_or(0); }

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.at, Field{.name = "at",
                             .help = "Time; with `on`, no contact before it counts",
                             .unit = unit::time,
                             .low = 0,
                             .high = 1e12});
        visit(self.on, Field{.name = "on", .help = "Contact at which the event happens, again and again"});
        visit(self.every, Field{.name = "every",
                                .help = "Interval of repetition; 0 for a single event. With `on`, shortest interval",
                                .unit = unit::time,
                                .low = 0,
                                .high = 1e12});
        visit(self.times,
              Field{.name = "times", .help = "Total number of repeated events; 0 for no limit", .low = 0, .high = 1e9});
        visit(self.event, Field{.required = true});
    }
};

} // namespace sinew
