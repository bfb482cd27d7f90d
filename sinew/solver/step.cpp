#include "sinew/solver/step.h"

#include "sinew/solver/colliders.h"
#include "sinew/solver/ports/energy_limiter.h"
#include "sinew/solver/ports/port_coupling.h"
#include "sinew/solver/profile.h"
#include "sinew/solver/substep.h"
#include "sinew/solver/workers.h"

#include <algorithm>
#include <utility>

namespace sinew {
namespace {

template <int D, class Real> void begin(World<D, Real>& world) {
    world.events.clear();
    hold_in_limits(world);
    apply_random_pushes(world);
    begin_contacts(world);
}

template <int D, class Real> void forget_forces(Particles<D, Real>& particles) {
    if (!std::exchange(particles.any_force, false)) return;
    for (auto& force : particles.force)
        if (force != Vec<D, Real>{}) force = {};
}

template <int D, class Real> void end(World<D, Real>& world, Real dt) {
    end_contacts(world);
    tear(world, dt);
    for (auto& pin : world.pins) pin.from = pin.target;
    forget_forces(world.particles);
    world.time += double(dt);
    ++world.steps;
}

/// Sweep over everything outside the blocks: substeps of projections.

template <int D, class Real> class Sweep {
  public:
    Sweep(World<D, Real>& world, int substeps, Real h)
        : world_(world), plan_(world.swept.plan), kernels_(kernels<D, Real>()), substeps_(substeps),
          passes_(substeps * world.settings.iterations), h_(h),
          threads_(threads_for(world.swept.size(), world.threads)),
          driven_(!(plan_.others.empty() && world.blocks.list.empty()) && any_driven(world)) {}

    void run() {
        if (world_.swept.size() == 0 && !driven_) return;
        begin_sweep(world_, h_);
        links_ = world_.swept.link_columns(distances().multiplier.data());
        if (all_is_plain())
            run_sheets();
        else
            run_substeps();
        note_strain();
    }

  private:
    World<D, Real>& world_;
    const Plan<Real>& plan_;
    const Kernels<D, Real>& kernels_;
    int substeps_, passes_;
    Real h_;
    int threads_;
    bool driven_;
    LinkColumns<D, Real> links_{};

    using Substep = detail::Substep<D, Real>;

    auto& distances() { return std::get<kind_number<Distance, D>>(world_.constraints); }
    Substep make_substep(int number) { return Substep(world_, kernels_, links_, number, substeps_, h_); }

    bool all_is_plain() const {
        return plan_.others.empty() && !driven_ && world_.blocks.hanging.empty() && !world_.budgets.any;
    }

    void run_substeps() {
        take_up(world_, h_, 0, world_.swept.size());
        for (int s = 1; s <= substeps_; ++s) run_substep(s);
        put_back(world_, 0, world_.swept.size());
    }

    /// Runs one substep over all sheets and constraints.
    void run_substep(int number) {
        if (driven_) move_limits(world_, h_);
        auto substep = make_substep(number);
        detail::EnergyLimiter<D, Real> limiter(world_, h_);
        limiter.begin();
        for (const auto& band : plan_.bands) substep.predict(band);
        note_energy(world_);
        detail::PortCoupling<D, Real> ports(world_, h_, number);
        ports.begin();
        for (bool again = false;; again = true) {
            for (int i = 0; i < world_.settings.iterations; ++i) {
                if (i > 0) hold(substep);
                substep.mover().first_iteration = i == 0;
                project_all(substep);
            }
            if (ports.take(again)) break;
            ports.begin_again();
        }
        hold(substep);
        limiter.find_gains();
        for (const auto& band : plan_.bands) substep.advance(band);
        take_back_gains(world_, h_);
        limiter.take_gains();
        for (const auto& band : plan_.bands) substep.rebound(band);
        if (driven_) slip(world_, h_);
    }

    /// Runs an iteration over all constraints: ports after everything not at a port, and before the tethers. Sheets
    /// with ports are swept again, since most of the load on them comes from outside.
    void project_all(Substep& substep) {
        const auto& ports = world_.blocks.ports;
        const int rounds = ports.list.empty() ? 1 : 2;
        const bool first = substep.mover().first_iteration;
        for (int round = 0; round < rounds; ++round) {
            substep.mover().first_iteration = first && round == 0;
            for (std::size_t i = 0; i < plan_.sheets.size(); ++i)
                if (round == 0 || ports.sheets[i]) project_links(substep, plan_.sheets[i]);
            for (const auto& run : plan_.others) detail::project_run(world_, run, substep.mover());
            detail::PortMover<D, Real>::project_all(world_, substep.mover());
            for (std::size_t i = 0; i < plan_.sheets.size(); ++i)
                if (round == 0 || ports.sheets[i]) tether(substep, plan_.sheets[i]);
        }
        substep.mover().first_iteration = first;
    }
    void project_links(Substep& substep, const Sheet& sheet) {
        for (std::uint32_t f = 0; f < sheet.families; ++f)
            for (std::uint32_t band = 0; band < sheet.bands; ++band) substep.project(sheet, f, band);
        substep.tie(sheet);
        if (world_.restless)
            for (std::uint32_t band = 0; band < sheet.bands; ++band) substep.project_again(sheet, band);
        for (std::uint32_t band = 0; band < sheet.bands; ++band) substep.tighten(sheet, band);
    }
    void tether(Substep& substep, const Sheet& sheet) {
        substep.tie(sheet);
        for (const auto& band : bands_of(sheet)) substep.tether_in_turn(band);
    }
    /// Constraints on single particles, including particles of blocks: pins and planes.
    void hold(Substep& substep) {
        for (const auto& band : plan_.bands) substep.pull_pins(band);
        for (const auto& band : plan_.bands) substep.keep_in_bounds(band);
    }

    /// Distributes sheets over threads; all threads together run a sheet so large that one thread would finish long
    /// after the others.
    void run_sheets() {
        const auto& sheets = plan_.sheets;
        Workers::run(threads_, int(sheets.size()), [&](int i) {
            if (const auto& sheet = sheets[std::size_t(i)]; !is_large(sheet)) run_through(sheet, 1);
        });
        for (const auto& sheet : sheets)
            if (is_large(sheet)) run_through(sheet, threads_);
    }

    bool is_large(const Sheet& sheet) const {
        const auto bands = bands_of(sheet);
        const auto most = world_.swept.size() / std::uint32_t(2 * threads_);
        return bands.size() >= 8 * std::size_t(threads_) && bands.back().last - bands.front().first > most;
    }

    /// Runs all passes over a sheet turn after turn, a few passes to a stage.
    void run_through(const Sheet& sheet, int threads) {
        const int stages = std::min(passes_, Relay::most_stages);
        if (stages < 1) return;
        Relay relay(stages, turns_of(sheet));
        Workers::run(threads, threads, [&](int) {
            relay.help([&](int stage, int turn) {
                for (int pass = passes_ * stage / stages; pass < passes_ * (stage + 1) / stages; ++pass)
                    run_turn(sheet, turn, pass);
            });
        });
    }

    /// Number of bands worked on at once. The result is that of pass after pass, to the last bit: each pass follows the
    /// one before as closely as shared particles allow, while a band is still in the cache. With fewer bands, threads
    /// take bands out of each other's caches more often; with more, there is less to share.
    static constexpr std::uint32_t at_once = 16;
    int turns_of(const Sheet& sheet) const { return int((last_time(sheet) + at_once - 1) / at_once); }
    std::uint32_t last_time(const Sheet& sheet) const { return sheet.bands + std::uint32_t(passes_) * lag(sheet); }

    /// Number of bands by which a pass lags behind the pass before.
    std::uint32_t lag(const Sheet& sheet) const {
        const bool again = world_.restless > 0 && sheet.tethers > 0;
        return sheet.lag + (again ? world_.restless - 1 + sheet.reach : 0);
    }

    /// Runs one turn of a pass, where a pass is one iteration of a substep. The first pass gathers and predicts; later
    /// substeps are predicted as the substep before ends. Then each family is projected, then pins and planes.
    void run_turn(const Sheet& sheet, int turn, int pass) {
        const int iterations = world_.settings.iterations, number = pass / iterations, iteration = pass % iterations;
        const auto begun = std::uint32_t(pass) * lag(sheet), ended = begun + lag(sheet);
        const auto first = std::max(begun, std::uint32_t(turn) * at_once);
        const auto last = std::min(ended + sheet.bands, std::uint32_t(turn + 1) * at_once);
        if (first >= last) return;
        auto substep = make_substep(number + 1), next = make_substep(number + 2);
        substep.tie(sheet);
        substep.mover().first_iteration = iteration == 0;
        const auto band = [&](std::uint32_t i) -> const Band& { return plan_.bands[sheet.first_band + i]; };
        for (auto time = first; time < last; ++time) {
            const auto at = [&](std::uint32_t delay, auto&& work) {
                if (time >= delay && time - delay < sheet.bands) work(time - delay);
            };
            if (pass == 0)
                at(0, [&](std::uint32_t i) {
                    take_up(world_, h_, band(i).first, band(i).last);
                    substep.predict(band(i));
                });
            for (std::uint32_t f = 0; f < sheet.families; ++f)
                at(begun + plan_.families[sheet.first_family + f].delay,
                   [&](std::uint32_t i) { substep.project(sheet, f, i); });
            at(ended, [&](std::uint32_t i) {
                if (world_.restless) substep.project_again(sheet, i);
                substep.tighten(sheet, i);
                if (iteration + 1 < iterations) return substep.hold(band(i));
                const bool over = number + 1 == substeps_;
                substep.go_on(band(i), over ? nullptr : &next);
                if (over) put_back(world_, band(i).first, band(i).last);
            });
        }
    }

    /// Sets the repair window to twice the number of bands repaired in a row: spreading strain is met, and calm sheets
    /// cost little.
    void note_strain() {
        constexpr std::uint32_t least = 4, most = 20;
        std::uint32_t longest = 0;
        for (auto& band : world_.swept.plan.bands) {
            longest = std::max({longest, std::uint32_t(band.strained), band.again});
            band.strained = false;
            band.again = 0;
        }
        world_.restless = longest > 0 ? std::clamp(2 * longest, least, most) : 0;
    }

    std::span<const Band> bands_of(const Sheet& sheet) const {
        return std::span(plan_.bands).subspan(sheet.first_band, sheet.bands);
    }
};

template <int D, class Real> void physical_step(World<D, Real>& world, Real dt, detail::Laps& laps) {
    const int substeps = world.settings.substeps > 0 ? world.settings.substeps : usual_substeps;
    const Real h = dt / Real(substeps);
    prepare(world);
    find_passive(world);
    laps.end(Phase::prepare);
    step_blocks(world, dt, h);
    laps.end(Phase::blocks);
    Sweep<D, Real>(world, substeps, h).run();
    world.last_step = dt;
    world.last_substep = h;
}

} // namespace

template <int D, class Real> void step(World<D, Real>& world, Real dt) {
    if (!(dt >= limit::shortest_step<Real>)) return;
    dt = minimum(dt, limit::step<Real>);
    detail::Laps laps;
    begin(world);
    if (world.settings.mode == Mode::classic)
        classic_step(world, dt);
    else
        physical_step(world, dt, laps);
    laps.end(Phase::sweep);
    end(world, dt);
    laps.end(Phase::finish);
}

#define SINEW_STEP(D, Real) template void step(World<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_STEP)

} // namespace sinew
