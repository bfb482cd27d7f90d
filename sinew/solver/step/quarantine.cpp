#include "sinew/solver/phases.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/workers.h"
#include "sinew/world/changes.h"

#include <algorithm>
#include <atomic>

namespace sinew {
namespace {

/// True if rows [first, first + count) are within the limits; `previous` is checked in classic mode only.
template <int D, class Real>
bool all_in_limits(const World<D, Real>& world, const Kernels<D, Real>& checks, std::size_t first, std::size_t count) {
    const auto& p = world.particles;
    const auto vectors = [&](const std::vector<Vec<D, Real>>& column, Real limit) {
        static_assert(sizeof column[0] == D * sizeof limit);
        return checks.all_within(column[first].component.data(), count * D, limit);
    };
    return vectors(p.position, limit::coordinate<Real>) &&
           (world.settings.mode == Mode::physical || vectors(p.previous, limit::coordinate<Real>)) &&
           vectors(p.velocity, limit::speed<Real>) && (!p.any_force || vectors(p.force, limit::force<Real>)) &&
           checks.all_within(p.inverse_mass.data() + first, count, limit::mass<Real>) &&
           checks.all_within_and_positive(p.radius.data() + first, count, limit::coordinate<Real>);
}

/// Stores positions as `previous`, except in classic mode, where `previous` encodes velocity. In chunks of 64: for
/// more, memcpy takes an instruction (rep movsb) which is ten times slower on some processors.
template <int D, class Real> void note_previous(World<D, Real>& world, std::size_t first, std::size_t count) {
    if (world.settings.mode == Mode::classic) return;
    auto& p = world.particles;
    constexpr std::size_t few = 64;
    for (std::size_t i = 0; i < count; i += few)
        std::copy_n(p.position.data() + first + i, std::min(few, count - i), p.previous.data() + first + i);
}

/// True if all particles are within the limits, the usual case; updates `previous` while in cache.
template <int D, class Real> bool all_in_limits(World<D, Real>& world, const SolverOptions& options) {
    const auto& checks = kernels<D, Real>(options.simd);
    constexpr std::size_t a_part = 4096;
    const std::size_t size = world.particles.size();
    std::atomic<bool> all = true;
    Workers::run(threads_for(size, options.threads), int((size + a_part - 1) / a_part), [&](int part) {
        const auto first = std::size_t(part) * a_part, count = std::min(a_part, size - first);
        if (all_in_limits(world, checks, first, count))
            note_previous(world, first, count);
        else
            all = false;
    });
    return all;
}

template <int D, class Real> bool sound(const Particles<D, Real>& p, Row row) {
    return is_finite(p.position[row]) && is_finite(p.velocity[row]) && is_finite(p.force[row]) &&
           is_finite(p.previous[row]) && is_finite(p.inverse_mass[row]) && is_finite(p.radius[row]);
}

/// Freezes a particle at the last finite position; other non-finite values become zero.
template <int D, class Real> void freeze(World<D, Real>& world, Row row) {
    auto& p = world.particles;
    detail::note_mobility(world, row);
    if (!is_finite(p.position[row])) p.position[row] = is_finite(p.previous[row]) ? p.previous[row] : Vec<D, Real>{};
    p.previous[row] = p.position[row];
    p.velocity[row] = p.residual[row] = p.force[row] = {};
    if (!is_finite(p.inverse_mass[row])) p.inverse_mass[row] = Real(0);
    if (!is_finite(p.radius[row])) p.radius[row] = Real(0);
    p.mobility[row] = Real(0);
    p.quarantined[row] = 1;
}

template <int D, class Real> void freeze_figure(World<D, Real>& world, FigureIndex figure) {
    world.figures[figure].quarantined = true;
    for (const auto id : world.figures[figure].particles)
        if (const auto row = world.particles.handles.find(id)) freeze(world, *row);
}

template <int D, class Real> void quarantine_non_finite(World<D, Real>& world) {
    auto& p = world.particles;
    for (Row row = 0; row < p.size(); ++row) {
        if (sound(p, row)) continue;
        const FigureIndex figure = p.figure[row];
        freeze(world, row);
        if (figure < world.figures.size()) freeze_figure(world, figure);
        if (world.events.size() < events_per_step)
            world.events.push_back(
                {.type = EventType::quarantined, .figure = figure, .particle = p.handles.id_of(row)});
    }
}

template <int D, class Real> void hold(Particles<D, Real>& p) {
    for (Row row = 0; row < p.size(); ++row) {
        p.position[row] = clamp_components(p.position[row], limit::coordinate<Real>);
        p.previous[row] = clamp_components(p.previous[row], limit::coordinate<Real>);
        p.velocity[row] = clamp_components(p.velocity[row], limit::speed<Real>);
        p.force[row] = clamp_components(p.force[row], limit::force<Real>);
        p.radius[row] = clamp(p.radius[row], Real(0), limit::coordinate<Real>);
    }
}

} // namespace

template <int D, class Real> void hold_in_limits(World<D, Real>& world, Solver<D, Real>& solver) {
    if (!all_in_limits(world, solver.options)) {
        quarantine_non_finite(world);
        hold(world.particles);
        note_previous(world, 0, world.particles.size());
    }
    for (auto& pin : world.pins) {
        const auto within = [](const Vec<D, Real>& position) {
            return std::ranges::all_of(position.component,
                                       [](Real x) { return absolute(x) <= limit::coordinate<Real>; });
        };
        if (within(pin.from) && within(pin.target)) continue;
        if (!is_finite(pin.from)) pin.from = is_finite(pin.target) ? pin.target : Vec<D, Real>{};
        if (!is_finite(pin.target)) pin.target = pin.from;
        pin.from = clamp_components(pin.from, limit::coordinate<Real>);
        pin.target = clamp_components(pin.target, limit::coordinate<Real>);
    }
    for (auto& plane : world.bounds) {
        plane.offset = clamp(plane.offset, -limit::measure<Real>, limit::measure<Real>);
        plane.restitution = clamp(plane.restitution, Real(0), Real(1));
        plane.friction = clamp(plane.friction, Real(0), limit::measure<Real>);
    }
}

#define SINEW_QUARANTINE(D, Real) template void hold_in_limits(World<D, Real>&, Solver<D, Real>&);
SINEW_INSTANTIATE(SINEW_QUARANTINE)

} // namespace sinew
