#pragma once

#include "sinew/prefab/builder.h"

#include <optional>
#include <string>

namespace sinew {

/// Two bones with a joint between, starting at the figure's position: particles root, joint, end; constraints upper,
/// lower, and in physical mode bend, a range for the angle at the joint. In 3D an angle has no sign: the joint bends to
/// every side, as far as the larger of the two limits allows. Drawn as one band along the quadratic Bezier curve of the
/// three particles, with a tip along the end tangent of the curve.
struct Limb {
    static constexpr std::string_view name = "limb";
    static constexpr std::string_view about = "An arm or a leg: two bones, drawn as one band along a curve.";
    static constexpr Dimensions dimensions{2, 3};

    double upper = 0.4;
    double lower = 0.4;
    double angle = 0; ///< radians
    double bend = 0;
    double bend_min = -150 * pi<double> / 180;
    double bend_max = 150 * pi<double> / 180;
    bool pinned = true;
    double mass = 5;
    double width = 0.14;
    double end_width = 0.1;
    double tip = 0.16;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double min = 1e-6, max = 1e6, turn = 2 * pi<double>, fold = 175 * pi<double> / 180;
        visit(self.upper, Field{.name = "upper",
                                .help = "Length of the bone from the root to the joint",
                                .unit = unit::length,
                                .low = min,
                                .high = max});
        visit(self.lower, Field{.name = "lower",
                                .help = "Length of the bone from the joint to the end",
                                .unit = unit::length,
                                .low = min,
                                .high = max});
        visit(
            self.angle,
            Field{
                .name = "angle",
                .help =
                    "Initial direction of the upper bone: 0 hangs straight down, a quarter turn is level to the right",
                .unit = unit::angle,
                .low = -turn,
                .high = turn});
        visit(self.bend, Field{.name = "bend",
                               .help = "Initial angle at the joint, counter-clockwise on screen",
                               .unit = unit::angle,
                               .low = -fold,
                               .high = fold});
        visit(self.bend_min, Field{.name = "bend_min",
                                   .help = "Smallest angle at the joint (2D). Physical mode only",
                                   .unit = unit::angle,
                                   .low = -fold,
                                   .high = 0});
        visit(self.bend_max, Field{.name = "bend_max",
                                   .help = "Largest angle at the joint; in 3D to every side, or -bend_min if that is "
                                           "more. Physical mode only",
                                   .unit = unit::angle,
                                   .low = 0,
                                   .high = fold});
        visit(self.pinned, Field{.name = "pinned", .help = "Root held in place"});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.width,
              Field{.name = "width", .help = "Thickness at the root", .unit = unit::length, .low = min, .high = max});
        visit(
            self.end_width,
            Field{.name = "end_width", .help = "Thickness at the end", .unit = unit::length, .low = min, .high = max});
        visit(self.tip, Field{.name = "tip",
                              .help = "Diameter of the hand or foot; 0 for none",
                              .unit = unit::length,
                              .low = 0,
                              .high = max});
    }

    Sizes sizes() const { return {.particles = 3, .constraints = 3}; }
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew
