#include "sinew/solver/contact/kept_contacts.h"
#include "sinew/solver/profile.h"
#include "sinew/solver/step/coupled_sweep.h"
#include "sinew/solver/sweep/repair_window.h"
#include "sinew/solver/sweep/wavefront_sweep.h"

namespace sinew {
namespace {

template <int D, class Real> void begin(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    world.events.clear();
    wake(world, solver, dt);
    damp_internally(world, solver, dt);
    find_alone(world, solver, dt);
    if (world.settings.mode == Mode::classic) detail::make_room_for_widest(world, solver.scratch);
    hold_in_limits(world, solver);
    apply_random_pushes(world);
    apply_winds(world, solver, dt);
    begin_touches(world, solver);
}

template <int D, class Real> void step_sweep(World<D, Real>& world, Solver<D, Real>& solver, int count, Real h) {
    const auto& plan = solver.sweep_state.plan;
    const bool is_simple = plan.others.empty() && solver.blocks.list.empty() && solver.blocks.ports.rows.empty();
    const bool motorized = !is_simple && any_driven(world);
    if (solver.sweep_state.size() == 0 && !motorized) return forget_contacts(world);
    begin_sweep(world, solver, h);
    begin_rolling(world, solver, h);
    find_contact_features(world, solver);
    const detail::Substeps<D, Real> substeps(world, solver, count, h);
    const bool is_coupled =
        !plan.others.empty() || motorized || !solver.blocks.attached_trees.empty() || has_figure_contacts(solver);
    if (is_coupled)
        detail::CoupledSweep<D, Real>(world, solver, substeps, motorized).run();
    else
        detail::WavefrontSweep<D, Real>(world, solver, substeps).run();
    detail::set_repair_window(world, solver);
}

template <int D, class Real>
void physical_step(World<D, Real>& world, Solver<D, Real>& solver, Real dt, detail::Laps& laps) {
    const int substeps = world.settings.substeps > 0 ? world.settings.substeps : usual_substeps;
    const Real h = dt / Real(substeps);
    solver.prepare(world);
    note_energy(world, solver);
    laps.end(Phase::prepare);
    step_blocks(world, solver, dt, h);
    laps.end(Phase::blocks);
    step_sweep(world, solver, substeps, h);
    end_rolling(world, solver, dt);
    world.last_step = dt;
    world.last_substep = h;
    bound_energy(world, solver, dt);
}

template <int D, class Real> void end(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    fall_asleep(world, solver, dt);
    end_touches(world, solver);
    tear(world, solver, dt);
    for (auto& pin : world.pins) pin.from = pin.target;
    forget_forces(world);
    world.time += double(dt);
    ++world.steps;
    note_sleep_parameters(world);
}

} // namespace

template <int D, class Real> void Solver<D, Real>::step(World<D, Real>& world, Real dt) {
    if (!(dt >= limit::shortest_step<Real>)) return;
    dt = min(dt, limit::step<Real>);
    follow(world);
    const ThreadsOfSteps threads(options.program_threads);
    detail::Laps laps(reports.times.get());
    begin(world, *this, dt);
    if (world.settings.mode == Mode::classic)
        classic_step(world, *this, dt);
    else
        physical_step(world, *this, dt, laps);
    laps.end(Phase::sweep);
    end(world, *this, dt);
    laps.end(Phase::finish);
}

#define SINEW_STEP(D, Real) template void Solver<D, Real>::step(World<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_STEP)

} // namespace sinew
