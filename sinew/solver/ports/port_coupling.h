#pragma once

#include "sinew/solver/ports/port_block.h"
#include "sinew/solver/ports/port_mover.h"

/// Coupling of blocks and sweep in one substep: begin, sweep, take. If the linear models of the ports fed in energy,
/// the sweep is repeated with responses that overestimate the mobility.
namespace sinew::detail {

template <int D, class Real> class PortCoupling {
  public:
    PortCoupling(World<D, Real>& world, Solver<D, Real>& solver, Real h, int number)
        : world_(world), solver_(solver), blocks_(solver.blocks), swept_(solver.sweep_state), h_(h), number_(number) {}

    bool any() const { return !blocks_.attached_trees.empty(); }

    /// Called after the prediction. Guesses come from the last substep, in the first one from the stored multipliers.
    void begin() {
        if (!blocks_.ports.groups.empty()) note_free_moves();
        if (!any()) return;
        if (number_ == 1) begin_step();
        each([&](Block&, PortBlock<D, Real> block) { block.predict(), block.state().show(); });
        begin_rows();
    }

    /// Called after the sweep. False if the sweep has to be repeated.
    bool take(bool again) {
        if (!any()) return true;
        bool well = true;
        each([&](Block& block, PortBlock<D, Real> solver) {
            const double fed = solver.take();
            const bool feeds = fed > solver.state().trace(double(norm(swept_.gravity)));
            block.lost = feeds ? fed : 0;
            well = well && !feeds;
        });
        if (!well && !again) return false;
        each([&](Block&, PortBlock<D, Real> block) { block.state().store(); });
        for (auto& row : blocks_.ports.rows)
            visit_table(world_, row.kind, [&](auto& table) { table.multiplier[row.row] = Real(row.multiplier); });
        return true;
    }

    void begin_again() {
        for (Row s = 0; s < swept_.size(); ++s) {
            swept_.set_displacement(s, cast<Real>(blocks_.ports.free_moves[s]));
            if (has_walls(world_)) swept_.blows[s] = {};
        }
        each([&](Block& block, PortBlock<D, Real> solver) {
            if (block.lost > 0) solver.predict_loosely();
            solver.state().show();
        });
        begin_rows();
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    Blocks<D>& blocks_;
    SweepState<D, Real>& swept_;
    Real h_;
    int number_;

    template <class Visit> void each(Visit&& visit) {
        for (auto& block : blocks_.attached_trees) visit(block, PortBlock<D, Real>(world_, solver_, block, h_));
    }

    void note_free_moves() {
        auto& ports = blocks_.ports;
        for (Row s = 0; s < swept_.size(); ++s) {
            ports.free_moves[s] = cast<double>(swept_.displacement_at(s));
            ports.mobilities[s] = double(swept_.mobility[s]);
        }
    }

    void begin_rows() {
        for (auto& row : blocks_.ports.rows) {
            row.multiplier = 0;
            visit_table(world_, row.kind, [&](auto& table) { table.multiplier[row.row] = Real(0); });
        }
    }

    /// Factors are kept within a step only: they are no part of the world's state.
    void begin_step() {
        for (auto& block : blocks_.attached_trees) block.is_factorised = false;
        guess_from_multipliers();
    }

    /// The impulse at a port is the sum over the constraints there.
    void guess_from_multipliers() {
        auto& ports = blocks_.ports;
        for (auto& port : ports.list) port.guess = {};
        for (auto& block : blocks_.attached_trees)
            for (auto& link : std::span(blocks_.links).subspan(block.first_link, block.links)) link.before = 0;
        const double scale = square(double(h_)) * inverse_or_zero(square(double(world_.last_substep)));
        for (const auto& row : ports.rows)
            visit_table(world_, row.kind, [&](auto& table) { guess_from(table, row.row, scale); });
    }
    template <class Table> void guess_from(const Table& table, Row row, double scale) {
        auto& ports = blocks_.ports;
        const auto members = table.members[row];
        Stencil<typename Table::Kind, D, Real> stencil(solver_.scratch, members.size());
        stencil.each([&](std::size_t i) { stencil.points[i] = swept_.position_at(swept_.slot_of[members[i]]); });
        stencil.evaluate(stencil.points, stencil.gradient);
        stencil.each([&](std::size_t i) {
            if (ports.at[members[i]] == ports.none) return;
            const double share = double(handicap(table.split[row], i));
            ports.list[ports.at[members[i]]].guess +=
                cast<double>(stencil.gradient[i]) * (double(table.multiplier[row]) * scale * share);
        });
    }
};

} // namespace sinew::detail
