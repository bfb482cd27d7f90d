#include "sinew/assert/assert.h"
#include "sinew/solver/colliders.h"
#include "sinew/solver/contact/figure_contact.h"
#include "sinew/solver/momentum_keeper.h"
#include "sinew/solver/ports/energy_limiter.h"
#include "sinew/solver/ports/port_coupling.h"
#include "sinew/solver/profile.h"
#include "sinew/solver/substep.h"
#include "sinew/solver/workers.h"

#include <algorithm>
#include <utility>

namespace sinew {
namespace {

template <int D, class Real> void begin(World<D, Real>& world, Solver<D, Real>& solver) {
    world.events.clear();
    if (world.settings.mode == Mode::classic) detail::make_room_for_widest(world, solver.scratch);
    hold_in_limits(world, solver);
    apply_random_pushes(world);
    begin_contacts(world);
}

template <int D, class Real> void forget_forces(Particles<D, Real>& particles) {
    if (!std::exchange(particles.any_force, false)) return;
    for (auto& force : particles.force)
        if (force != Vec<D, Real>{}) force = {};
}

template <int D, class Real> void end(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    end_contacts(world);
    tear(world, solver, dt);
    for (auto& pin : world.pins) pin.from = pin.target;
    forget_forces(world.particles);
    world.time += double(dt);
    ++world.steps;
}

/// Sweep over everything outside the blocks: substeps of projections.

template <int D, class Real> class Sweep {
  public:
    Sweep(World<D, Real>& world, Solver<D, Real>& solver, int substeps, Real h)
        : world_(world), solver_(solver), plan_(solver.sweep_state.plan), kernels_(kernels<D, Real>()),
          substeps_(substeps), h_(h), threads_(threads_for(solver.sweep_state.size(), solver.options.threads)),
          driven_(!(plan_.others.empty() && solver.blocks.list.empty()) && any_driven(world)) {}

    void run() {
        if (solver_.sweep_state.size() == 0 && !driven_) return;
        begin_sweep(world_, solver_, h_);
        find_contact_features(world_, solver_);
        links_ = solver_.sweep_state.link_columns(distances().multiplier.data());
        if (all_is_plain())
            run_components();
        else
            run_substeps();
        note_overstretch();
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    const Plan<Real>& plan_;
    const Kernels<D, Real>& kernels_;
    int substeps_;
    Real h_;
    int threads_;
    bool driven_;
    detail::MomentumKeeper<D, Real> keeper_{solver_.sweep_state, kernels_};
    DistanceColumns<D, Real> links_{};

    using Substep = detail::Substep<D, Real>;

    auto& distances() { return std::get<kind_number<Distance, D>>(world_.constraints); }
    Substep make_substep(int number) { return Substep(world_, solver_, kernels_, links_, number, substeps_, h_); }

    bool all_is_plain() const {
        return plan_.others.empty() && !driven_ && solver_.blocks.attached_trees.empty() && !solver_.budgets.any &&
               !has_figure_contacts(solver_);
    }

    void run_substeps() {
        const auto bodies = std::span(solver_.sweep_state.bodies.list);
        gather(world_, solver_, h_, 0, solver_.sweep_state.size());
        if (solver_.sweep_state.everyone_alike) keeper_.note(bodies, decay());
        for (int s = 1; s <= substeps_; ++s) run_substep(s);
        if (solver_.sweep_state.everyone_alike) keeper_.restore(bodies);
        scatter(world_, solver_, 0, solver_.sweep_state.size());
    }

    /// Runs one substep over all components and constraints.
    void run_substep(int number) {
        if (driven_) move_limits(world_, h_);
        auto substep = make_substep(number);
        detail::EnergyLimiter<D, Real> limiter(world_, solver_, h_);
        limiter.begin();
        for (const auto& tile : plan_.tiles) substep.predict(tile);
        const bool keeps = !solver_.sweep_state.everyone_alike;
        if (keeps) keeper_.note(solver_.sweep_state.bodies.list, 1);
        note_energy(world_, solver_);
        detail::FigureContact<D, Real> contacts(world_, solver_, h_, number, substeps_);
        contacts.begin();
        detail::PortCoupling<D, Real> ports(world_, solver_, h_, number);
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
        contacts.solve();
        limiter.find_gains();
        for (const auto& tile : plan_.tiles) substep.advance(tile);
        take_back_gains(world_, solver_, h_);
        if (keeps) keeper_.restore(solver_.sweep_state.bodies.list);
        limiter.take_gains();
        for (const auto& tile : plan_.tiles) substep.rebound(tile);
        contacts.relax();
        if (driven_) slip(world_, solver_, h_);
    }

    /// Runs an iteration over all constraints: ports after everything not at a port, and before the tethers. Components
    /// with ports are swept again, since most of the load on them comes from outside.
    void project_all(Substep& substep) {
        const auto& ports = solver_.blocks.ports;
        const int rounds = ports.list.empty() ? 1 : 2;
        const bool first = substep.mover().first_iteration;
        for (int round = 0; round < rounds; ++round) {
            substep.mover().first_iteration = first && round == 0;
            for (std::size_t i = 0; i < plan_.components.size(); ++i)
                if ((round == 0 || ports.components[i]) && !is_exact(i)) project_links(substep, plan_.components[i]);
            for (const auto& run : plan_.others) project(run, substep);
            detail::PortMover<D, Real>::project_all(world_, solver_, substep.mover());
            for (std::size_t i = 0; i < plan_.components.size(); ++i)
                if (round == 0 || ports.components[i]) tether(substep, plan_.components[i]);
        }
        substep.mover().first_iteration = first;
    }
    /// True for a component whose links are exact beside the sweep (contact/link_projector.h).
    bool is_exact(std::size_t component) const {
        return has_figure_contacts(solver_) && solver_.contacts->exact_components[component];
    }
    void project(const SweepRun& run, Substep& substep) {
        const std::span scratch(solver_.scratch);
        if (!has_figure_contacts(solver_)) return detail::project_run(world_, scratch, run, substep.mover());
        visit_table(world_, run.kind, [&](auto& table) {
            for (Row row = run.rows.first; row < run.rows.last; ++row)
                if (!solver_.contacts->joints.takes(run.kind, row))
                    detail::project_row(scratch, table, row, substep.mover());
        });
    }
    void project_links(Substep& substep, const Component& component) {
        for (std::uint32_t f = 0; f < component.colors; ++f)
            for (std::uint32_t tile = 0; tile < component.tiles; ++tile) substep.project(component, f, tile);
        substep.set_anchors(component);
        if (world_.repair_window)
            for (std::uint32_t tile = 0; tile < component.tiles; ++tile) substep.repair_overstretch(component, tile);
        for (std::uint32_t tile = 0; tile < component.tiles; ++tile) substep.tighten(component, tile);
    }
    void tether(Substep& substep, const Component& component) {
        substep.set_anchors(component);
        for (const auto& tile : tiles_of(component)) substep.tether_in_turn(tile);
    }
    /// Constraints on single particles, including particles of blocks: pins and planes.
    void hold(Substep& substep) {
        for (const auto& tile : plan_.tiles) substep.pull_pins(tile);
        for (const auto& tile : plan_.tiles) substep.keep_in_bounds(tile);
    }

    /// Distributes components over threads; all threads together run a component so large that one thread would finish
    /// long after the others.
    void run_components() {
        const auto& components = plan_.components;
        Workers::run(threads_, int(components.size()), [&](int i) {
            if (const auto& component = components[std::size_t(i)]; !is_large(component)) run_wavefront(component, 1);
        });
        for (const auto& component : components)
            if (is_large(component)) run_wavefront(component, threads_);
    }

    bool is_large(const Component& component) const {
        const auto tiles = tiles_of(component);
        const auto most = solver_.sweep_state.size() / std::uint32_t(2 * threads_);
        return tiles.size() >= 8 * std::size_t(threads_) && tiles.back().last - tiles.front().first > most;
    }

    /// Factor of velocities by damping over all substeps.
    double decay() {
        const double later = double(make_substep(2).keep());
        double keep = double(make_substep(1).keep());
        for (int number = 2; number <= substeps_; ++number) keep *= later;
        return keep;
    }

    /// Runs all passes over a component. The momenta of free bodies are kept over the whole step where all forces are
    /// alike, otherwise in each substep, between forces and constraints.
    void run_wavefront(const Component& component, int threads) {
        if (component.bodies == 0)
            return run_passes(component, threads, {.last = substeps_, .gathers = true, .predicts = true});
        const auto tiles = tiles_of(component);
        const auto bodies = std::span(solver_.sweep_state.bodies.list).subspan(component.first_body, component.bodies);
        const bool alike = solver_.sweep_state.everyone_alike;
        const int number = alike ? substeps_ : 1;
        gather(world_, solver_, h_, tiles.front().first, tiles.back().last);
        for (int first = 0; first < substeps_; first += number) {
            if (!alike) predict(component, first + 1);
            keeper_.note(bodies, alike ? decay() : 1);
            run_passes(component, threads, {.first = first, .last = first + number, .predicts = alike});
            keeper_.restore(bodies);
        }
        scatter(world_, solver_, tiles.front().first, tiles.back().last);
    }
    void predict(const Component& component, int number) {
        auto substep = make_substep(number);
        for (const auto& tile : tiles_of(component)) substep.predict(tile);
    }

    /// Range of substeps, counted from 0.
    struct Passes {
        int first = 0, last = 0;
        bool gathers = false;  ///< particles are gathered before, and scattered afterwards
        bool predicts = false; ///< the first substep is yet to be predicted
    };

    /// Runs some substeps over a component turn after turn, a few passes to a stage.
    void run_passes(const Component& component, int threads, const Passes& range) {
        const int passes = (range.last - range.first) * world_.settings.iterations;
        const int stages = std::min(passes, WavefrontScheduler::max_stages);
        if (stages < 1) return;
        WavefrontScheduler relay(stages, turns_of(component, passes));
        Workers::run(threads, threads, [&](int) {
            relay.help([&](int stage, int turn) {
                for (int pass = passes * stage / stages; pass < passes * (stage + 1) / stages; ++pass)
                    run_turn(component, turn, pass, range);
            });
        });
    }

    /// Number of tiles worked on at once. The result is that of pass after pass, to the last bit: each pass follows the
    /// one before as closely as shared particles allow, while a tile is still in the cache. With fewer tiles, threads
    /// take tiles out of each other's caches more often; with more, there is less to share.
    static constexpr std::uint32_t at_once = 16;
    int turns_of(const Component& component, int passes) const {
        return int((component.tiles + std::uint32_t(passes) * wavefront_offset(component) + at_once - 1) / at_once);
    }

    /// Number of tiles by which a pass lags behind the pass before.
    std::uint32_t wavefront_offset(const Component& component) const {
        const bool again = world_.repair_window > 0 && component.tethers > 0;
        return component.wavefront_offset + (again ? world_.repair_window - 1 + component.reach : 0);
    }

    /// Runs one turn of a pass, where a pass is one iteration of a substep. The first pass gathers and predicts; later
    /// substeps are predicted as the substep before ends. Then each color is projected, then pins and planes.
    void run_turn(const Component& component, int turn, int pass, const Passes& range) {
        const int iterations = world_.settings.iterations, iteration = pass % iterations;
        const int number = range.first + pass / iterations;
        const auto begun = std::uint32_t(pass) * wavefront_offset(component),
                   ended = begun + wavefront_offset(component);
        const auto first = std::max(begun, std::uint32_t(turn) * at_once);
        const auto last = std::min(ended + component.tiles, std::uint32_t(turn + 1) * at_once);
        if (first >= last) return;
        auto substep = make_substep(number + 1), next = make_substep(number + 2);
        substep.set_anchors(component);
        substep.mover().first_iteration = iteration == 0;
        const auto tile = [&](std::uint32_t i) -> const Tile& {
            SINEW_ASSERT(i < component.tiles, "the tile is in the component");
            return plan_.tiles[component.first_tile + i];
        };
        for (auto time = first; time < last; ++time) {
            const auto at = [&](std::uint32_t begin, auto&& work) {
                if (time >= begin && time - begin < component.tiles) work(time - begin);
            };
            if (pass == 0)
                at(0, [&](std::uint32_t i) {
                    if (range.gathers) gather(world_, solver_, h_, tile(i).first, tile(i).last);
                    if (range.predicts) substep.predict(tile(i));
                });
            for (std::uint32_t f = 0; f < component.colors; ++f)
                at(begun + plan_.colors[component.first_color + f].wavefront_offset,
                   [&](std::uint32_t i) { substep.project(component, f, i); });
            at(ended, [&](std::uint32_t i) {
                if (world_.repair_window) substep.repair_overstretch(component, i);
                substep.tighten(component, i);
                if (iteration + 1 < iterations) return substep.hold(tile(i));
                const bool over = number + 1 == range.last;
                substep.go_on(tile(i), over ? nullptr : &next);
                if (over && range.gathers) scatter(world_, solver_, tile(i).first, tile(i).last);
            });
        }
    }

    /// Sets the repair window to twice the number of tiles repaired in a row: spreading strain is met, and calm
    /// components cost little.
    void note_overstretch() {
        constexpr std::uint32_t least = 4, most = 20;
        std::uint32_t longest = 0;
        for (auto& tile : solver_.sweep_state.plan.tiles) {
            longest = std::max({longest, std::uint32_t(tile.overstretched), tile.again});
            tile.overstretched = false;
            tile.again = 0;
        }
        world_.repair_window = longest > 0 ? std::clamp(2 * longest, least, most) : 0;
    }

    std::span<const Tile> tiles_of(const Component& component) const {
        return std::span(plan_.tiles).subspan(component.first_tile, component.tiles);
    }
};

template <int D, class Real>
void physical_step(World<D, Real>& world, Solver<D, Real>& solver, Real dt, detail::Laps& laps) {
    const int substeps = world.settings.substeps > 0 ? world.settings.substeps : usual_substeps;
    const Real h = dt / Real(substeps);
    solver.prepare(world);
    find_passive(world, solver);
    laps.end(Phase::prepare);
    step_blocks(world, solver, dt, h);
    laps.end(Phase::blocks);
    Sweep<D, Real>(world, solver, substeps, h).run();
    world.last_step = dt;
    world.last_substep = h;
}

} // namespace

template <int D, class Real> void Solver<D, Real>::step(World<D, Real>& world, Real dt) {
    if (!(dt >= limit::shortest_step<Real>)) return;
    dt = minimum(dt, limit::step<Real>);
    detail::Laps laps;
    begin(world, *this);
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
