#pragma once

#include "sinew/solver/edit.h"

#include <cstdint>

/// What a world has and is: measured, never changed. Sums are taken in double and in the order of rows.
namespace sinew {

/// In the world's own units (joules where those are metres, kilograms and seconds). Particles that nothing moves have
/// none.
struct Energy {
    double kinetic = 0;
    double potential = 0; ///< of gravity (zero at the origin) and attractors (zero far away)
    double stored = 0;    ///< in compliant constraints and pins
    /// What ropes, chains and figures that are solved at once had to give up since the world began, not to damping but
    /// where they struck a plane, came to the end of a damped joint, snapped taut or cracked. Not of what something
    /// drives, for there nobody knows; nor of what is swept.
    double lost = 0;
    double total() const { return kinetic + potential + stored; }
};

/// Verlet's velocity belongs to the middle of a substep, so potentials are taken there too: half way from previous to
/// position.
template <int D, class Real> Energy energy(const World<D, Real>& world);
/// Of one figure: its particles, and what is stored in its own constraints and pins. `lost` is not told.
template <int D, class Real> Energy energy_of(const World<D, Real>& world, FigureIndex figure);
/// Of one particle, without what constraints store.
template <int D, class Real> Energy energy_of(const World<D, Real>& world, ParticleId id);

template <int D, class Real> Vec<D, double> momentum(const World<D, Real>& world);
/// About the origin, at the middle of the last substep; in 2D the third component is the only one.
template <int D, class Real> Vec3<double> angular_momentum(const World<D, Real>& world);
/// Zero for a world without movable mass.
template <int D, class Real> Vec<D, double> center_of_mass(const World<D, Real>& world);
template <int D, class Real> double total_mass(const World<D, Real>& world);
template <int D, class Real> double max_speed(const World<D, Real>& world);

/// Strain of distance constraints, as fractions of their rest length; slack ropes have none.
struct Stretch {
    double max = 0, mean = 0;
    std::size_t count = 0;
};
template <int D, class Real> Stretch stretch(const World<D, Real>& world);

/// One number over everything that decides the future: equal on every machine, compiler, optimisation and thread count.
template <int D, class Real> std::uint64_t state_hash(const World<D, Real>& world);

} // namespace sinew
