#pragma once

#include "sinew/prefab/builder.h"

namespace sinew {

/// A tree on the ground where it stands: a trunk that forks, and forks again. Particles root (below the ground) and
/// base, both held, then particle_0 at the top of the trunk, particle_1, ... as one climbs, always to the left first;
/// constraints branch_0, ... below each of these, and joint_0, ..., the angle at the lower end of each. (After the tree
/// of verlet-js.)
///
/// Thickness follows Leonardo da Vinci's rule: the branches above a fork are together as thick, by cross section, as
/// the one below; a joint's stiffness goes with the fourth power of it.
struct Tree {
    static constexpr std::string_view name = "tree";
    static constexpr std::string_view about = "A tree that sways: branches that fork, and leaves on the last of them.";
    static constexpr Dimensions dimensions{2, 2};
    static constexpr double least_share = 0.01; ///< of `branch`: no twig is shorter

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
        visit(self.depth, Field{.name = "depth", .help = "How often it forks", .low = 0, .high = 10});
        visit(self.branch, Field{.name = "branch",
                                 .help = "Length of a branch that does not shrink",
                                 .unit = unit::length,
                                 .low = 1e-6,
                                 .high = 1e6});
        visit(self.shrink, Field{.name = "shrink",
                                 .help = "The trunk is this share of that, what forks from it the square of this "
                                         "share, and so on, squared at each fork down to a hundredth",
                                 .low = 0.8,
                                 .high = 1});
        visit(self.spread, Field{.name = "spread",
                                 .help = "From the way a branch goes to the way its forks go",
                                 .unit = unit::angle,
                                 .low = pi<double> / 180,
                                 .high = pi<double> / 2});
        visit(self.bend_stiffness, Field{.name = "bend_stiffness",
                                         .help = "Resistance of the trunk to bending (E I of a rod)",
                                         .unit = {.length = 3, .mass = 1, .time = -2},
                                         .low = 1e-6,
                                         .high = 1e12});
        visit(self.joint_relaxation,
              Field{.name = "joint_relaxation",
                    .help = "Share of its error that the lowest joint loses in a pass; joints above lose less, down "
                            "to nothing (classic mode)",
                    .low = 0,
                    .high = 1});
        visit(self.mass, Field{.name = "mass", .help = "Of the whole", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Of the trunk as drawn, at its foot",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = 1e6});
        visit(self.leaf, Field{.name = "leaf",
                               .help = "Diameter of a tuft of leaves; 0 has none",
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
