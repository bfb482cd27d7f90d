#pragma once

#include "sinew/solver/cloth/thin_contact.h"
#include "sinew/solver/contact/cloth_contact.h"
#include "sinew/solver/contact/face_contact.h"
#include "sinew/solver/contact/figure_contact.h"
#include "sinew/solver/contact/wall_guard.h"
#include "sinew/solver/ports/energy_limiter.h"
#include "sinew/solver/ports/port_coupling.h"
#include "sinew/solver/sweep/momentum_keeper.h"
#include "sinew/solver/sweep/projections.h"
#include "sinew/solver/sweep/substeps.h"

#include <algorithm>
#include <utility>

namespace sinew::detail {

/// Substep after substep over all components together, for worlds in which components act on each other: by contacts,
/// at ports of blocks, through constraints of every kind, by motors.
template <int D, class Real> class CoupledSweep {
  public:
    CoupledSweep(World<D, Real>& world, Solver<D, Real>& solver, const Substeps<D, Real>& substeps, bool motorized)
        : world_(world), solver_(solver), plan_(solver.sweep_state.plan), substeps_(substeps), motorized_(motorized),
          goes_back_(solver.blocks.attached_trees.empty()), keeper_{solver.sweep_state, substeps.kernels()} {}

    void run() {
        const auto bodies = std::span(solver_.sweep_state.bodies.list);
        const bool alike = solver_.sweep_state.everyone_alike;
        gather(world_, solver_, substeps_.h, 0, solver_.sweep_state.size());
        if (alike) keeper_.note(bodies, substeps_.decay());
        for (int number = 1; number <= substeps_.count; ++number) {
            if (motorized_) move_limits(world_, substeps_.h);
            run_substep(number, alike ? bodies.first(0) : bodies);
            if (motorized_) slip(world_, solver_, substeps_.h);
        }
        if (alike) keeper_.restore(bodies);
        scatter(world_, solver_, 0, solver_.sweep_state.size());
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    const Plan<Real>& plan_;
    const Substeps<D, Real>& substeps_;
    bool motorized_; ///< a limit moves, or has a maximum force
    /// Constraints are projected there and back. Not beside ports: pushes on them are linear about one sweep there, and
    /// with the way back joined figures run away (JoinedFigures of the tests).
    bool goes_back_;
    MomentumKeeper<D, Real> keeper_;

    /// `bodies` are those whose momenta are kept in this substep.
    void run_substep(int number, std::span<FreeBody<D>> bodies) {
        auto substep = substeps_.number(number);
        EnergyLimiter<D, Real> limiter(world_, solver_, substeps_.h);
        limiter.begin(number);
        for (const auto& tile : plan_.tiles) substep.predict(tile);
        keeper_.note(bodies, 1);
        FigureContact<D, Real> contacts(world_, solver_, substeps_.h, number, substeps_.count);
        contacts.begin();
        if (has_faces()) find_face_contacts(world_, solver_, solver_.contacts->list.near_by, substeps_.h);
        solve_with_ports(substep, number);
        hold(substep, number);
        solve_faces();
        contacts.solve();
        limiter.find_gains();
        keep_uncrossed(substep, number);
        for (const auto& tile : plan_.tiles) substep.advance(tile);
        keeper_.restore(bodies);
        limiter.take_gains();
        for (const auto& tile : plan_.tiles) substep.rebound(tile);
        if (has_faces()) relax_face_contacts(world_, solver_, substeps_.h);
        contacts.relax();
    }

    /// Before positions advance: thin cloth does not cross itself, nothing crosses the faces of cloth, and nothing
    /// passes a wall.
    void keep_uncrossed(Substep<D, Real>& substep, int number) {
        constexpr int rounds = 3;
        for (int round = 0;; ++round) {
            if (has_thin_cloth())
                truncate_thin_cloth<D, Real>(world_, solver_.sweep_state, solver_.contacts->thin, span(number));
            if (!has_faces() || !guard_faces(world_, solver_, substeps_.h, round >= rounds) || !has_thin_cloth()) break;
        }
        if (has_figure_contacts(solver_)) {
            const Real count = Real(substeps_.count);
            WallGuard<D, Real>(world_, solver_, substep.mover(), Real(number - 1) / count, Real(number) / count).hold();
        }
        if (has_faces()) advance_face_contacts(solver_, substeps_.h);
    }

    /// Iterations over all constraints, once more where the linear models of the ports fed in energy.
    void solve_with_ports(Substep<D, Real>& substep, int number) {
        PortCoupling<D, Real> ports(world_, solver_, substeps_.h, number);
        ports.begin();
        for (bool again = false;; again = true) {
            for (int i = 0; i < world_.settings.iterations; ++i) {
                if (i > 0) hold(substep, number);
                substep.mover().first_iteration = i == 0;
                project_all(substep);
            }
            if (ports.take(again)) return;
            ports.begin_again();
        }
    }

    /// Runs an iteration over all constraints: there and back, then ports, and then the tethers. Components with ports
    /// are swept again, since most of the load on them comes from outside.
    void project_all(Substep<D, Real>& substep) {
        const int rounds = max_passes();
        const bool first = substep.mover().first_iteration;
        for (int round = 0; round < rounds; ++round) {
            substep.mover().first_iteration = first && round == 0;
            for (std::size_t i = 0; i < plan_.components.size(); ++i)
                if (round < passes(i) && !is_exact(i)) project(substep, plan_.components[i], link_passes(i));
            for (const auto& run : plan_.others) project(substep, run);
            go_back(substep, round);
            PortMover<D, Real>::project_all(world_, solver_, substep.mover());
            for (std::size_t i = 0; i < plan_.components.size(); ++i)
                if (round < passes(i)) tether(substep, plan_.components[i]);
        }
        substep.mover().first_iteration = first;
    }
    /// The way back over constraints of other kinds, and over the components that they act on.
    void go_back(Substep<D, Real>& substep, int round) {
        if (!goes_back_) return;
        const bool first = std::exchange(substep.mover().first_iteration, false);
        for (auto run = plan_.others.rbegin(); run != plan_.others.rend(); ++run)
            if (run->both_ways) project_back(substep, *run);
        for (std::size_t i = plan_.components.size(); i-- > 0;)
            if (plan_.components[i].is_tied && round < passes(i) && !is_exact(i))
                project_back(substep, plan_.components[i]);
        substep.mover().first_iteration = first;
    }
    /// Passes over a component in an iteration.
    int passes(std::size_t component) const {
        const auto& ports = solver_.blocks.ports;
        return ports.list.empty() ? 1 : std::max(1, int(ports.passes[component]));
    }
    int max_passes() const {
        const auto& ports = solver_.blocks.ports;
        int max = ports.list.empty() ? 1 : 2;
        for (const char count : ports.passes) max = std::max(max, int(count));
        return max;
    }
    /// True for a component whose links are exact beside the sweep (contact/link_projector.h).
    bool is_exact(std::size_t component) const {
        return has_figure_contacts(solver_) && solver_.contacts->exact_components[component];
    }
    SubstepSpan<Real> span(int number) const { return {substeps_.h, number, substeps_.count}; }
    bool has_faces() const { return has_figure_contacts(solver_) && !solver_.contacts->faces.empty(); }
    void solve_faces() {
        if (has_faces()) solve_face_contacts(solver_, substeps_.h);
    }
    bool has_thin_cloth() const { return has_figure_contacts(solver_) && !solver_.contacts->thin.empty(); }
    void project(Substep<D, Real>& substep, const SweepRun& run) {
        visit_table(world_, run.kind, [&](auto& table) {
            for (Row row = run.rows.first; row < run.rows.last; ++row) project(substep, run.kind, table, row);
        });
    }
    void project_back(Substep<D, Real>& substep, const SweepRun& run) {
        visit_table(world_, run.kind, [&](auto& table) {
            for (Row row = run.rows.last; row-- > run.rows.first;) project(substep, run.kind, table, row);
        });
    }
    template <class Table> void project(Substep<D, Real>& substep, int kind, Table& table, Row row) {
        if (!has_figure_contacts(solver_) || !solver_.contacts->joints.takes(kind, row))
            project_row(std::span(solver_.scratch), table, row, substep.mover());
    }

    void project(Substep<D, Real>& substep, const Component& component, int times) {
        substep.set_anchors(component);
        const bool first = substep.mover().first_iteration;
        substep.is_repeated = times > 1;
        for (int i = 0; i < times; ++i) {
            substep.mover().first_iteration = first && i == 0;
            const bool comes_later = goes_back_ && component.is_tied; // the way back, with constraints of other kinds
            for_each_color(plan_, substep, component, over_tiles(component));
            if (goes_back_ && component.both_ways && !comes_later)
                for_each_color_back(plan_, substep, component, over_tiles(component));
            if (!comes_later) for_each_repair(world_, substep, component, over_tiles(component));
            if (times > 1) solve_faces();
        }
        substep.is_repeated = false;
        substep.mover().first_iteration = first;
    }
    void project_back(Substep<D, Real>& substep, const Component& component) {
        substep.set_anchors(component);
        for_each_color_back(plan_, substep, component, over_tiles(component));
        for_each_repair(world_, substep, component, over_tiles(component));
    }
    /// Visitor of passes: each over all tiles.
    static auto over_tiles(const Component& component) {
        return [count = component.tiles](std::uint32_t, auto&& work) {
            for (std::uint32_t tile = 0; tile < count; ++tile) work(tile);
        };
    }
    /// Passes over the links of a component in each round. No tether helps cloth that lies on something, and contacts
    /// stretch the links before the next pass: one leaves links of twice their length, through which layers slip; a
    /// pass costs a tenth of what the contacts do (docs/measured/contact.md).
    int link_passes(std::size_t component) const {
        return has_figure_contacts(solver_) && solver_.contacts->cloth_components[component] ? 4 : 1;
    }
    void tether(Substep<D, Real>& substep, const Component& component) {
        substep.set_anchors(component);
        for (const auto& tile : substeps_.tiles_of(component)) substep.tether_in_turn(tile);
    }

    /// Contacts of cloth, then constraints on single particles, including particles of blocks: pins and planes.
    void hold(Substep<D, Real>& substep, int number) {
        if (has_figure_contacts(solver_) && solver_.contacts->cloth.any_spheres)
            ClothContact<D, Real>(world_, solver_, substeps_.h, number, substeps_.count).solve();
        if (has_thin_cloth())
            part_thin_cloth<D, Real>(world_, solver_.sweep_state, solver_.contacts->thin, span(number));
        for (const auto& tile : plan_.tiles) substep.pins().pull(tile);
        if (has_figure_contacts(solver_) && solver_.contacts->all_by_rows && world_.colliders.empty()) return;
        for (const auto& tile : plan_.tiles) substep.keep_in_bounds(tile);
    }
};

} // namespace sinew::detail
