#include "sinew/math/random.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/sweep/wind_at.h"

#include <type_traits>

namespace sinew {
namespace {

/// Adds a field's effect on a particle; an overload per field. Results are clamped to the limits for any parameters.
template <int D, class Real> struct Adder {
    const World<D, Real>& world;
    Row row;
    const Vec<D, Real>& position;
    Forcing<D, Real>& forcing;

    Real rate(Real strength) const {
        return clamp(strength * world.particles.inverse_mass[row], Real(0), limit::measure<Real>);
    }
    void accelerate(const Vec<D, Real>& acceleration) const {
        forcing.acceleration += clamp_components(acceleration, largest_acceleration<Real>);
    }

    void operator()(const Gravity<D, Real>& gravity) const { accelerate(gravity.acceleration); }
    void operator()(const Drag<D, Real>& drag) const { forcing.drag_rate += rate(drag.strength); }
    void operator()(const Wind<D, Real>& wind) const {
        if (const auto index = world.particles.figure[row];
            index < world.figures.size() && world.figures[index].faces_wind)
            return; // acts on areas: apply_winds
        accelerate(wind_at(wind, position, world.time) * rate(wind.strength));
        forcing.drag_rate += rate(wind.strength);
    }
    void operator()(const Attractor<D, Real>& attractor) const {
        if (!pulls(attractor, world.particles.figure[row])) return;
        const auto offset = position - attractor.center;
        const Real softened = square_root(dot(offset, offset) + square(attractor.softness));
        const Real per_length = inverse_or_zero(softened);
        const Real pull = clamp(attractor.strength * per_length * per_length, -largest_acceleration<Real>,
                                largest_acceleration<Real>);
        accelerate(offset * per_length * -pull);
    }
    void operator()(const RandomPush<D, Real>&) const {} // acts once a step: apply_random_pushes
};

} // namespace

template <int D, class Real>
Forcing<D, Real> forcing_on(const World<D, Real>& world, Row row, const Vec<D, Real>& position) {
    Forcing<D, Real> forcing;
    const Adder<D, Real> add{world, row, position, forcing};
    for (const auto& force : world.forces) std::visit(add, force);
    add.accelerate(world.particles.force[row] * world.particles.inverse_mass[row]);
    forcing.acceleration = clamp_components(forcing.acceleration, largest_acceleration<Real>);
    forcing.drag_rate = min(forcing.drag_rate, limit::measure<Real>);
    return forcing;
}

template <int D, class Real> void apply_random_pushes(World<D, Real>& world) {
    auto& p = world.particles;
    if (p.size() == 0) return;
    for (const auto& force : world.forces) {
        const auto* random_push = std::get_if<RandomPush<D, Real>>(&force);
        if (!random_push) continue;
        const auto row = std::size_t(random::whole(0, std::int64_t(p.size()) - 1, random_push->seed, D, world.steps));
        p.any_force = true;
        p.force[row] += Vec<D, Real>::map([&](int i) {
            constexpr Real max = Real(1e9); // whole() draws from fewer than 2^32 numbers
            const auto low = std::int64_t(clamp(random_push->low[i], -max, max));
            const auto high = std::int64_t(clamp(random_push->high[i], Real(low), max));
            return Real(random::whole(low, high, random_push->seed, std::uint64_t(i), world.steps));
        });
    }
}

template <int D, class Real> void forget_forces(World<D, Real>& world) {
    auto& particles = world.particles;
    if (!std::exchange(particles.any_force, false)) return;
    for (auto& force : particles.force)
        if (force != Vec<D, Real>{}) force = {};
}

#define SINEW_FORCE(D, Real)                                                                                           \
    template Forcing<D, Real> forcing_on(const World<D, Real>&, Row, const Vec<D, Real>&);                             \
    template void apply_random_pushes(World<D, Real>&);                                                                \
    template void forget_forces(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_FORCE)

} // namespace sinew
