#pragma once

#include "sinew/solver/ports/group_energy.h"
#include "sinew/solver/ports/group_spin.h"
#include "sinew/solver/solver.h"

#include <algorithm>

/// Energy limit of blocks and sweep together. Sweeps and linear models leave errors, and repairing one may do work. Any
/// excess over the energy from springs and soft pins is taken from the velocities: relative to the rigid-body motion of
/// a free group, to the motion of the pins of a held one. Positions stay as solved, unless the energy would multiply,
/// or a held group would come to owe much. Energy of a held group that no velocity is left for is a **debt**, taken in
/// later substeps: part of the state of the world, in Particles::energy_debt.
namespace sinew::detail {

template <int D, class Real> class EnergyLimiter {
  public:
    EnergyLimiter(World<D, Real>& world, Solver<D, Real>& solver, Real h)
        : world_(world), solver_(solver), swept_(solver.sweep_state), blocks_(solver.blocks),
          ports_(solver.blocks.ports), energy_(world, solver, h), per_h_(1 / double(h)) {}

    /// Notes the motion and the stored energy before a substep, which is the `number`-th of its step.
    void begin(int number) {
        if (ports_.groups.empty()) return;
        if (number == 1) take_debts();
        for (Row s = 0; s < swept_.size(); ++s) ports_.last_displacements[s] = cast<double>(swept_.displacement_at(s));
        for (auto& group : ports_.groups) group.stored = energy_.stored(group, false);
    }
    /// Measures the gains once all moves are known, before positions advance. A group whose motion would multiply, or
    /// that would owe much, is slowed down at once.
    void find_gains() {
        for (auto& group : ports_.groups) {
            const auto motion = motion_of(group);
            const bool is_free = motion.anchors().empty();
            if (is_free && nothing_else_acts()) motion.take_drift();
            auto gain = energy_.gain(group);
            find_share(group, gain);
            if (is_free) {
                group.spin = due_spin(motion);
                if (group.lost < 0) stiffen(motion, group.spin), group.share = 1, group.lost = 0;
            }
            if (!group.motorized && is_excessive(group)) {
                hold_back(group, gain.share_of_moves());
                gain = energy_.gain(group);
                find_share(group, gain);
            }
            if (is_free && group.share < 1) group.lost = -gain.gain, group.share = 1;
            note_debt(group);
        }
    }
    /// Removes the gains once positions have advanced.
    void take_gains() {
        for (const auto& group : ports_.groups) {
            if (group.share < 1) slow_down(group, group.share);
            const auto motion = motion_of(group);
            if (!motion.anchors().empty()) continue;
            restore_spin(motion, group.spin, group.lost / square(per_h_), group.motorized);
            if (nothing_else_acts()) motion.take_drift();
        }
    }

  private:
    using Vector = Vec<D, double>;
    using Motion = GroupMotion<D, Real>;
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    SweepState<D, Real>& swept_;
    Blocks<D>& blocks_;
    Ports<D>& ports_;
    GroupEnergy<D, Real> energy_;
    double per_h_;

    /// True if nothing but constraints within and force fields act on what no pin holds.
    bool nothing_else_acts() const {
        return !has_walls(world_) && !has_figure_contacts(solver_) && !swept_.any_pin_soft;
    }
    Motion motion_of(const PortGroup<D>& group) const { return {swept_, ports_, group}; }

    /// Debts of the step before. Groups come together and fall apart: the debt of one is the sum over its particles.
    void take_debts() {
        for (auto& group : ports_.groups) {
            group.debt = 0;
            if (group.anchors > 0 && !group.motorized)
                for (const auto s : motion_of(group).members()) group.debt += debts()[swept_.row_of[s]];
            for (const auto s : motion_of(group).members()) debts().set(swept_.row_of[s], 0);
        }
    }
    void note_debt(PortGroup<D>& group) {
        group.debt = group.anchors > 0 ? max(0.0, -group.lost) : 0;
        debts().set(swept_.row_of[motion_of(group).members().front()], group.debt);
    }
    Column<double>& debts() const { return world_.particles.energy_debt; }

    /// Notes the factor of the velocities that removes the gain, and energy that constraints have taken, or that is
    /// still owed.
    static void find_share(PortGroup<D>& group, const GroupGain& gain) {
        group.share = 1, group.lost = 0;
        if (group.motorized) return;
        group.share = gain.share_of_velocities();
        const double left = gain.left(group.share);
        if (gain.gain <= 0 || left > gain.rounding * gain.kinetic) group.lost = -left;
    }

    /// True if the motion of a group would multiply, or if positions were raised by far more than velocities can pay.
    bool is_excessive(const PortGroup<D>& group) const {
        constexpr double min = 0.7;     // share of the velocity; above it solved positions are kept
        constexpr double slight = 5e-4; // of weight times size
        if (group.share < min && energy_.is_multiplied(group)) return true;
        return group.anchors > 0 && group.lost < 0 && group.lost < -slight * energy_.weight_times_size(group);
    }

    /// Slows a group down before positions advance. The same share of every displacement takes a link that has turned
    /// off its length: such a block stays in its place.
    void hold_back(const PortGroup<D>& group, double share) {
        slow_down(group, share);
        const auto motion = motion_of(group);
        typename Motion::Frame frame;
        motion.find_frame(frame);
        for (const auto& block : blocks_.attached_trees) {
            const auto nodes = std::span(blocks_.nodes).subspan(block.first_node, block.unknowns);
            const bool within = std::ranges::binary_search(motion.members(), swept_.slot_of[nodes.front().row]);
            if (!within || keeps_lengths(motion, block)) continue;
            for (const auto& node : nodes) {
                const Row slot = swept_.slot_of[node.row];
                swept_.set_displacement(slot, cast<Real>(frame.at(motion.position(slot))));
            }
        }
    }
    bool keeps_lengths(const Motion& motion, const Block& block) const {
        constexpr double slight = 1e-6;
        const auto position = [&](std::uint32_t node) {
            const Row slot = swept_.slot_of[blocks_.nodes[node].row];
            return motion.position(slot) + motion.displacement(slot);
        };
        const auto links = std::span(blocks_.links).subspan(block.first_link, block.links - block.load_tethers);
        return std::ranges::all_of(links, [&](const auto& link) {
            const double length = norm(position(link.b) - position(link.a));
            return length <= link.high * (1 + slight) && length >= link.low * (1 - slight);
        });
    }

    void slow_down(const PortGroup<D>& group, double share) {
        typename Motion::Frame frame;
        const auto motion = motion_of(group);
        motion.find_frame(frame);
        motion.replace(frame, frame, share);
    }
};

} // namespace sinew::detail
