#include "sinew/math/random.h"
#include "sinew/solver/phases.h"

#include <cmath>

namespace sinew {
namespace {

/// Smooth noise in [-1, 1]: a random value at each whole t, eased between (3 s^2 - 2 s^3), one stream a component.
template <class Real> Real noise(double t, std::uint64_t seed, std::uint64_t stream) {
    const double whole = std::floor(t);
    const auto n = std::uint64_t(std::int64_t(whole));
    const Real s = Real(t - whole);
    const Real before = random::symmetric<Real>(seed, stream, n), after = random::symmetric<Real>(seed, stream, n + 1);
    return before + (after - before) * (s * s * (Real(3) - Real(2) * s));
}

template <int D, class Real> Vec<D, Real> wind_at(const Wind<D, Real>& wind, const Vec<D, Real>& place, double time) {
    const Real behind = wind.gust_size > Real(0) ? dot(place, direction(wind.velocity)) / wind.gust_size : Real(0);
    const double t =
        clamp(time / double(wind.gust_period), -1e15, 1e15) - double(clamp(behind, Real(-1e15), Real(1e15)));
    return wind.velocity +
           Vec<D, Real>::map([&](int i) { return wind.gust[i] * noise<Real>(t, wind.seed, std::uint64_t(i)); });
}

/// Adds what one field does to one particle. A new field is one more of these.
template <int D, class Real> struct Adder {
    const World<D, Real>& world;
    Row row;
    Push<D, Real>& push;

    const Vec<D, Real>& place() const { return world.particles.position[row]; }
    Real weight() const { return world.particles.mobility[row]; }

    void operator()(const Gravity<D, Real>& gravity) const { push.acceleration += gravity.acceleration; }
    void operator()(const Drag<D, Real>& drag) const { push.drag_rate += drag.strength * weight(); }
    void operator()(const Wind<D, Real>& wind) const {
        const Real rate = wind.strength * weight();
        push.acceleration += wind_at(wind, place(), world.time) * rate;
        push.drag_rate += rate;
    }
    void operator()(const Attractor<D, Real>& attractor) const {
        const auto offset = place() - attractor.center;
        const Real softened = square_root(dot(offset, offset) + square(attractor.softness));
        const Real per_length = inverse_or_zero(softened);
        push.acceleration -= offset * (attractor.strength * per_length * per_length * per_length);
    }
    void operator()(const RandomPush<D, Real>&) const {} // strikes once a step: apply_random_pushes
};

} // namespace

template <int D, class Real> Push<D, Real> push_on(const World<D, Real>& world, Row row) {
    Push<D, Real> push;
    const Adder<D, Real> add{world, row, push};
    for (const auto& force : world.forces) std::visit(add, force);
    push.acceleration += world.particles.force[row] * world.particles.mobility[row];
    push.acceleration = clamp_components(push.acceleration, limit::force<Real> * limit::mass<Real>);
    push.drag_rate = clamp(push.drag_rate, Real(0), limit::measure<Real>);
    return push;
}

template <int D, class Real> void apply_random_pushes(World<D, Real>& world) {
    auto& p = world.particles;
    if (p.size() == 0) return;
    for (const auto& force : world.forces) {
        const auto* random_push = std::get_if<RandomPush<D, Real>>(&force);
        if (!random_push) continue;
        const auto row = std::size_t(random::whole(0, std::int64_t(p.size()) - 1, random_push->seed, D, world.steps));
        p.force[row] += Vec<D, Real>::map([&](int i) {
            return Real(random::whole(std::int64_t(random_push->low[i]), std::int64_t(random_push->high[i]),
                                      random_push->seed, std::uint64_t(i), world.steps));
        });
    }
}

#define SINEW_FORCE(D, Real)                                                                                           \
    template Push<D, Real> push_on(const World<D, Real>&, Row);                                                        \
    template void apply_random_pushes(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_FORCE)

} // namespace sinew
