#pragma once

#include "sinew/math/point.h"
#include "sinew/math/record.h"
#include "sinew/world/figure.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// Forces, bounds and solver settings: the sections "world" and "solver" of a scene file.
namespace sinew {

/// Fields of a surface that particles strike.
template <class Self, class Visit> void surface_fields(Self& self, Visit& visit) {
    visit(self.bounce, Field{.name = "bounce",
                             .help = "Coefficient of restitution: share of the approach speed given back",
                             .low = 0,
                             .high = 1});
    visit(self.friction, Field{.name = "friction", .help = "Coefficient of Coulomb friction", .low = 0, .high = 100});
}

struct PlaneSection {
    Point normal{{0, 1, 0}};
    Point through{};
    std::optional<double> bounce, friction;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.normal,
              Field{.name = "normal", .help = "Normal of the plane, towards the free side", .required = true});
        visit(self.through, Field{.name = "through", .help = "Point on the plane", .unit = unit::length});
        surface_fields(self, visit);
    }
};

struct BoundsSection {
    std::optional<std::array<Point, 2>> box;
    std::vector<PlaneSection> planes;
    double bounce = 0;
    double friction = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.box, Field{.name = "box",
                              .help = "Two opposite corners of a room with walls on all sides",
                              .unit = unit::length});
        visit(self.planes, Field{.name = "planes", .help = "Walls given as planes"});
        visit(self.bounce, Field{.name = "bounce",
                                 .help = "Coefficient of restitution of the walls; 0 for no rebound",
                                 .low = 0,
                                 .high = 1});
        visit(self.friction, Field{.name = "friction",
                                   .help = "Coefficient of Coulomb friction of the walls (physical mode)",
                                   .low = 0,
                                   .high = 100});
    }
};

struct GravityForce {
    static constexpr std::string_view name = "gravity";
    static constexpr std::string_view about = "An additional constant acceleration.";
    Point acceleration{};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.acceleration, Field{.name = "acceleration",
                                       .help = "Acceleration of all movable particles",
                                       .unit = unit::acceleration,
                                       .required = true});
    }
};

struct DragForce {
    static constexpr std::string_view name = "drag";
    static constexpr std::string_view about = "Drag of still air or water: a force against the velocity.";
    double strength = 0.1;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.strength, Field{.name = "strength",
                                   .help = "Drag coefficient: force on a particle divided by its speed",
                                   .unit = unit::drag,
                                   .low = 0,
                                   .high = 1e9});
    }
};

/// How air presses on areas, lines and balls.
template <class Self, class Visit> void air_fields(Self& self, Visit& visit) {
    visit(self.density, Field{.name = "density",
                              .help = "Density of the air, 1.2 kg/m^3 at sea level: the wind presses on areas by the "
                                      "angle to them, on lines by length and width (2D: by length), on balls by their "
                                      "disc; 0: by strength alone",
                              .unit = unit::density,
                              .low = 0,
                              .high = 1e6});
    visit(self.drag_coefficient, Field{.name = "drag_coefficient",
                                       .help = "Drag coefficient of what the air with a density presses on: 1.2 of a "
                                               "plate across the wind",
                                       .low = 0,
                                       .high = 1e3});
}

struct WindForce {
    static constexpr std::string_view name = "wind";
    static constexpr std::string_view about = "Moving air that carries particles along, in gusts.";
    Point velocity{};
    std::optional<double> strength;
    double density = 0;
    double drag_coefficient = 1.2;
    Point gust{};
    double gust_period = 1;
    double gust_size = 0;
    std::int64_t seed = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.velocity,
              Field{.name = "velocity", .help = "Velocity of the air", .unit = unit::speed, .required = true});
        visit(self.strength,
              Field{.name = "strength",
                    .help =
                        "Force on each particle divided by its speed relative to the air; on cloth on each 0.01 m^2, "
                        "across it (physical mode). 0.1 kg/s where neither it nor a density is given",
                    .unit = unit::drag,
                    .low = 0,
                    .high = 1e9});
        air_fields(self, visit);
        visit(self.gust,
              Field{.name = "gust", .help = "Largest change of the velocity in a gust", .unit = unit::speed});
        visit(self.gust_period, Field{.name = "gust_period",
                                      .help = "Time from one gust to the next",
                                      .unit = unit::time,
                                      .low = 1e-3,
                                      .high = 1e6});
        visit(self.gust_size, Field{.name = "gust_size",
                                    .help = "Length of a gust along the wind; 0 for the same gust everywhere",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = 1e6});
        visit(self.seed, Field{.name = "seed", .help = "Seed of the random gusts"});
    }
};

