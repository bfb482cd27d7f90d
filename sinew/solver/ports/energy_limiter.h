#pragma once

#include "sinew/solver/ports/group_spin.h"
#include "sinew/solver/project.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>

/// Energy limit of blocks and sweep together. Sweeps and linear models leave errors, and repairing one may do work.
/// Under impulses J of the constraints a particle goes from velocity v to v', without them to u; with the potential
/// taken half way,
///
///     E' - E = sum J . (v + v')/2,        J = m (v' - u)
///
/// to rounding. Any excess over the energy from springs and soft pins is taken from the velocities: relative to the
/// rigid-body motion of a free group, to the motion of the pins of a held one. Positions stay as solved, unless the
/// energy would multiply.
namespace sinew::detail {

template <int D, class Real> class EnergyLimiter {
  public:
    EnergyLimiter(World<D, Real>& world, Solver<D, Real>& solver, Real h)
        : world_(world), solver_(solver), scratch_(solver.scratch), swept_(solver.sweep_state), blocks_(solver.blocks),
          ports_(solver.blocks.ports), per_h_(1 / double(h)) {}

    /// Notes the motion and the stored energy before a substep, which is the `number`-th of its step.
    void begin(int number) {
        if (ports_.groups.empty()) return;
        if (number == 1)
            for (auto& group : ports_.groups) group.lost = 0;
        for (Row s = 0; s < swept_.size(); ++s) ports_.last_displacements[s] = cast<double>(swept_.displacement_at(s));
        for (auto& group : ports_.groups) group.stored = stored(group, false);
    }
    /// Measures the gains once all moves are known, before positions advance. A group whose motion would multiply is
    /// slowed down at once.
    void find_gains() {
        constexpr double min = 0.7; // share of the velocity; above it solved positions are kept
        for (auto& group : ports_.groups) {
            const auto motion = motion_of(group);
            if (motion.anchors().empty() && nothing_else_acts()) motion.take_drift();
            const double owed = motion.anchors().empty() ? 0 : max(0.0, -group.lost);
            group.lost = 0;
            group.share = group.motorized ? 1 : share_left(group, owed);
            if (motion.anchors().empty()) {
                group.spin = due_spin(motion);
                if (group.lost < 0) stiffen(motion, group.spin), group.share = 1, group.lost = 0;
            }
            if (group.share < min && is_multiplied(group)) hold_back(group), group.share = 1;
        }
    }
    /// Removes the gains once positions have advanced.
    void take_gains() {
        for (const auto& group : ports_.groups) {
            if (group.share < 1) slow_down(group);
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
    std::span<Vec<D, Real>> scratch_;
    SweepState<D, Real>& swept_;
    Blocks<D>& blocks_;
    Ports<D>& ports_;
    double per_h_;

    /// True if nothing but constraints within and force fields act on what no pin holds.
    bool nothing_else_acts() const {
        return !has_walls(world_) && !has_figure_contacts(solver_) && !swept_.any_pin_soft;
    }
    Motion motion_of(const PortGroup<D>& group) const { return {swept_, ports_, group}; }

    /// Factor of the velocities that removes energy added by constraints, and `owed` since an earlier substep of the
    /// step, 0..1. Notes energy that they have taken, or that is still owed.
    ///
    /// A velocity that is scaled by s once the particle has moved changes the place of the middle of the substep, where
    /// potentials are taken. The energy removed is
    ///
    ///     K (1 - s^2) + Q (1 - s),        Q = sum f . v'/2
    ///
    /// with the kinetic energy K and the impulses f from outside.
    double share_left(PortGroup<D>& group, double owed) const {
        const auto motion = motion_of(group);
        typename Motion::Frame frame;
        if (!motion.find_frame(frame)) return 1;
        double work = 0, kinetic = 0, outer = 0;
        for (const auto s : motion.members()) {
            const auto own = motion.displacement(s) - frame.at(motion.position(s));
            work += 0.5 * motion.mass(s) *
                    dot(motion.last_displacement(s) + motion.displacement(s) - frame.velocity * 2.0,
                        motion.displacement(s) - motion.free_move(s));
            kinetic += 0.5 * motion.mass(s) * dot(own, own);
            outer += 0.5 * motion.mass(s) * dot(motion.free_move(s) - motion.last_displacement(s), own);
        }
        work -= of_soft_pins(motion, frame.velocity);
        const double gain = owed + work * square(per_h_) + (group.springs > 0 ? stored(group, true) - group.stored : 0);
        kinetic *= square(per_h_), outer *= square(per_h_);
        constexpr double rounding = 1e-14;
        const double share = gain > rounding * kinetic ? share_without(gain, kinetic, outer) : 1;
        const double left = gain - kinetic * (1 - square(share)) - outer * (1 - share);
        if (gain <= 0 || left > rounding * kinetic) group.lost = -left;
        return share;
    }
    /// The larger root, or the share at which most is removed.
    static double share_without(double gain, double kinetic, double outer) {
        const double root2 = square(outer + 2 * kinetic) - 4 * kinetic * gain;
        const double share = (square_root(max(0.0, root2)) - outer) * inverse_or_zero(2 * kinetic);
        return clamp(share, 0.0, 1.0);
    }

    /// True if constraints multiplied the motion of a group, and moved particles by more than a link.
    bool is_multiplied(const PortGroup<D>& group) const {
        constexpr double times = 4;
        const auto motion = motion_of(group);
        double had = 0, has = 0, max = 0;
        for (const auto s : motion.members()) {
            const auto &last = motion.last_displacement(s), &free = motion.free_move(s), now = motion.displacement(s);
            had += motion.mass(s) * (dot(last, last) + dot(free, free));
            has += motion.mass(s) * dot(now, now);
            max += motion.mass(s) * square(group.length);
        }
        return has > times * had && has > max;
    }

    /// Slows a group down before positions advance. The same share of every displacement takes a link that has turned
    /// off its length: such a block stays in its place.
    void hold_back(const PortGroup<D>& group) {
        slow_down(group);
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

    void slow_down(const PortGroup<D>& group) {
        typename Motion::Frame frame;
        const auto motion = motion_of(group);
        motion.find_frame(frame);
        motion.replace(frame, frame, group.share);
    }

    double of_soft_pins(const Motion& motion, const Vector& frame) const {
        if (!swept_.any_pin_soft) return 0;
        double work = 0;
        for (const auto& pinned : swept_.plan.pins) {
            const auto& pin = world_.pins[pinned.pin];
            if (pin.hard() || !std::ranges::binary_search(motion.members(), pinned.slot)) continue;
            work += 0.5 * dot(cast<double>(pin.multiplier),
                              motion.last_displacement(pinned.slot) + motion.displacement(pinned.slot) - frame * 2.0);
        }
        return work;
    }

    /// Energy in the springs of a group, before or after the move.
    double stored(const PortGroup<D>& group, bool moved) const {
        double sum = 0;
        for (const auto& spring : std::span(ports_.springs).subspan(group.first_spring, group.springs))
            visit_table(world_, spring.kind, [&](const auto& table) { sum += stored(table, spring.row, moved); });
        return sum;
    }
    template <class Table> double stored(const Table& table, Row row, bool moved) const {
        const auto members = table.members[row];
        Stencil<typename Table::Kind, D, Real> stencil(scratch_, members.size());
        stencil.each([&](std::size_t i) {
            const Row slot = swept_.slot_of[members[i]];
            stencil.points[i] = swept_.position_at(slot) + (moved ? swept_.displacement_at(slot) : Vec<D, Real>{});
        });
        const Real measure = unwrap<typename Table::Kind>(stencil.evaluate(stencil.points, stencil.gradient),
                                                          table.low(row), table.high(row));
        return table.spring_energy(row, double(measure - clamp(measure, table.low(row), table.high(row))));
    }
};

} // namespace sinew::detail
