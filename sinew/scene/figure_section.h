#pragma once

#include "sinew/constraint/kind_table.h"
#include "sinew/math/point.h"
#include "sinew/prefab/prefabs.h"
#include "sinew/scene/driver_section.h"
#include "sinew/scene/look_section.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What there is in a scene: its figures, and what joins and holds them.
namespace sinew {

/// What moves the limits of a constraint: "drive". Of a distance it is a winch, of an angle a motor.
struct DriveKey {
    double at = 0;
    std::optional<double> to, strength;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.at,
              Field{.name = "at", .help = "When", .unit = unit::time, .low = 0, .high = 1e12, .required = true});
        visit(self.to,
              Field{.name = "to", .help = "From then on it goes to this rest, or high limit, and stops there"});
        visit(self.strength, Field{.name = "strength",
                                   .help = "Share of its max_force that it has then, and more or less of it on the way "
                                           "to the next key that tells",
                                   .low = 0,
                                   .high = 1000});
    }
};

struct DriveSection {
    double speed = 0;
    std::vector<DriveKey> keys;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.speed, Field{.name = "speed",
                                .help = "Of its limits, a length (or degrees) a time unit; without keys it goes on for "
                                        "ever, in if it is negative",
                                .low = -1e9,
                                .high = 1e9});
        visit(self.keys, Field{.name = "keys", .help = "Where it goes when, in the order of time"});
    }
};

struct ConstraintSection {
    std::string kind = "distance";
    std::vector<std::string> between;
    std::string name;
    std::optional<double> rest, low, high;
    double compliance = 0;
    std::optional<double> relaxation, split;
    double max_force = 0;
    double lead = 0;
    std::optional<DriveSection> drive;
    double breaking_strain = 0;
    double toughness = 0;
    bool hidden = false;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.kind, Field{.name = "kind", .help = "What is measured", .choices = kind_names});
        visit(self.between,
              Field{.name = "between",
                    .help = "The particles, as figure/name; inside a figure its own need no figure/, and "
                            "others come before. One can end in a star: a constraint for each that begins so",
                    .required = true});
        visit(self.name, Field{.name = "name", .help = "For events and reports"});
        visit(self.rest, Field{.name = "rest", .help = "The measure is kept at this value; left out, at what it is"});
        visit(self.low, Field{.name = "low", .help = "The measure is kept at least this"});
        visit(self.high, Field{.name = "high", .help = "The measure is kept at most this: a rope"});
        visit(self.compliance, Field{.name = "compliance",
                                     .help = "How much it gives under a force (1/stiffness); 0 is rigid",
                                     .low = 0,
                                     .high = 1e12});
        visit(self.relaxation,
              Field{.name = "relaxation", .help = "Share of the error removed at once", .low = 0, .high = 1});
        visit(self.split, Field{.name = "split",
                                .help = "Share of the correction the first particle takes: 0.5 is fair",
                                .low = 0,
                                .high = 1});
        visit(self.max_force, Field{.name = "max_force",
                                    .help = "Most it pulls or pushes with; beyond, a length slips and an angle gives "
                                            "way. Of an angle a torque; 0 means no limit",
                                    .low = 0,
                                    .high = 1e15});
        visit(self.lead, Field{.name = "lead",
                               .help = "Of one with a compliance: it aims where its measure will be so much later, "
                                       "which damps it",
                               .unit = unit::time,
                               .low = 0,
                               .high = 1e6});
        visit(self.drive, Field{.name = "drive", .help = "A winch or motor that moves its limits"});
        visit(self.breaking_strain,
              Field{.name = "breaking_strain", .help = "Torn beyond it; 0 never tears", .low = 0, .high = 1e6});
        visit(self.toughness, toughness_field);
        visit(self.hidden, Field{.name = "hidden", .help = "A support that is not drawn"});
    }
};

struct ParticleSection {
    Point at{};
    Point velocity{};
    std::optional<Point> previous;
    double mass = 1;
    double radius = 0;
    bool pinned = false;
    double size = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.at, Field{.name = "at", .help = "Where it starts", .unit = unit::length, .required = true});
        visit(self.velocity, Field{.name = "velocity", .help = "How fast it starts", .unit = unit::speed});
        visit(self.previous, Field{.name = "previous",
                                   .help = "Instead of a velocity: where it was one frame ago",
                                   .unit = unit::length});
        visit(self.mass, Field{.name = "mass", .help = "Its mass", .unit = unit::mass, .low = 1e-12, .high = 1e12});
        visit(
            self.radius,
            Field{
                .name = "radius", .help = "How far it stays from walls", .unit = unit::length, .low = 0, .high = 1e6});
        visit(self.pinned, Field{.name = "pinned", .help = "Held where it starts"});
        visit(self.size, Field{.name = "size",
                               .help = "Diameter of its dot as drawn; 0 leaves it to the looks",
                               .unit = unit::length,
                               .low = 0,
                               .high = 1e6});
    }
};

inline constexpr std::array<std::string_view, 10> mark_names = {"stroke", "curve", "limb", "tip",     "loop",
                                                                "ring",   "dot",   "fill", "surface", "face"};

