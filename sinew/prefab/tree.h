#pragma once

#include "sinew/prefab/builder.h"

namespace sinew {

/// A tree growing from the figure's position: a trunk that forks repeatedly. Particles root (below the ground) and
/// base, both held, then particle_0 at the top of the trunk, particle_1, ... depth first, the left branch before the
/// right; constraints branch_0, ... below each of these particles, and joint_0, ..., the angle at the lower end of each
/// branch. (After the tree of verlet-js.)
///
/// Thickness follows Leonardo da Vinci's rule: the cross sections of the branches above a fork add up to the one below.
/// The bending stiffness of a joint is proportional to the fourth power of the thickness.
struct Tree {
    static constexpr std::string_view name = "tree";
    static constexpr std::string_view about = "A swaying tree: branches that fork, and leaves on the last ones.";
    static constexpr Dimensions dimensions{2, 2};
    static constexpr double min_share = 0.01; ///< shortest length of a branch, as a share of `branch`

    int depth = 5;
    double branch = 0.7;
    double shrink = 0.95;
    double spread = 30 * pi<double> / 180;
    double bend_stiffness = 3000;
    double joint_relaxation = 0.25;
    double mass = 20;
    double thickness = 0.12;
    double leaf = 0.3;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.depth,
              Field{.name = "depth", .help = "Number of forks from the trunk to a twig", .low = 0, .high = 10});
        visit(self.branch, Field{.name = "branch",
                                 .help = "Length of a branch before shrinking",
                                 .unit = unit::length,
                                 .low = 1e-6,
                                 .high = 1e6});
        visit(
            self.shrink,
            Field{
                .name = "shrink",
                .help =
                    "Length of the trunk as a share of branch; the share is squared at each fork, down to a hundredth",
                .low = 0.8,
                .high = 1});
        visit(self.spread, Field{.name = "spread",
                                 .help = "Angle between a branch and each of its forks",
                                 .unit = unit::angle,
                                 .low = pi<double> / 180,
                                 .high = pi<double> / 2});
        visit(self.bend_stiffness, Field{.name = "bend_stiffness",
                                         .help = "Resistance of the trunk to bending (E I of a rod)",
                                         .unit = {.length = 3, .mass = 1, .time = -2},
                                         .low = 1e-6,
                                         .high = 1e12});
        visit(
            self.joint_relaxation,
            Field{.name = "joint_relaxation",
                  .help = "Share of the lowest joint's error removed in a pass, decreasing with height (classic mode)",
                  .low = 0,
                  .high = 1});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness of the trunk at its foot, as drawn",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = 1e6});
        visit(self.leaf, Field{.name = "leaf",
                               .help = "Diameter of a tuft of leaves; 0 for no leaves",
                               .unit = unit::length,
                               .low = 0,
                               .high = 1e6});
    }

    Sizes sizes() const {
        const auto branches = (std::size_t(2) << std::size_t(depth)) - 1;
        return {.particles = branches + 2, .constraints = 2 * branches + 1};
    }
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew
