#include "sinew/solver/step.h"

#include "sinew/solver/substep.h"

namespace sinew {
namespace {

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
template <int D, class Real> class Sweep {
  public:
    Sweep(World<D, Real>& world, int substeps, Real h)
        : world_(world), plan_(world.swept.plan), kernels_(kernels<D, Real>()), substeps_(substeps), h_(h) {}

    void run() {
        if (world_.swept.size() == 0) return;
        take_up(world_, h_);
        if (all_is_plain())
            for (const auto& sheet : plan_.sheets) run_through(sheet);
        else
            for (int s = 1; s <= substeps_; ++s) run_substep(s);
        put_back(world_);
        world_.last_substep = h_;
    }

  private:
    World<D, Real>& world_;
    const Plan<Real>& plan_;
    const Kernels<D, Real>& kernels_;
    int substeps_;
    Real h_;

    using Substep = detail::Substep<D, Real>;

    bool all_is_plain() const { return plan_.others.empty() && world_.blocks.hanging.empty() && !world_.budgets.any; }

    /// A substep of everything.
    void run_substep(int number) {
        move_limits(world_, h_);
        Substep substep(world_, number, substeps_, h_);
        auto& mover = substep.mover();
        for (const auto& band : plan_.bands) substep.predict(band);
        note_energy(world_);
        for (int i = 0; i < world_.settings.iterations; ++i) {
            mover.first_iteration = i == 0;
            for (const auto& sheet : plan_.sheets)
                for (std::uint32_t f = 0; f < sheet.families; ++f)
                    for (std::uint32_t band = 0; band < sheet.bands; ++band)
                        substep.project(kernels_, plan_.families[sheet.first_family + f], band);
            for (const auto& run : plan_.others) detail::project_run(world_, run, mover);
            correct_hanging(world_, h_, mover.first_iteration);
            for (const auto& band : plan_.bands) substep.pull_pins(band);
            for (const auto& band : plan_.bands) substep.keep_in_bounds(kernels_, band);
        }
        for (const auto& band : plan_.bands) substep.advance(kernels_, band);
        take_back_gains(world_, h_);
        for (const auto& band : plan_.bands) substep.rebound(band);
        slip(world_, h_);
    }

    /// All substeps of a sheet, band after band: each part of a substep follows the one before it as closely as what it
    /// touches allows, so that a band is worked on while it is near. The result is the same to the last bit.
    void run_through(const Sheet& sheet) {
        const int parts = parts_of(sheet);
        const std::uint32_t last = delay_of(sheet, substeps_ * parts - 1) + sheet.bands;
        for (std::uint32_t time = 0; time < last; ++time)
            for (int part = 0; part < substeps_ * parts; ++part) {
                const auto delay = delay_of(sheet, part);
                if (delay > time) break;
                if (time - delay < sheet.bands) run_part(sheet, part / parts, part % parts, time - delay);
            }
    }

    /// Predict; the families and what holds, as often as there are iterations; advance.
    int parts_of(const Sheet& sheet) const { return 2 + world_.settings.iterations * (int(sheet.families) + 1); }

    std::uint32_t delay_of(const Sheet& sheet, int part) const {
        const int parts = parts_of(sheet), substep = part / parts, k = part % parts - 1;
        const auto lag = sheet.lag * std::uint32_t(world_.settings.iterations);
        const auto begun = std::uint32_t(substep) * lag;
        if (k < 0) return begun;
        if (k == parts - 2) return begun + lag;
        const int families = int(sheet.families) + 1;
        const auto f = std::uint32_t(k % families);
        return begun + std::uint32_t(k / families) * sheet.lag +
               (f < sheet.families ? plan_.families[sheet.first_family + f].delay : sheet.lag);
    }

    void run_part(const Sheet& sheet, int number, int part, std::uint32_t at) {
        Substep substep(world_, number + 1, substeps_, h_);
        const auto& band = plan_.bands[sheet.first_band + at];
        if (part == 0) return substep.predict(band);
        if (part == parts_of(sheet) - 1) {
            substep.advance(kernels_, band);
            return substep.rebound(band);
        }
        const auto families = sheet.families + 1, family = std::uint32_t(part - 1) % families;
        substep.mover().first_iteration = std::uint32_t(part - 1) < families;
        if (family < sheet.families) return substep.project(kernels_, plan_.families[sheet.first_family + family], at);
        substep.pull_pins(band);
        substep.keep_in_bounds(kernels_, band);
    }
};

template <int D, class Real> void physical_step(World<D, Real>& world, Real dt) {
    const int substeps = world.settings.substeps > 0 ? world.settings.substeps : usual_substeps;
    const Real h = dt / Real(substeps);
    prepare(world);
    find_passive(world);
    step_blocks(world, dt, h);
    Sweep<D, Real>(world, substeps, h).run();
    world.last_substep = h;
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
