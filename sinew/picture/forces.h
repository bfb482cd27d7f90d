#pragma once

#include "sinew/constraint/kinds.h"
#include "sinew/solver/phases.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace sinew {

/// Forces on particles, from the state after a step in physical mode. Unit: the world's own unit of force.
template <class WorldT> class Forces {
  public:
    static constexpr int D = WorldT::dimension;
    using Force = Vec<D, double>;

    /// Keeps a reference to the world.
    explicit Forces(const WorldT& world) : world_(world), internal_(world.particles.size()) {
        for_each_table(world, [&](const auto& table) {
            for (Row row = 0; row < table.size(); ++row) add_constraint(table, row);
        });
    }

    /// Sum of all force fields on a particle: weight, wind, drag, attraction.
    Force of_fields(Row row) const {
        const auto forcing = forcing_on(world_, row);
        const double mass = double(inverse_or_zero(world_.particles.inverse_mass[row]));
        return (cast<double>(forcing.acceleration) -
                cast<double>(world_.particles.velocity[row]) * double(forcing.drag_rate)) *
               mass;
    }

    /// Sum of all constraint forces on a particle: F = lambda grad C / h^2.
    const Force& of_constraints(Row row) const { return internal_[row]; }

    /// Reaction of a pin at rest: balances all other forces on the particle.
    Force of_pin(Row row) const { return -(of_fields(row) + of_constraints(row)); }

    /// Magnitude of a plane's normal force on a particle in resting contact, >= 0: a plane only pushes.
    double of_plane(Row row, const HalfSpace<D, typename WorldT::Real>& plane) const {
        return max(-dot(cast<double>(plane.normal), of_fields(row) + of_constraints(row)), 0.0);
    }

  private:
    const WorldT& world_;
    std::vector<Force> internal_; ///< by row of the particles

    template <class Table> void add_constraint(const Table& table, Row row) {
        using Kind = typename Table::Kind;
        const double strength = double(table.multiplier[row]) * inverse_or_zero(square(double(world_.last_substep)));
        if (strength == 0) return;
        const auto members = table.members[row];
        if constexpr (Kind::arity == any_arity) {
            std::vector<Force> positions, gradient(members.size());
            for (const Row member : members) positions.push_back(cast<double>(world_.particles.position[member]));
            Kind::evaluate(std::span<const Force>(positions), std::span<Force>(gradient));
            add(members, gradient, strength);
        } else {
            Points<Kind::arity, D, double> positions;
            for (std::size_t i = 0; i < positions.size(); ++i)
                positions[i] = cast<double>(world_.particles.position[members[i]]);
            add(members, Kind::evaluate(positions).gradient, strength);
        }
    }

    template <class Gradient> void add(std::span<const Row> members, const Gradient& gradient, double strength) {
        for (std::size_t i = 0; i < members.size(); ++i) internal_[members[i]] += gradient[i] * strength;
    }
};

} // namespace sinew
