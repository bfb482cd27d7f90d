#pragma once

#include "sinew/world/edit.h"

#include <cstdint>

/// Read-only measurements of a world. Sums are taken in double and in the order of rows.
namespace sinew {

/// Energies in the world's units (joules for metres, kilograms and seconds). Immovable particles contribute nothing.
struct Energy {
    double kinetic = 0;
    double potential = 0; ///< gravity (zero at the origin) and attractors (zero far away)
    double stored = 0;    ///< in compliant constraints and pins
    /// Energy dissipated by directly solved ropes, chains and figures since the world began, damping excluded: at
    /// planes, at the ends of damped joints, at taut snaps and cracks. Driven or swept constraints are not counted.
    double lost = 0;
    double total() const { return kinetic + potential + stored; }
};

/// Energy of the world. Potentials are taken where the velocity is known: in the middle of the last substep for swept
/// particles (Verlet's mean velocity), at the end for direct blocks and for other integrators of classic mode.
template <int D, class Real> Energy energy(const World<D, Real>& world);
/// Energy of the particles of a figure, and stored in the figure's constraints and pins. `lost` stays 0.
template <int D, class Real> Energy energy_of(const World<D, Real>& world, FigureIndex figure);
/// Energy of one particle, without the energy stored in constraints.
template <int D, class Real> Energy energy_of(const World<D, Real>& world, ParticleId id);

template <int D, class Real> Vec<D, double> momentum(const World<D, Real>& world);
/// Angular momentum about the origin, at the same points as energy(); in 2D only the third component is used.
template <int D, class Real> Vec3<double> angular_momentum(const World<D, Real>& world);
/// Centre of mass of the movable particles; zero if there are none.
template <int D, class Real> Vec<D, double> center_of_mass(const World<D, Real>& world);
template <int D, class Real> double total_mass(const World<D, Real>& world);
template <int D, class Real> double max_speed(const World<D, Real>& world);

/// Strain of distance constraints, as a fraction of the rest length; slack ropes have none.
struct Stretch {
    double max = 0, mean = 0;
    std::size_t count = 0;
};
template <int D, class Real> Stretch stretch(const World<D, Real>& world);

/// Hash of all state relevant to the future: equal on every machine, compiler, optimisation and thread count.
template <int D, class Real> std::uint64_t state_hash(const World<D, Real>& world);

} // namespace sinew
