#pragma once

#include "sinew/constraint/kind_table.h"
#include "sinew/math/point.h"
#include "sinew/prefab/material.h"
#include "sinew/prefab/prefabs.h"
#include "sinew/scene/driver_section.h"
#include "sinew/scene/look_section.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Figures of a scene, and the constraints and pins on figures.
namespace sinew {

/// A keyframe of "drive", which moves the limits of a constraint: a winch for a distance, a motor for an angle. As in a
/// path of a pin, the limits move evenly from key to key, from their initial value at time 0 on.
struct DriveKey {
    double at = 0;
    std::optional<double> to, strength;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.at,
              Field{.name = "at", .help = "Time", .unit = unit::time, .low = 0, .high = 1e12, .required = true});
        visit(self.to, Field{.name = "to",
                             .help = "Rest value, or high limit, at this time, reached evenly from the key before"});
        visit(self.strength,
              Field{.name = "strength",
                    .help = "Share of max_force at this time, interpolated linearly to the next key with a strength",
                    .low = 0,
                    .high = 1000});
    }
};

struct DriveSection {
    std::optional<double> speed;
    std::vector<DriveKey> keys;

    /// True if a key says where the limits are.
    bool has_targets() const {
        return std::any_of(keys.begin(), keys.end(), [](const DriveKey& key) { return key.to.has_value(); });
    }

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.speed, Field{.name = "speed",
                                .help = "Speed of the limits, length units (or degrees) per time unit. Without keys "
                                        "the motion never ends, and a negative speed shortens; with keys this is the "
                                        "largest speed, and that of the steepest piece between keys if left out",
                                .low = -1e9,
                                .high = 1e9});
        visit(self.keys, Field{.name = "keys", .help = "Keyframes in order of time"});
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
    double damping_time = 0;
    std::optional<DriveSection> drive;
    Strength strength;
    bool hidden = false;

    bool is_rigid() const { return compliance == 0; }
    /// Spec without limits, whose unit depends on the kind.
    ConstraintSpec<double> spec() const {
        return strength.applied_to({.compliance = compliance,
                                    .relaxation = relaxation.value_or(1),
                                    .split = split.value_or(0.5),
                                    .max_force = max_force > 0 ? max_force : limit::measure<double>,
                                    .damping_time = damping_time});
    }

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.kind, Field{.name = "kind", .help = "Measured quantity", .choices = kind_names});
        visit(self.between,
              Field{.name = "between",
                    .help = "Particles, as figure/name; inside a figure its own need no figure/, and other figures "
                            "must come earlier. A name may end in a star, for one constraint per matching particle",
                    .required = true});
        visit(self.name, Field{.name = "name", .help = "Name for events and reports"});
        visit(self.rest, Field{.name = "rest", .help = "Value of the measure to keep; the initial value if left out"});
        visit(self.low, Field{.name = "low", .help = "Smallest value of the measure"});
        visit(self.high, Field{.name = "high", .help = "Largest value of the measure: a rope"});
        visit(self.compliance,
              Field{.name = "compliance", .help = "Compliance (1/stiffness); 0 is rigid", .low = 0, .high = 1e12});
        visit(self.relaxation,
              Field{.name = "relaxation", .help = "Share of the error removed in one correction", .low = 0, .high = 1});
        visit(self.split, Field{.name = "split",
                                .help = "Share of the correction applied to the first particle: 0.5 is even",
                                .low = 0,
                                .high = 1});
        visit(self.max_force, Field{.name = "max_force",
                                    .help = "Largest force (torque for an angle); above it a length slips and an angle "
                                            "gives way; 0 for no limit",
                                    .low = 0,
                                    .high = 1e15});
        visit(
            self.damping_time,
            Field{.name = "damping_time",
                  .help = "Damping time of a compliant constraint, which acts on the measure expected that much later",
                  .unit = unit::time,
                  .low = 0,
                  .high = 1e6});
        visit(self.drive, Field{.name = "drive", .help = "Winch or motor that moves the limits"});
        Strength::fields(self.strength, visit, "Strain at which the constraint tears; 0 for never");
        visit(self.hidden, Field{.name = "hidden", .help = "Hidden support, not drawn"});
    }
};

