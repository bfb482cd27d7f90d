#pragma once

#include "sinew/math/moments.h"

namespace sinew {

/// Share of the kinetic energy, and of weight times size, that a step may gain under pins and walls: figures that swing
/// between a pin and a sweep at 1 to 64 substeps gain and lose up to half of it by turns (tests/property). In free
/// flight nothing swings; 120 steps then stay within a quarter of a thousandth.
constexpr double energy_tolerance = 1e-4, free_energy_tolerance = 2e-6;

/// Energy and momentum of a body, or of an island of bodies, before and after a step; J, kg m/s.
template <int D> struct EnergyGain {
    using Vector = Vec<D, double>;
    double mass = 0, kinetic = 0; ///< after the step
    double faster = 0;            ///< gained in kinetic energy
    double higher = 0;            ///< gained in the potential of gravity, at the ends of substeps
    double midway = 0;            ///< the same in their middles, where free flight keeps the energy exactly
    double tenser = 0;            ///< gained in springs
    double second = 0;            ///< second moment of mass, kg m^2
    Vector before{}, after{};     ///< momenta
    Vector weight{};              ///< times the time between them
    double slack = 0;             ///< weight times size, as a share
    double rounding = 0;          ///< of the momentum
    bool springs = false;         ///< with springs: at the ends of substeps, implicit steps never add to the sum
    bool is_bounded = false;      ///< a pin holds it, or there are walls
    bool is_held = false;         ///< by a particle that does not move
    bool swept = false;           ///< not wholly in a direct block, which keeps its energy itself

    /// True if a pin or a wall has changed the momentum.
    bool is_pushed() const {
        if (!is_bounded) return false;
        constexpr double little = 1e-6;
        const double inner = max(2 * mass * kinetic - dot(after, after), 0.0); // alike in every frame
        return norm(after - before - weight) > little * (norm(weight) + square_root(inner)) + rounding;
    }

    /// Gain of this body in an island: beside what pushes it or, if nothing does, about its centre of mass.
    double seen_from(const EnergyGain& island, bool pushed) const {
        if (pushed) return faster + (springs ? min(higher, midway) : midway) + tenser;
        const auto from = island.before * inverse_or_zero(island.mass),
                   to = island.after * inverse_or_zero(island.mass);
        return faster - dot(to, after) + dot(from, before) + 0.5 * mass * (dot(to, to) - dot(from, from)) + tenser;
    }
    /// Gain that discretization or rounding may have made: shares of the energy without the gain.
    double tolerance(bool pushed) const {
        const double due = kinetic - max(seen_from(*this, pushed), 0.0);
        if (pushed) return energy_tolerance * max(due, 0.0) + slack;
        const double inner = max(due - 0.5 * dot(after, after) * inverse_or_zero(mass), 0.0);
        return free_energy_tolerance * inner + rounding * square_root(2 * inner * inverse_or_zero(mass));
    }
    /// True if an island with this body may have gained energy: bodies that part gain none about their own centres.
    bool may_have_gained() const {
        const auto exceeds = [&](bool pushed) { return seen_from(*this, pushed) > tolerance(pushed); };
        return swept && (exceeds(false) || exceeds(true));
    }

    EnergyGain& operator+=(const EnergyGain& other) {
        mass += other.mass, kinetic += other.kinetic, faster += other.faster;
        higher += other.higher, midway += other.midway, tenser += other.tenser;
        before += other.before, after += other.after, weight += other.weight;
        slack += other.slack, rounding += other.rounding;
        springs = springs || other.springs, is_bounded = is_bounded || other.is_bounded;
        is_held = is_held || other.is_held, swept = swept || other.swept;
        return *this;
    }
};

/// Bodies near enough to have touched each other in a step.
template <int D> struct IslandGain {
    EnergyGain<D> sum;
    int bodies = 0;
    bool pushed = false; ///< by a pin or a wall
    double all = 0;      ///< what single bodies gained, without losses
    double left = 0;     ///< what could not be taken from its bodies one by one
    double apart = 0;    ///< kinetic energy of the motion of its bodies past each other
};

} // namespace sinew