struct AttractorForce {
    static constexpr std::string_view name = "attractor";
    static constexpr std::string_view about = "A point that pulls everything towards it, or pushes it away.";
    Point center{};
    double strength = 1;
    double softness = 0.1;
    std::string figure;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.center,
              Field{.name = "center", .help = "Position of the attractor", .unit = unit::length, .required = true});
        visit(self.strength, Field{.name = "strength",
                                   .help = "Acceleration times distance squared; negative to repel",
                                   .unit = {.length = 3, .time = -2},
                                   .low = -1e12,
                                   .high = 1e12});
        visit(self.softness, Field{.name = "softness",
                                   .help = "Distance below which the force is like that of a spring",
                                   .unit = unit::length,
                                   .low = 1e-6,
                                   .high = 1e6});
        visit(self.figure, Field{.name = "figure", .help = "Only figure attracted; all figures if left out"});
    }
};

struct RandomPushForce {
    static constexpr std::string_view name = "random_push";
    static constexpr std::string_view about =
        "A force on one random particle each step, of whole numbers between low and high.";
    Point low{}, high{};
    std::int64_t seed = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.low, Field{.name = "low", .help = "Smallest force", .required = true});
        visit(self.high, Field{.name = "high", .help = "Largest force", .required = true});
        visit(self.seed, Field{.name = "seed", .help = "Seed of the random pushes"});
    }
};

struct ForceSection {
    std::variant<GravityForce, DragForce, WindForce, AttractorForce, RandomPushForce> force;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.force, Field{.name = "force", .help = "Type of the force field", .required = true});
    }
};

struct WorldSection {
    Point gravity{};
    std::optional<double> damping;
    std::optional<BoundsSection> bounds;
    std::vector<ForceSection> forces;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.gravity, Field{.name = "gravity", .help = "Acceleration of gravity", .unit = unit::acceleration});
        visit(self.damping, Field{.name = "damping",
                                  .help = "Damping. physical: decay rate of the velocity, per time unit; classic: "
                                          "share of the velocity kept each frame",
                                  .low = 0,
                                  .high = 1e6});
        visit(self.bounds, Field{.name = "bounds", .help = "Walls"});
        visit(self.forces, Field{.name = "forces", .help = "Force fields, summed"});
    }
};

struct RulesSection {
    std::string order = "sweeps_last";
    bool moves_each_pass = false;
    std::string hold = "fixed";
    bool damp_after_force = false;
    bool root_free = false;
    double floor_keep = 1;
    double time_scale = 1;
    double longest_step = 4;
    bool outward_bounce = false;
    bool points_only_passes = false;
    bool unscaled_inertia = false;
    bool halved_acceleration = false;
    bool dropped_leftover = false;
    bool displaced_hold = false;
    bool hover_freezes = false;
    std::string integrator = "verlet";

