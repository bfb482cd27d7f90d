#pragma once

#include "sinew/solver/ports/group_motion.h"
#include "sinew/solver/project.h"
#include "sinew/world/world.h"

/// Energy of a group in a substep. Under impulses J of the constraints a particle goes from velocity v to v', without
/// them to u; with the potential taken half way,
///
///     E' - E = sum J . (v + v')/2,        J = m (v' - u)
///
/// to rounding.
namespace sinew::detail {

/// Energy that constraints have added to a group, J, and what a smaller motion takes of it.
struct GroupGain {
    double gain = 0;    ///< with the debt of earlier substeps
    double kinetic = 0; ///< of the motion beside the frame
    double outer = 0;   ///< work of the impulses from outside along half of this motion

    static constexpr double rounding = 1e-14; ///< share of the kinetic energy

    /// Factor of the velocities, 0..1, that removes the gain once the particles have moved, or the most of it. A
    /// velocity that is scaled by s moves the middle of the substep as well, where potentials are taken. This removes
    ///
    ///     K (1 - s^2) + Q (1 - s),        Q = sum f . v'/2
    ///
    /// with the kinetic energy K and the impulses f from outside.
    double share_of_velocities() const { return share(outer); }
    /// The same for a factor of displacements and velocities alike: it removes K (1 - s^2) - Q (1 - s).
    double share_of_moves() const { return share(-outer); }
    /// Gain left by a factor of the velocities.
    double left(double share) const { return gain - kinetic * (1 - square(share)) - outer * (1 - share); }

  private:
    /// The larger root, or the share at which most is removed.
    double share(double work) const {
        if (gain <= rounding * kinetic) return 1;
        const double root2 = square(work + 2 * kinetic) - 4 * kinetic * gain;
        return clamp((square_root(max(0.0, root2)) - work) * inverse_or_zero(2 * kinetic), 0.0, 1.0);
    }
};

/// Measures the energy of groups.
template <int D, class Real> class GroupEnergy {
  public:
    using Motion = GroupMotion<D, Real>;

    GroupEnergy(World<D, Real>& world, Solver<D, Real>& solver, Real h)
        : world_(world), scratch_(solver.scratch), swept_(solver.sweep_state), ports_(solver.blocks.ports),
          per_h2_(square(1 / double(h))) {}

    /// Energy that constraints have added in the substep, beside the one in springs and soft pins; zero where pins are
    /// carried apart.
    GroupGain gain(const PortGroup<D>& group) const {
        const Motion motion{swept_, ports_, group};
        typename Motion::Frame frame;
        if (!motion.find_frame(frame)) return {};
        double work = 0;
        GroupGain sum;
        for (const auto s : motion.members()) {
            const auto own = motion.displacement(s) - frame.at(motion.position(s));
            work += 0.5 * motion.mass(s) *
                    dot(motion.last_displacement(s) + motion.displacement(s) - frame.velocity * 2.0,
                        motion.displacement(s) - motion.free_move(s));
            sum.kinetic += 0.5 * motion.mass(s) * dot(own, own);
            sum.outer += 0.5 * motion.mass(s) * dot(motion.free_move(s) - motion.last_displacement(s), own);
        }
        work -= of_soft_pins(motion, frame.velocity);
        sum.gain = group.debt + work * per_h2_ + (group.springs > 0 ? stored(group, true) - group.stored : 0);
        sum.kinetic *= per_h2_, sum.outer *= per_h2_;
        return sum;
    }

    /// True if constraints multiplied the motion of a group, and moved particles by more than a link.
    bool is_multiplied(const PortGroup<D>& group) const {
        constexpr double times = 4;
        const Motion motion{swept_, ports_, group};
        double had = 0, has = 0, max = 0;
        for (const auto s : motion.members()) {
            const auto &last = motion.last_displacement(s), &free = motion.free_move(s), now = motion.displacement(s);
            had += motion.mass(s) * (dot(last, last) + dot(free, free));
            has += motion.mass(s) * dot(now, now);
            max += motion.mass(s) * square(group.length);
        }
        return has > times * had && has > max;
    }

    /// Weight times size: the energy that it takes to raise a group by its largest distance from a pin.
    double weight_times_size(const PortGroup<D>& group) const {
        const Motion motion{swept_, ports_, group};
        double mass = 0, far2 = 0;
        const auto from = motion.position(motion.anchors().front());
        for (const auto s : motion.members()) {
            const auto arm = motion.position(s) - from;
            mass += motion.mass(s), far2 = max(far2, dot(arm, arm));
        }
        return mass * norm(cast<double>(swept_.gravity)) * square_root(far2);
    }

    /// Energy in the springs of a group, before or after the move.
    double stored(const PortGroup<D>& group, bool moved) const {
        double sum = 0;
        for (const auto& spring : std::span(ports_.springs).subspan(group.first_spring, group.springs))
            visit_table(world_, spring.kind, [&](const auto& table) { sum += stored(table, spring.row, moved); });
        return sum;
    }

  private:
    World<D, Real>& world_;
    std::span<Vec<D, Real>> scratch_;
    SweepState<D, Real>& swept_;
    Ports<D>& ports_;
    double per_h2_;

    double of_soft_pins(const Motion& motion, const Vec<D, double>& frame) const {
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