struct ParticleSection {
    Point at{};
    Point velocity{};
    std::optional<Point> previous;
    double mass = 1;
    double radius = 0;
    bool pinned = false;
    std::string rolls{rolls_names[0]};
    std::optional<double> inertia;
    double spin = 0;
    Point axis{{0, 0, 1}};
    double size = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.at, Field{.name = "at", .help = "Initial position", .unit = unit::length, .required = true});
        visit(self.velocity, Field{.name = "velocity", .help = "Initial velocity", .unit = unit::speed});
        visit(self.previous, Field{.name = "previous",
                                   .help = "Position one frame earlier, in place of a velocity",
                                   .unit = unit::length});
        visit(self.mass, Field{.name = "mass", .help = "Mass", .unit = unit::mass, .low = 1e-12, .high = 1e12});
        visit(self.radius,
              Field{.name = "radius", .help = "Collision radius", .unit = unit::length, .low = 0, .high = 1e6});
        visit(self.pinned, Field{.name = "pinned", .help = "Held at the initial position"});
        visit(self.rolls, Field{.name = "rolls",
                                .help = "Turns as a ball does, by friction at its radius: while no constraint holds "
                                        "it, always, or never (physical mode)",
                                .choices = rolls_names});
        visit(self.inertia, Field{.name = "inertia",
                                  .help = "Moment of inertia, as a share of mass times radius^2; that of a solid ball, "
                                          "0.4, in 2D of a disc, 0.5, if left out",
                                  .low = 0.001,
                                  .high = 1000});
        visit(self.spin, Field{.name = "spin",
                               .help = "Initial angular velocity, counter-clockwise on screen; in 3D about \"axis\"",
                               .unit = unit::spin,
                               .low = -1e6,
                               .high = 1e6});
        visit(self.axis, Field{.name = "axis", .help = "Axis of the spin (3D)"});
        visit(self.size, Field{.name = "size",
                               .help = "Diameter of the drawn dot; 0 for that of the looks",
                               .unit = unit::length,
                               .low = 0,
                               .high = 1e6});
    }
};

inline constexpr std::array<std::string_view, 10> mark_names = {"stroke", "curve", "limb", "tip",     "loop",
                                                                "ring",   "dot",   "fill", "surface", "face"};

/// A drawn piece of a hand-made figure, besides its dots and lines.
struct PieceSection {
    std::string mark = "stroke";
    std::string part;
    std::vector<std::string> through;
    double width = 0, end_width = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.mark, Field{.name = "mark", .help = "Type of the drawn shape", .choices = mark_names});
        visit(self.part, Field{.name = "part", .help = "Name of the part in looks; the mark's name if left out"});
        visit(self.through, Field{.name = "through", .help = "Particles, named as in between", .required = true});
        visit(self.width, Field{.name = "width",
                                .help = "Thickness or diameter; 0 for that of the looks",
                                .unit = unit::length,
                                .low = 0,
                                .high = 1e6});
        visit(self.end_width, Field{.name = "end_width",
                                    .help = "Thickness at the end of a tapered stroke or limb",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = 1e6});
    }
};

/// A hand-made figure: a list of particles and constraints.
struct ByHand {
    static constexpr std::string_view name = "by_hand";
    static constexpr std::string_view about = "Particles and constraints listed one by one.";
    std::vector<std::pair<std::string, ParticleSection>> particles;
    std::vector<ConstraintSection> constraints;
    std::vector<PieceSection> pieces;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.particles, Field{.name = "particles", .help = "Particles by name"});
        visit(self.constraints, Field{.name = "constraints", .help = "Constraints between the particles"});
        visit(self.pieces, Field{.name = "pieces", .help = "Drawn pieces, above lines and below dots"});
    }
};

namespace detail {
template <class Variant> struct WithByHand;
template <class... Prefab> struct WithByHand<TypeList<Prefab...>> { using type = std::variant<ByHand, Prefab...>; };
} // namespace detail

/// Contact of a figure with colliders and other figures.
struct ContactSection {
    std::optional<double> radius;
    bool figures = false;
    bool itself = false;
    std::string cloth{cloth_contact_names[0]};
    double friction = 0.5;
    double bounce = 0;
    std::optional<double> wall_friction;
    std::vector<int> layers{0};
    std::optional<std::vector<int>> touches;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.radius, Field{.name = "radius",
                                 .help = "Radius of all particles and links; the prefab's if left out",
                                 .unit = unit::length,
                                 .low = 0,
                                 .high = 1e6});
        visit(self.figures, Field{.name = "figures",
                                  .help = "Contact with other figures that have this switched on (physical mode)"});
        visit(self.itself,
              Field{.name = "itself",
                    .help = "Contact of its particles and links with each other, except for neighbours on a link"});
        visit(self.cloth, Field{.name = "cloth",
                                .help = "Contact of faces with themselves and other cloth: spheres 1.5 cells apart, "
                                        "which may cross for moments; or thin, half a cell apart, which never cross",
                                .choices = cloth_contact_names});
        visit(self.friction,
              Field{.name = "friction",
                    .help = "Coefficient of Coulomb friction against other figures; the smaller one counts",
                    .low = 0,
                    .high = 100});
        visit(self.bounce, Field{.name = "bounce",
                                 .help = "Coefficient of restitution; of two that touch the larger one counts",
                                 .low = 0,
                                 .high = 1});
        visit(self.wall_friction,
              Field{.name = "wall_friction",
                    .help = "Coefficient of Coulomb friction against walls and colliders; theirs if left out",
                    .low = 0,
                    .high = 100});
        visit(self.layers, Field{.name = "layers", .help = "Layers it belongs to", .low = 0, .high = 31});
        visit(self.touches,
              Field{.name = "touches", .help = "Layers it touches; all if left out", .low = 0, .high = 31});
    }
};

