#pragma once

#include "sinew/solver/project.h"
#include "sinew/solver/rigid_motion.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <ranges>

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
        : world_(world), scratch_(solver.scratch), swept_(solver.sweep_state), ports_(solver.blocks.ports),
          per_h_(1 / double(h)) {}

    /// Notes the motion and the stored energy before a substep.
    void begin() {
        if (ports_.groups.empty()) return;
        for (Row s = 0; s < swept_.size(); ++s) ports_.last_moves[s] = cast<double>(swept_.move_at(s));
        for (auto& group : ports_.groups) group.stored = stored(group, false);
    }
    /// Measures the gains once all moves are known, before positions advance. A group whose motion would multiply is
    /// slowed down at once.
    void find_gains() {
        constexpr double least = 0.7; // share of the velocity; above it solved positions are kept
        for (auto& group : ports_.groups) {
            group.lost = 0;
            group.share = group.motorized ? 1 : share_left(group);
            if (anchors(group).empty()) {
                group.spin = due_spin(group);
                if (group.lost < 0) stiffen(group), group.share = 1, group.lost = 0;
            }
            if (group.share < least && is_multiplied(group)) slow_down(group), group.share = 1;
        }
    }
    /// Removes the gains once positions have advanced.
    void take_gains() {
        for (const auto& group : ports_.groups) {
            if (group.share < 1) slow_down(group);
            if (anchors(group).empty()) restore_spin(group);
        }
    }

  private:
    using Vector = Vec<D, double>;
    World<D, Real>& world_;
    std::span<Vec<D, Real>> scratch_;
    SweepState<D, Real>& swept_;
    Ports<D>& ports_;
    double per_h_;

    std::span<const std::uint32_t> members(const PortGroup<D>& group) const {
        return std::span(ports_.members).subspan(group.first, group.members);
    }
    std::span<const std::uint32_t> anchors(const PortGroup<D>& group) const {
        return std::span(ports_.anchors).subspan(group.first_anchor, group.anchors);
    }
    /// A particle with its displacement in the substep as its velocity.
    struct Body {
        double mass = 0;
        Vector place{}, velocity{};
    };
    static Vector place_of(const Body& body) { return body.place; }
    auto bodies(const PortGroup<D>& group) const {
        return std::views::transform(members(group), [this](Row s) { return Body{mass(s), place(s), move(s)}; });
    }
    Vector place(Row slot) const { return cast<double>(swept_.place_at(slot)); }

    /// Motion of a rigid body, in which the rest of a group's motion is measured.
    struct Frame {
        Vector center{}, velocity{};
        typename RigidMotion<D>::Spin rate{}; ///< radians a substep

        Vector at(const Vector& place) const { return velocity + turning(rate, place - center); }
    };

    double mass(Row slot) const { return inverse_or_zero(ports_.mobilities[slot]); }
    Vector move(Row slot) const { return cast<double>(swept_.move_at(slot)); }

    /// Factor of the velocities that removes energy added by constraints, 0..1. Notes energy that they have taken, or
    /// added to the motion as one body.
    double share_left(PortGroup<D>& group) const {
        Frame frame;
        if (!find_frame(group, frame)) return 1;
        double work = 0, kinetic = 0;
        for (const auto s : members(group)) {
            const auto own = move(s) - frame.at(place(s));
            work += 0.5 * mass(s) *
                    dot(ports_.last_moves[s] + move(s) - frame.velocity * 2.0, move(s) - ports_.free_moves[s]);
            kinetic += 0.5 * mass(s) * dot(own, own);
        }
        work -= of_soft_pins(group, frame.velocity);
        const double gain = work * square(per_h_) + (group.springs > 0 ? stored(group, true) - group.stored : 0);
        kinetic *= square(per_h_);
        constexpr double rounding = 1e-14;
        group.lost = gain <= 0 ? -gain : minimum(kinetic - gain, 0.0);
        return gain > rounding * kinetic ? square_root(maximum(0.0, 1 - gain / kinetic)) : 1;
    }

    using Motion = RigidMotion<D>;
    using Spin = typename Motion::Spin;

    /// Angular momentum about its centre that a free group has after the substep: the initial one and the moment of
    /// the external impulses, about the mean of the centres at both ends.
    Spin due_spin(const PortGroup<D>& group) const {
        const auto after = Motion::of(bodies(group), place_of);
        const auto drift = after.momentum * inverse_or_zero(after.mass);
        Spin spin{};
        for (const auto s : members(group)) {
            const auto arm = place(s) - after.center;
            spin += moment(arm, ports_.last_moves[s] * mass(s));
            spin += moment(arm + (move(s) - drift) * 0.5, (ports_.free_moves[s] - ports_.last_moves[s]) * mass(s));
        }
        return spin;
    }
    /// Turns the velocities of a free group until its angular momentum is the due one. The energy of the rotation is
    /// what constraints have taken in the substep, and then a part of the rest of the motion: a lost spin gained back
    /// must not be gained twice. Without as much energy some of the spin stays lost, as where a mesh drawn out by a
    /// load contracts: the same spin would turn it faster.
    void restore_spin(const PortGroup<D>& group) {
        const auto now = Motion::of(bodies(group), place_of);
        auto missing = now;
        missing.spin = group.spin - now.spin;
        const auto drift = now.momentum * inverse_or_zero(now.mass);
        const Frame present{now.center, drift, now.rate_of(bodies(group), place_of)};
        const Frame added{now.center, drift, missing.rate_of(bodies(group), place_of)};
        const double inner = energy_beside(group, present), lost = group.lost / square(per_h_);
        Frame due = present;
        due.rate = group.motorized ? present.rate + added.rate : affordable(group, present, added, inner + lost);
        const double rise = energy_between(group, present, due) - lost;
        const double share = rise > 0 ? square_root(maximum(0.0, 1 - rise * inverse_or_zero(inner))) : 1;
        for (const auto s : members(group)) {
            const auto own = move(s) - present.at(place(s));
            swept_.set_move(s, cast<Real>(due.at(place(s)) + own * share));
        }
    }
    /// Rate of a rotation, with as much of the added one as raises the energy by `most` or less: the fraction f of
    ///
    ///     q f^2 + a f = most,        0 <= f <= 1
    Spin affordable(const PortGroup<D>& group, const Frame& present, const Frame& added, double most) const {
        const Frame still{present.center, present.velocity, {}};
        Frame whole = present;
        whole.rate = present.rate + added.rate;
        const double rise = energy_between(group, present, whole);
        if (rise <= most) return whole.rate;
        const double q = energy_between(group, still, added), a = rise - q;
        const double root = square_root(maximum(a * a + 4 * q * most, 0.0));
        const double f = a >= 0 ? 2 * most * inverse_or_zero(a + root) : (root - a) * inverse_or_zero(2 * q);
        return present.rate + added.rate * clamp(f, 0.0, 1.0);
    }
    /// Moves a free group as one rigid body with the spin due: of all motions with this spin the one of least energy,
    /// for a substep in which constraints add more than all of the inner motion.
    void stiffen(const PortGroup<D>& group) {
        auto due = Motion::of(bodies(group), place_of);
        due.spin = group.spin;
        const Frame frame{due.center, due.momentum * inverse_or_zero(due.mass), due.rate_of(bodies(group), place_of)};
        for (const auto s : members(group)) swept_.set_move(s, cast<Real>(frame.at(place(s))));
    }
    /// Energy of the motion relative to a frame, times h^2.
    double energy_beside(const PortGroup<D>& group, const Frame& frame) const {
        double sum = 0;
        for (const auto s : members(group)) {
            const auto own = move(s) - frame.at(place(s));
            sum += 0.5 * mass(s) * dot(own, own);
        }
        return sum;
    }
    /// Energy that a group gains about its centre if it turns as one frame in place of the other, times h^2.
    double energy_between(const PortGroup<D>& group, const Frame& one, const Frame& other) const {
        double sum = 0;
        for (const auto s : members(group)) {
            const auto from = one.at(place(s)) - one.velocity, to = other.at(place(s)) - other.velocity;
            sum += 0.5 * mass(s) * (dot(to, to) - dot(from, from));
        }
        return sum;
    }

    /// True if constraints multiplied the motion of a group, and moved particles by more than a link.
    bool is_multiplied(const PortGroup<D>& group) const {
        constexpr double times = 4;
        double had = 0, has = 0, most = 0;
        for (const auto s : members(group)) {
            const auto &last = ports_.last_moves[s], &free = ports_.free_moves[s], now = move(s);
            had += mass(s) * (dot(last, last) + dot(free, free));
            has += mass(s) * dot(now, now);
            most += mass(s) * square(group.length);
        }
        return has > times * had && has > most;
    }

    /// Frame in which energy is measured: pins that are all carried alike do no work in this one. False for other pins.
    bool find_frame(const PortGroup<D>& group, Frame& frame) const {
        const auto held = anchors(group);
        if (held.empty()) {
            const auto motion = RigidMotion<D>::of(bodies(group), place_of);
            frame = {motion.center, motion.momentum * inverse_or_zero(motion.mass),
                     motion.rate_of(bodies(group), place_of)};
            return true;
        }
        frame.velocity = move(held.front());
        return std::all_of(held.begin(), held.end(), [&](Row s) { return move(s) == frame.velocity; });
    }

    void slow_down(const PortGroup<D>& group) {
        Frame frame;
        find_frame(group, frame);
        for (const auto s : members(group)) {
            const auto whole = frame.at(place(s));
            swept_.set_move(s, cast<Real>(whole + (move(s) - whole) * group.share));
        }
    }

    double of_soft_pins(const PortGroup<D>& group, const Vector& frame) const {
        if (!swept_.any_pin_soft) return 0;
        double work = 0;
        for (const auto& pinned : swept_.plan.pins) {
            const auto& pin = world_.pins[pinned.pin];
            if (pin.hard() || !is_in(group, pinned.slot)) continue;
            work += 0.5 *
                    dot(cast<double>(pin.multiplier), ports_.last_moves[pinned.slot] + move(pinned.slot) - frame * 2.0);
        }
        return work;
    }
    bool is_in(const PortGroup<D>& group, Row slot) const {
        const auto all = members(group);
        return std::binary_search(all.begin(), all.end(), slot);
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
            stencil.points[i] = swept_.place_at(slot) + (moved ? swept_.move_at(slot) : Vec<D, Real>{});
        });
        const Real measure = unwrap<typename Table::Kind>(stencil.evaluate(stencil.points, stencil.gradient),
                                                          table.low(row), table.high(row));
        const double error = double(measure - clamp(measure, table.low(row), table.high(row)));
        return 0.5 * square(error) / double(table.compliance[row]);
    }
};

} // namespace sinew::detail