/// What is drawn of a figure made by hand, beside its dots and its lines.
struct PieceSection {
    std::string mark = "stroke";
    std::string part;
    std::vector<std::string> through;
    double width = 0, end_width = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.mark, Field{.name = "mark", .help = "What it is drawn as", .choices = mark_names});
        visit(self.part, Field{.name = "part", .help = "What looks call it; left out: as its mark"});
        visit(self.through, Field{.name = "through", .help = "Its particles, as between names them", .required = true});
        visit(self.width, Field{.name = "width",
                                .help = "Thickness or diameter; 0 leaves it to the looks",
                                .unit = unit::length,
                                .low = 0,
                                .high = 1e6});
        visit(self.end_width, Field{.name = "end_width",
                                    .help = "Of a stroke or limb that tapers: its thickness at the end",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = 1e6});
    }
};

/// A figure made by hand, of single particles and constraints.
struct ByHand {
    static constexpr std::string_view name = "by_hand";
    static constexpr std::string_view about = "Particles and constraints listed one by one.";
    std::vector<std::pair<std::string, ParticleSection>> particles;
    std::vector<ConstraintSection> constraints;
    std::vector<PieceSection> pieces;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.particles, Field{.name = "particles", .help = "Particles by name"});
        visit(self.constraints, Field{.name = "constraints", .help = "What joins them"});
        visit(self.pieces, Field{.name = "pieces", .help = "What is drawn on them, above lines and below dots"});
    }
};

namespace detail {
template <class Variant> struct WithByHand;
template <class... Prefab> struct WithByHand<TypeList<Prefab...>> { using type = std::variant<ByHand, Prefab...>; };
} // namespace detail

struct FigureSection {
    std::string name;
    Point at{};
    double turn = 0;
    Point velocity{};
    std::vector<std::pair<std::string, Point>> kicks;
    std::optional<double> relaxation, split;
    std::string direct;
    std::string integrator;
    std::vector<std::pair<std::string, Look>> looks;
    detail::WithByHand<Prefabs>::type made; ///< a prefab with its parameters, or by hand

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.name, Field{.name = "name", .help = "What the scene calls it; the prefab's name if left out"});
        visit(self.at, Field{.name = "at", .help = "Where its origin is", .unit = unit::length});
        visit(self.turn, Field{.name = "turn",
                               .help = "Turned about its origin, counter-clockwise as seen",
                               .unit = unit::angle,
                               .low = -100 * pi<double>,
                               .high = 100 * pi<double>});
        visit(self.velocity, Field{.name = "velocity", .help = "How fast all of it starts", .unit = unit::speed});
        visit(self.kicks,
              Field{.name = "kicks", .help = "More velocity for single particles, by name", .unit = unit::speed});
        visit(self.relaxation, Field{.name = "relaxation", .help = "Of all its constraints", .low = 0, .high = 1});
        visit(self.split, Field{.name = "split", .help = "Of all its constraints", .low = 0, .high = 1});
        visit(self.direct, Field{.name = "direct",
                                 .help = "As solver.direct, for what this figure is part of; left out: as there",
                                 .choices = direct_names});
        visit(self.integrator, Field{.name = "integrator",
                                     .help = "As solver.rules.integrator, for this figure; left out: as there",
                                     .choices = integrator_names});
        visit(self.looks, Field{.name = "looks", .help = "How its parts look, by part; \"all\" for the whole"});
        visit(self.made, Field{.name = "prefab", .help = "What it is; left out: by_hand"});
    }
};

struct PinSection {
    std::string particle;
    std::optional<Point> to;
    double compliance = 0;
    double damping = 1;
    double max_force = 0;
    std::optional<Point> steer;
    double steer_damping = 0;
    std::optional<Driver> driver;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.particle, Field{.name = "particle",
                                   .help = "Which, as figure/name; figure/stem_* are all that begin so",
                                   .required = true});
        visit(self.to, Field{.name = "to", .help = "Where it is held; left out: where it is", .unit = unit::length});
        visit(self.compliance, Field{.name = "compliance",
                                     .help = "How much it gives under a force; 0 holds fast",
                                     .unit = unit::compliance,
                                     .low = 0,
                                     .high = 1e12});
        visit(
            self.damping,
            Field{.name = "damping", .help = "Of a pin that gives, as a fraction of critical", .low = 0, .high = 1000});
        visit(self.max_force, Field{.name = "max_force",
                                    .help = "Most it pulls with; 0 means no limit",
                                    .unit = unit::force,
                                    .low = 0,
                                    .high = 1e15});
        visit(self.steer,
              Field{.name = "steer",
                    .help = "Accelerates the particle towards the target instead of holding it there, by so much for "
                            "each unit of distance, along each axis. In classic mode nothing else accelerates it; in "
                            "physical mode a spring as stiff as their mean does it",
                    .unit = {.time = -2},
                    .low = 0,
                    .high = 1e6});
        visit(self.steer_damping, Field{.name = "steer_damping",
                                        .help = "Of a pin that steers: acceleration against each unit of velocity",
                                        .unit = {.time = -1},
                                        .low = 0,
                                        .high = 1e6});
        visit(self.driver, Field{.name = "driver", .help = "What moves it by itself; left out: nothing"});
    }
};

} // namespace sinew
