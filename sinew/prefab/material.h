#pragma once

#include "sinew/math/record.h"
#include "sinew/world/edit.h"

#include <optional>
#include <string_view>

/// Material of links. A prefab holds these records as members and visits their fields among its own: a scene file lists
/// them side by side with the others.
namespace sinew {

/// Elasticity of links.
struct Elasticity {
    double compliance = 0; ///< 1 / stiffness, m/N for distances and rad/(N m) for angles; 0 is rigid

    /// Elasticity of the joint between two pieces of a rod. The joint carries the bending energy of one piece:
    /// bend_stiffness / 2 angle^2 / piece.
    static Elasticity of_rod(double piece, double bend_stiffness) { return {piece / bend_stiffness}; }

    ConstraintSpec<double> spec(std::optional<Interval<double>> limits = {}) const {
        return {.limits = limits, .compliance = compliance};
    }

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit, std::string_view help, double lowest = 0,
                       std::string_view name = "compliance") {
        visit(self.compliance, Field{.name = name, .help = help, .unit = unit::compliance, .low = lowest, .high = 1e9});
    }
};

/// Strength of links: the load that they bear without tearing.
struct Strength {
    double breaking_strain = 0; ///< 0 for never; a rigid link has no strain
    double break_force = 0;     ///< N (N m for angles); 0 for never
    double damage_limit = 0;    ///< s

    ConstraintSpec<double> applied_to(ConstraintSpec<double> spec) const {
        if (breaking_strain > 0) spec.breaking_strain = breaking_strain;
        if (break_force > 0) spec.break_force = break_force;
        spec.damage_limit = damage_limit;
        return spec;
    }

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit, std::string_view help) {
        visit(self.breaking_strain, Field{.name = "breaking_strain", .help = help, .low = 0, .high = 1e6});
        visit(self.break_force, Field{.name = "break_force",
                                      .help = "Force (torque for an angle) above which it tears, rigid or not; 0 for "
                                              "never. Physical mode only",
                                      .unit = unit::force,
                                      .low = 0,
                                      .high = 1e15});
        visit(self.damage_limit,
              Field{.name = "damage_limit",
                    .help = "Time integral of the strain above breaking_strain needed to tear: 0.1 is an excess of 10 "
                            "% for one second; 0 tears at once",
                    .unit = unit::time,
                    .low = 0,
                    .high = 1e6});
    }
};

} // namespace sinew