    /// In the order of PassOrder; the last entry is an older name of the third.
    static constexpr std::array<std::string_view, 4> orders = {"sweeps_last", "walls_each_pass", "walls_last",
                                                               "interleaved"};
    static constexpr std::array<std::string_view, 3> holds = {"fixed", "corrected", "integrated"};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.order, Field{.name = "order",
                                .help = "Order of a frame. sweeps_last: move, walls, sweeps (OpenGL); walls_each_pass: "
                                        "move, then a sweep and the walls each pass; walls_last: move, sweeps, walls "
                                        "(Roblox); interleaved: older name of walls_last",
                                .choices = orders});
        visit(
            self.moves_each_pass,
            Field{.name = "moves_each_pass",
                  .help = "Motion by a whole frame in each pass, before the sweep (Roblox, as a reader repaired it)"});
        visit(self.hold, Field{.name = "hold",
                               .help = "Treatment of grabbed and driven points. fixed: set to the target only; "
                                       "corrected: set, then corrected like any other (Flash, Godot); integrated: set, "
                                       "then moved and corrected like any other (GameMaker)",
                               .choices = holds});
        visit(self.damp_after_force,
              Field{.name = "damp_after_force",
                    .help = "Velocity update (v + a) damping instead of v damping + a (Roblox)"});
        visit(self.root_free,
              Field{.name = "root_free", .help = "Distances without a square root: s = r^2/(d^2 + r^2) - 1/2"});
        visit(self.floor_keep,
              Field{.name = "floor_keep",
                    .help = "Share of the velocity along the floor kept each frame while resting on it",
                    .low = 0,
                    .high = 1});
        visit(self.time_scale, Field{.name = "time_scale",
                                     .help = "Speed of time: slow motion below 1, fast above",
                                     .low = 0,
                                     .high = 100});
        visit(self.longest_step, Field{.name = "longest_step",
                                       .help = "Largest number of frames a stall counts as",
                                       .low = 1,
                                       .high = 1000});
        visit(self.outward_bounce, Field{.name = "outward_bounce",
                                         .help = "Known bug (Roblox): top and right walls keep the outward speed"});
        visit(self.points_only_passes,
              Field{.name = "points_only_passes",
                    .help = "Known bug (Roblox): the passes move the points, the constraints are swept once"});
        visit(self.unscaled_inertia,
              Field{.name = "unscaled_inertia",
                    .help = "Known bug (GameMaker): inertia does not shrink with the time step"});
        visit(self.halved_acceleration,
              Field{.name = "halved_acceleration", .help = "Known bug (tearable cloth): x += v + a/2 dt^2"});
        visit(self.dropped_leftover,
              Field{.name = "dropped_leftover",
                    .help = "Known bug (tearable cloth): whole steps of 16 ms, the remainder of a frame is dropped"});
        visit(self.displaced_hold,
              Field{.name = "displaced_hold",
                    .help = "Known bug (Godot chain, first version): a grabbed or driven point is set to its target, "
                            "then moved by the same displacement again, and corrected"});
        visit(self.hover_freezes, Field{.name = "hover_freezes",
                                        .help = "Known bug (Godot chain, second version): a point under the pointer is "
                                                "corrected, but not moved; see pointer.hover_size"});
        visit(self.integrator,
              Field{.name = "integrator",
                    .help = "Integrator of free particles: Verlet as in the originals, or another for comparison",
                    .choices = integrator_names});
    }
};

/// Sleep of figures at rest.
struct SleepSection {
    double speed = 0;
    std::optional<double> delay;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.speed, Field{.name = "speed",
                                .help = "Speed below which a particle counts as at rest",
                                .unit = unit::speed,
                                .low = 0,
                                .high = 1e6,
                                .required = true});
        visit(self.delay, Field{.name = "delay",
                                .help = "Time at rest before an island falls asleep; half a second if left out",
                                .unit = unit::time,
                                .low = 0,
                                .high = 1e6});
    }
};

struct SolverSection {
    std::string mode = "physical";
    std::string precision = "double";
    int substeps = 0;
    int iterations = 1;
    double rate = 60;
    int passes = 1;
    RulesSection rules;
    std::string direct = "auto";
    std::optional<SleepSection> sleep;
    std::int64_t seed = 0;

    static constexpr std::array<std::string_view, 2> modes = {"physical", "classic"};
    static constexpr std::array<std::string_view, 2> precisions = {"float", "double"};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.mode, Field{.name = "mode",
                               .help = "Mode. physical: correct physics; classic: behaviour of the original demo",
                               .choices = modes});
        visit(self.precision,
              Field{.name = "precision", .help = "Precision of all numbers in the world", .choices = precisions});
        visit(self.substeps, Field{.name = "substeps",
                                   .help = "Substeps of a step (physical mode); 0: 16 for iterative components, as few "
                                           "as needed for components solved directly",
                                   .low = 0,
                                   .high = 1000});
        visit(self.iterations, Field{.name = "iterations",
                                     .help = "Number of sweeps over the constraints in each substep (physical mode)",
                                     .low = 1,
                                     .high = 1000});
        visit(self.direct,
              Field{.name = "direct",
                    .help = "Direct solution of components connected by distances, angles and pulleys. auto: with few "
                            "loops; on: as long as the matrix stays sparse; off: iterative sweeps instead",
                    .choices = direct_names});
        visit(self.sleep,
              Field{.name = "sleep",
                    .help = "Sleep of what is at rest: islands are left out of the steps until something touches them "
                            "(physical mode); if left out, nothing sleeps"});
        visit(self.rate, Field{.name = "rate", .help = "Steps per second", .low = 1, .high = 10000});
        visit(self.passes, Field{.name = "passes",
                                 .help = "Number of sweeps over the constraints each frame (classic mode)",
                                 .low = 0,
                                 .high = 1000});
        visit(self.rules, Field{.name = "rules", .help = "Rules of the original demo (classic mode)"});
        visit(self.seed, Field{.name = "seed",
                               .help = "Seed of all random numbers, combined with the own seeds of forces and kicks"});
    }
};

} // namespace sinew
