#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/ports/port_response.h"
#include "sinew/solver/sweep/substep.h"

#include <utility>

/// SweepState constraints at ports. An impulse at one port moves all ports of the block:
///
///     dlambda = -(C + alpha lambda) / (sum_ij g_i . W_ij g_j + alpha),      x_i += sum_j W_ij g_j dlambda
///
/// with W_ij the response of the block, or of a single particle its inverse mass.
namespace sinew::detail {

template <int D, class Real> class PortMover : public SubstepMover<D, Real> {
    using Base = SubstepMover<D, Real>;

  public:
    static constexpr bool couples = true;

    PortMover(Solver<D, Real>& solver, const Base& mover)
        : Base(mover), blocks_(solver.blocks), ports_(solver.blocks.ports) {}

    /// Constraints at ports come last in a pass, so that ports are left with the smallest errors. The multipliers in
    /// the tables are 0 meanwhile, because a pass of the sweep over inactive links undoes stored multipliers.
    static void project_all(World<D, Real>& world, Solver<D, Real>& solver, const Base& base) {
        PortMover mover(solver, base);
        for (auto& row : solver.blocks.ports.rows)
            visit_table(world, row.kind, [&](auto& table) {
                table.multiplier[row.row] = Real(row.multiplier);
                project_row(std::span(solver.scratch), table, row.row, mover);
                row.multiplier = double(std::exchange(table.multiplier[row.row], Real(0)));
            });
    }

    /// Ports are never parted from coincident particles.
    Real weight(Row row) const { return is_port(row) ? Real(0) : Base::weight(row); }
    void displace(Row row, const Vec<D, Real>& displacement) {
        if (!is_port(row)) Base::displace(row, displacement);
    }

    template <class Stencil> void choose_direction(Stencil& stencil, std::span<const Row>) const {
        stencil.each([&](std::size_t i) { stencil.direction[i] = stencil.gradient[i]; });
    }

    /// Response of the measure to the multiplier.
    template <class Stencil> Real resistance(const Stencil& stencil, std::span<const Row> members, Real split) const {
        double sum = 0;
        stencil.each([&](std::size_t i) {
            stencil.each([&](std::size_t j) {
                const auto moved = response(members[i], members[j], cast<double>(stencil.direction[j]));
                sum += double(handicap(split, j)) * dot(cast<double>(stencil.gradient[i]), moved);
            });
        });
        return Real(max(sum, 0.0));
    }

    /// Trust region of the linear model: half the shortest link about the place of linearisation.
    template <class Stencil>
    Real trusted_share(const Stencil& stencil, std::span<const Row> members, Real split, Real change) const {
        double share = 1;
        stencil.each([&](std::size_t i) {
            if (!is_port(members[i])) return;
            Vec<D, double> displacement{};
            stencil.each([&](std::size_t j) {
                const auto impulse = cast<double>(stencil.direction[j]) * double(handicap(split, j) * change);
                displacement += response(members[i], members[j], impulse);
            });
            share = min(share, trusted_share(ports_.list[ports_.at[members[i]]], members[i], displacement));
        });
        return Real(share);
    }

    void impart(Row row, const Vec<D, Real>& impulse) {
        if (impulse == Vec<D, Real>{}) return;
        if (!is_port(row)) return Base::displace(row, impulse * Base::weight(row));
        SINEW_ASSERT(ports_.at[row] < ports_.list.size(), "a particle's port is in the list");
        auto& pushed = ports_.list[ports_.at[row]];
        SINEW_ASSERT(pushed.block < blocks_.attached_trees.size(), "a port belongs to a block of the list");
        const auto& block = blocks_.attached_trees[pushed.block];
        pushed.impulse += cast<double>(impulse);
        for (std::uint32_t q = 0; q < block.ports; ++q) {
            const auto& node = blocks_.nodes[ports_.list[block.first_port + q].node];
            const auto moved = response(block, q, pushed.number) * cast<double>(impulse);
            Base::displace(node.row, cast<Real>(moved));
        }
    }

  private:
    Blocks<D>& blocks_;
    Ports<D>& ports_;

    bool is_port(Row row) const { return ports_.at[row] != ports_.none; }

    double trusted_share(const Port<D>& port, Row row, const Vec<D, double>& displacement) const {
        const auto seen = cast<double>(this->sweep_state.displacement_at(this->sweep_state.slot_of[row]));
        const auto moved = seen - port.linear_move;
        // |moved + share displacement| = radius
        const double radius = max(port.radius, norm(moved)), along = dot(moved, displacement);
        const double left = max(0.0, square(radius) - dot(moved, moved)), length = dot(displacement, displacement);
        const double root = square_root(square(along) + length * left);
        const double reached = along > 0 ? left : root - along, by = along > 0 ? along + root : length;
        return reached < by ? reached / by : 1;
    }
    const Matrix<D, double>& response(const Block& block, std::uint32_t q, std::uint32_t p) const {
        return PortResponse<D>::response(blocks_, block, q, p);
    }
    /// Displacement of one particle by an impulse at another.
    Vec<D, double> response(Row of, Row to, const Vec<D, double>& impulse) const {
        if (!is_port(of) || !is_port(to)) return of == to ? impulse * double(Base::weight(of)) : Vec<D, double>{};
        const auto &moved = ports_.list[ports_.at[of]], &pushed = ports_.list[ports_.at[to]];
        if (moved.block != pushed.block) return {};
        return response(blocks_.attached_trees[moved.block], moved.number, pushed.number) * impulse;
    }
};

} // namespace sinew::detail