struct FigureSection {
    std::string name;
    Point at{};
    double turn = 0;
    Point velocity{};
    std::vector<std::pair<std::string, Point>> kicks;
    std::optional<double> relaxation, split;
    std::string direct;
    std::string integrator;
    double internal_damping = 0;
    ContactSection contact;
    std::vector<std::pair<std::string, Look>> looks;
    detail::WithByHand<Prefabs>::type made; ///< a prefab with its parameters, or by hand

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.name, Field{.name = "name", .help = "Name in the scene; the prefab's name if left out"});
        visit(self.at, Field{.name = "at", .help = "Position of the origin", .unit = unit::length});
        visit(self.turn, Field{.name = "turn",
                               .help = "Rotation about the origin, counter-clockwise on screen",
                               .unit = unit::angle,
                               .low = -100 * pi<double>,
                               .high = 100 * pi<double>});
        visit(self.velocity,
              Field{.name = "velocity", .help = "Initial velocity of the whole figure", .unit = unit::speed});
        visit(self.kicks, Field{.name = "kicks",
                                .help = "Additional initial velocity of single particles, by name",
                                .unit = unit::speed});
        visit(self.relaxation,
              Field{.name = "relaxation", .help = "Relaxation of all constraints of the figure", .low = 0, .high = 1});
        visit(self.split,
              Field{.name = "split", .help = "Split of all constraints of the figure", .low = 0, .high = 1});
        visit(self.direct,
              Field{.name = "direct",
                    .help = "solver.direct for the connected component of this figure; the solver's value if left out",
                    .choices = direct_names});
        visit(self.integrator, Field{.name = "integrator",
                                     .help = "solver.rules.integrator for this figure; the rules' value if left out",
                                     .choices = integrator_names});
        visit(self.internal_damping,
              Field{.name = "internal_damping",
                    .help = "Rate of decay of motion inside the figure; its flight and spin are kept (physical mode)",
                    .unit = unit::per_time,
                    .low = 0,
                    .high = 1e6});
        visit(self.contact, Field{.name = "contact", .help = "Contact with colliders and other figures"});
        visit(self.looks, Field{.name = "looks", .help = "Looks by part; \"all\" for the whole figure"});
        visit(self.made, Field{.name = "prefab", .help = "Type of the figure; by_hand if left out"});
    }
};

/// Force with which a pin, or a grab, holds its particle.
struct GripSection {
    double compliance = 0;
    double max_force = 0;

    template <int D, class Real> PinSpec<D, Real> spec(Hold hold) const {
        return {.compliance = Real(compliance), .max_force = Real(max_force), .hold = hold};
    }

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit, std::string_view help) {
        visit(self.compliance,
              Field{.name = "compliance", .help = help, .unit = unit::compliance, .low = 0, .high = 1e12});
        visit(self.max_force, Field{.name = "max_force",
                                    .help = "Largest force; 0 for no limit",
                                    .unit = unit::force,
                                    .low = 0,
                                    .high = 1e15});
    }
};

struct PinSection {
    std::string particle;
    std::optional<Point> to;
    GripSection grip;
    double damping = 1;
    std::optional<Point> steer;
    double steer_damping = 0;
    std::optional<Driver> driver;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.particle, Field{.name = "particle",
                                   .help = "Particle, as figure/name; figure/stem_* for all names with that stem",
                                   .required = true});
        visit(self.to,
              Field{.name = "to", .help = "Held position; the initial position if left out", .unit = unit::length});
        GripSection::fields(self.grip, visit, "Compliance of the pin; 0 is rigid");
        visit(self.damping, Field{.name = "damping",
                                  .help = "Damping of a compliant pin, as a fraction of critical damping",
                                  .low = 0,
                                  .high = 1000});
        visit(self.steer, Field{.name = "steer",
                                .help = "Acceleration towards the target for each unit of distance, along each axis, "
                                        "instead of holding the particle there. In classic mode no other acceleration "
                                        "acts on it; in physical mode it becomes a spring with the mean stiffness",
                                .unit = {.time = -2},
                                .low = 0,
                                .high = 1e6});
        visit(self.steer_damping, Field{.name = "steer_damping",
                                        .help = "Deceleration for each unit of velocity, of a pin that steers",
                                        .unit = {.time = -1},
                                        .low = 0,
                                        .high = 1e6});
        visit(self.driver, Field{.name = "driver", .help = "Motion of the pin; none if left out"});
    }
};

} // namespace sinew
