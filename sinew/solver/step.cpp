#include "sinew/solver/step.h"

#include "sinew/solver/decay.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/project.h"

#include <algorithm>

namespace sinew {
namespace {

/// Constraints act on velocities: a particle is where it will be when the substep ends, x + h v, and a correction of
/// that place is a correction of v. Small differences of large coordinates are never taken, so float loses least.
/// Nothing is faster than what crosses the world in one substep: places stay finite.
template <int D, class RealT> struct SubstepMover {
    using Real = RealT;
    static constexpr int dimension = D;
    Particles<D, Real>& particles;
    Real h;
    Real per_h = Real(1) / h;
    Real fastest = minimum(limit::speed<Real>, Real(2) * limit::coordinate<Real> * per_h);
    bool first_iteration = true;

    Vec<D, Real> point(Row row) const { return particles.position[row] + particles.velocity[row] * h; }
    Real weight(Row row) const { return particles.mobility[row]; }
    Real alpha(Real compliance) const { return minimum(compliance * per_h * per_h, limit::measure<Real>); }
    Real most(Real max_force) const { return minimum(max_force * h * h, limit::multiplier<Real>); }
    Real share(Real lead) const { return minimum(lead * per_h, limit::coordinate<Real>); }
    /// The measure's own rate, less the rate of its limits, times the lead.
    template <class Stencil>
    Real ahead(const Stencil& stencil, std::span<const Row> members, Real lead, Real rate) const {
        Real own = -rate;
        stencil.each([&](std::size_t i) { own += dot(stencil.gradient[i], particles.velocity[members[i]]); });
        return own * lead;
    }
    void push(Row row, const Vec<D, Real>& displacement) { accelerate(row, displacement * per_h); }
    void accelerate(Row row, const Vec<D, Real>& change) {
        particles.velocity[row] = clamp_components(particles.velocity[row] + change, fastest);
    }

    /// Corrections along the gradient where the substep began (SHAKE: Ryckaert, Ciccotti and Berendsen 1977) keep a
    /// swing's energy; along the gradient where it ends they bleed it. Where the two have come apart only the latter
    /// still corrects.
    template <class Stencil> void choose_direction(Stencil& stencil, std::span<const Row> members) const {
        stencil.each([&](std::size_t i) { stencil.points[i] = particles.position[members[i]]; });
        stencil.evaluate(stencil.points, stencil.direction);
        Real along = 0, now = 0, then = 0;
        stencil.each([&](std::size_t i) {
            along += dot(stencil.gradient[i], stencil.direction[i]);
            now += dot(stencil.gradient[i], stencil.gradient[i]);
            then += dot(stencil.direction[i], stencil.direction[i]);
        });
        constexpr Real least_agreement = Real(0.99);
        if (along < least_agreement * maximum(now, then)) stencil.direction = stencil.gradient;
    }
};

/// The rows of particles that no block moves.
template <int D, class Real> RowRange loose(const World<D, Real>& world) {
    return RowRange{world.blocks.loose};
}

/// x* = x + h v + h^2 a, time-corrected when h changes: the kick spans from the middle of the last substep to the
/// middle of this one. What holds against a push is held back by drag as the push is: a weight at rest pulls with its
/// weight, however it is damped.
template <int D, class Real> void predict(World<D, Real>& world, const SubstepMover<D, Real>& mover) {
    auto& p = world.particles;
    const Real kick = Real(0.5) * (world.last_substep + mover.h);
    Decay<Real> decay; // most particles have the same
    for (const Row row : loose(world)) {
        p.rebound[row] = {};
        if (p.mobility[row] == Real(0)) {
            p.velocity[row] = {}; // it stands, unless a pin carries it
            continue;
        }
        const auto push = push_on(world, row);
        const Real rate = clamp(world.settings.damping + push.drag_rate, Real(0), limit::measure<Real>);
        if (rate != decay.rate) decay = Decay<Real>::of(rate, kick);
        const auto pushed = p.velocity[row] * decay.keep + push.acceleration * (kick * decay.yield);
        p.velocity[row] = clamp_components(pushed, mover.fastest);
        p.mobility[row] = maximum(p.inverse_mass[row] * decay.yield, std::numeric_limits<Real>::min());
    }
    world.last_substep = mover.h;
}

/// Hard pins are where they are told to be; the substep's share of the way gives the particle its velocity.
template <int D, class Real> void move_pins(World<D, Real>& world, Real share, const SubstepMover<D, Real>& mover) {
    auto& p = world.particles;
    for (const auto& pin : world.pins) {
        const auto row = p.slots.find(pin.particle);
        if (!row || !pin.hard() || p.quarantined[*row]) continue;
        const auto goal = pin.from + (pin.target - pin.from) * share;
        p.velocity[*row] = clamp_components((goal - p.position[*row]) * mover.per_h, mover.fastest);
    }
}

/// A compliant pin is a damped spring to its target: dlambda = -(e + alpha lambda + gamma u) / (w (1 + gamma) + alpha),
/// e the way to the target and u how much the substep adds to it; its force never exceeds max_force.
template <int D, class Real>
void pull_pins(World<D, Real>& world, Real share, Real share_of_substep, SubstepMover<D, Real>& mover) {
    auto& p = world.particles;
    for (auto& pin : world.pins) {
        const auto row = p.slots.find(pin.particle);
        if (!row || pin.hard() || p.mobility[*row] == Real(0) || world.blocks.holds[*row]) continue;
        const Real w = p.mobility[*row];
        const Real alpha = mover.alpha(pin.compliance);
        // a critical damper of stiffness 1/c on mass 1/w has 2 / sqrt(c w); gamma = damper * compliance / h
        const Real gamma =
            minimum(Real(2) * pin.damping * square_root(pin.compliance) * square_root(inverse_or_zero(w)) * mover.per_h,
                    limit::measure<Real>);
        const auto goal = pin.from + (pin.target - pin.from) * share;
        const auto error = mover.point(*row) - goal;
        const auto last_goal = pin.from + (pin.target - pin.from) * (share - share_of_substep);
        const auto drift = error - (p.position[*row] - last_goal);
        const auto lambda = mover.first_iteration ? Vec<D, Real>{} : pin.multiplier;
        const Real per_resistance = inverse_or_zero(w * (Real(1) + gamma) + alpha);
        auto next = clamp_components(lambda - (error + lambda * alpha + drift * gamma) * per_resistance,
                                     limit::multiplier<Real>);
        if (pin.max_force > Real(0)) {
            const Real most = pin.max_force * mover.h * mover.h;
            next *= minimum(Real(1), most * inverse_or_zero(norm(next)));
        }
        mover.push(*row, (next - lambda) * w);
        pin.multiplier = next;
    }
}

/// A plane stops what would pass it and rubs: the speed along it falls by friction times the speed it took away. What
/// strikes faster than resting things sink in a few substeps will rebound.
template <int D, class Real> void keep_in_bounds(World<D, Real>& world, SubstepMover<D, Real>& mover) {
    auto& p = world.particles;
    for (const auto& plane : world.bounds)
        for (const Row row : loose(world)) {
            if (p.mobility[row] == Real(0)) continue;
            const Real depth = plane.offset + p.radius[row] - dot(plane.normal, mover.point(row));
            if (!(depth > Real(0))) continue;
            const Real approach = -dot(plane.normal, p.velocity[row]);
            const auto along = p.velocity[row] + plane.normal * approach;
            const Real stopped = minimum(depth * mover.per_h, mover.fastest);
            const Real slowed = minimum(Real(1), plane.friction * stopped * inverse_or_zero(norm(along)));
            mover.accelerate(row, plane.normal * stopped - along * slowed);
            if (!mover.first_iteration) continue;
            const Real resting = Real(4) * mover.h * norm(push_on(world, row).acceleration);
            if (approach > resting) p.rebound[row] += plane.normal * (plane.restitution * approach);
        }
}

/// x += h v. What rounding takes away is carried to the next substep: without it a float particle slower than half a
/// unit in the last place a substep would stand still.
template <int D, class Real> void advance(World<D, Real>& world, Real h) {
    auto& p = world.particles;
    for (const Row row : loose(world)) {
        const auto move = p.velocity[row] * h + p.residual[row];
        const auto moved = p.position[row] + move;
        const auto held = clamp_components(moved, limit::coordinate<Real>);
        p.residual[row] = moved == held ? move - (moved - p.position[row]) : Vec<D, Real>{};
        p.previous[row] = p.position[row];
        p.position[row] = held;
    }
}

/// What struck a plane leaves it with its restitution.
template <int D, class Real> void rebound(World<D, Real>& world) {
    auto& p = world.particles;
    for (const Row row : loose(world)) {
        const Real speed = norm(p.rebound[row]);
        if (speed == Real(0)) continue;
        const auto away = p.rebound[row] * inverse_or_zero(speed);
        p.velocity[row] += away * maximum(Real(0), speed - dot(away, p.velocity[row]));
    }
}

template <int D, class Real> void begin(World<D, Real>& world) {
    world.events.clear();
    quarantine_non_finite(world);
    hold_in_limits(world);
    apply_random_pushes(world);
}

template <int D, class Real> void end(World<D, Real>& world, Real dt) {
    tear(world, dt);
    for (auto& pin : world.pins) pin.from = pin.target;
    std::fill(world.particles.force.begin(), world.particles.force.end(), Vec<D, Real>{});
    world.time += double(dt);
    ++world.steps;
}

/// What is in no block: substeps of projections.
template <int D, class Real> void sweep_substeps(World<D, Real>& world, int substeps, Real h) {
    const Real share_of_substep = Real(1) / Real(substeps);
    const bool driven = any_driven(world);
    for (int s = 1; s <= substeps; ++s) {
        const Real share = Real(s) / Real(substeps);
        SubstepMover<D, Real> mover{world.particles, h};
        if (driven) move_limits(world, h);
        predict(world, mover);
        move_pins(world, share, mover);
        note_energy(world);
        for (int i = 0; i < world.settings.iterations; ++i) {
            mover.first_iteration = i == 0;
            for (const auto& run : world.blocks.runs) detail::project_run(world, run, mover);
            correct_hanging(world, h, mover.first_iteration);
            pull_pins(world, share, share_of_substep, mover);
            keep_in_bounds(world, mover);
        }
        advance(world, h);
        take_back_gains(world, h);
        rebound(world);
        if (driven) slip(world, h);
    }
}

template <int D, class Real> void physical_step(World<D, Real>& world, Real dt) {
    const int substeps = world.settings.substeps > 0 ? world.settings.substeps : usual_substeps;
    const Real h = dt / Real(substeps);
    prepare(world);
    find_passive(world);
    step_blocks(world, dt, h);
    sweep_substeps(world, substeps, h);
}

} // namespace

template <int D, class Real> void step(World<D, Real>& world, Real dt) {
    if (!(dt >= limit::shortest_step<Real>)) return;
    dt = minimum(dt, limit::step<Real>);
    begin(world);
    if (world.settings.mode == Mode::classic)
        classic_step(world, dt);
    else
        physical_step(world, dt);
    end(world, dt);
}

#define SINEW_STEP(D, Real) template void step(World<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_STEP)

} // namespace sinew
