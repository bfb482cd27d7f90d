#include "sinew/solver/phases.h"
#include "sinew/solver/step/body_motion.h"
#include "sinew/solver/step/energy_measure.h"
#include "sinew/solver/step/sleep_islands.h"
#include "sinew/world/asleep.h"

#include <algorithm>

/// Bound of the energy of a step. Constraints, contacts with resting bodies and friction do no work together: the
/// kinetic energy, the potential of gravity and the energy of springs, at the ends of substeps, never rise in an
/// implicit step that is solved to its end. An unfinished sweep, or a row of contact beside another, may add energy all
/// the same. Any gain of an island, bodies near enough to touch each other, is taken from the motion of the bodies that
/// gained it. Where something pushes them: from the motion relative to the rigid body with the same momenta, then from
/// the whole; a gain in height alone is left where something touches, for figures that begin inside each other part. In
/// free flight: from the motion relative to the rigid body, from the rotation of a shrunk body, both of which keep
/// the momenta; then from the motion of bodies past each other, and from their rotation.
///
/// Islands that something else moves are not judged: driven pins, limits, colliders and belts, forces of the program;
/// nor is a world with winds or attractors.
namespace sinew {
namespace {

template <int D, class Real> class EnergyBound {
  public:
    EnergyBound(World<D, Real>& world, Solver<D, Real>& solver, double dt)
        : world_(world), p_(world.particles), bodies_(solver.energy->found), room_(*solver.energy),
          measure_(world, solver.sweep_state, room_, dt), dt_(dt) {}

    /// True where gravity and drag are the only forces.
    bool applies() const {
        return std::all_of(world_.forces.begin(), world_.forces.end(), [](const auto& force) {
            return std::holds_alternative<Gravity<D, Real>>(force) || std::holds_alternative<Drag<D, Real>>(force);
        });
    }

    void note() { measure_.note(); }
    void bound() {
        if (!room_.any_rows) return;
        constexpr int rounds = 4; // springs of a body that is moved gain in turn
        measure_.measure_springs(room_.next);
        for (int round = 0; round < rounds && measure_.measure_gains(); ++round) {
            reshaped_ = false;
            judge();
            if (!reshaped_) break;
            measure_.measure_springs(room_.next);
        }
        measure_.note_places();
        room_.stored = room_.next;
    }

  private:
    using Vector = Vec<D, double>;

    World<D, Real>& world_;
    Particles<D, Real>& p_;
    SleepRoom<D, Real>& bodies_;
    EnergyRoom<D, Real>& room_;
    detail::EnergyMeasure<D, Real> measure_;
    double dt_;
    bool reshaped_ = false; ///< some particle has been moved

    std::uint32_t island_of(std::uint32_t body) { return bodies_.sets.first_of(body); }
    IslandGain<D>& island(std::uint32_t body) { return room_.islands[island_of(body)]; }

    /// Takes gains back.
    void judge() {
        detail::SleepIslands<D, Real> islands(world_, bodies_, Real(dt_));
        islands.mark_moved();
        mark_driven();
        islands.find_met(room_.position, room_.velocity);
        if (!choose()) return;
        room_.islands.assign(bodies_.boxes.size(), {});
        each_judged([&](std::uint32_t i) { island(i).sum += room_.bodies[i], ++island(i).bodies; });
        for (auto& island : room_.islands) island.pushed = island.sum.is_pushed();
        each_judged([&](std::uint32_t i) { island(i).all += max(gained(i), 0.0); });
        each_judged([&](std::uint32_t i) { take(i); });
        slow_approach();
    }
    template <class Visit> void each_judged(Visit&& visit) {
        for (std::uint32_t i = 0; i < room_.bodies.size(); ++i)
            if (room_.is_judged[island_of(i)] && !p_.asleep[bodies_.bodies[i].first]) visit(i);
    }
    double gained(std::uint32_t i) { return room_.bodies[i].seen_from(island(i).sum, island(i).pushed); }

    /// Marks bodies that a force from outside or a turning motor moves, and belts.
    void mark_driven() {
        const auto count = bodies_.bodies.size();
        if (p_.any_force)
            for (Row row = 0; row < p_.size(); ++row)
                if (p_.force[row] != Vec<D, Real>{}) bodies_.is_restless[bodies_.body_of[row]] = 1;
        for (std::size_t i = 0; i < world_.colliders.size(); ++i)
            if (world_.colliders[i].is_driven()) bodies_.is_restless[count + i] = 1;
        for (const auto& pin : world_.pins)
            if (const auto row = p_.handles.find(pin.particle); row && pin.max_force > Real(0))
                bodies_.is_restless[bodies_.body_of[*row]] = 1;
        for_each_table(world_, [&](const auto& table) {
            if (!table.motor_speed.any_of([](Real speed) { return speed != Real(0); })) return;
            for (Row row = 0; row < table.size(); ++row)
                if (table.motor_speed[row] != Real(0))
                    for (const Row member : table.members[row]) bodies_.is_restless[bodies_.body_of[member]] = 1;
        });
    }

    /// Chooses the islands in which a body gained. False if there are none.
    bool choose() {
        room_.is_judged.assign(bodies_.boxes.size(), 0);
        bool any = false;
        for (std::uint32_t i = 0; i < room_.bodies.size(); ++i) {
            if (!room_.may_have_gained[i] || bodies_.is_restless[island_of(i)]) continue;
            room_.is_judged[island_of(i)] = 1, any = true;
        }
        return any;
    }

    /// Takes from a body what its island gained, in proportion to what the body did. In an island that nothing pushes,
    /// the rest of it is left to the island.
    void take(std::uint32_t i) {
        auto& island = this->island(i);
        const auto& body = room_.bodies[i];
        const double excess = island.sum.seen_from(island.sum, island.pushed) - island.sum.tolerance(island.pushed);
        const double own = gained(i);
        if (!(excess > 0) || !(own > 0) || room_.rows[i].empty()) return;
        const double due = excess * own / island.all;
        if (!island.pushed) {
            island.left += due - slow_inside(i, due);
            return;
        }
        const double left = due - slow_down(i, due);
        if (left > 0 && body.higher > 0 && island.bodies == 1 && is_apart(i))
            hold_back(i, max(1 - left / body.higher, 0.0));
    }
    /// Takes energy from a body that pins or walls push. Returns how much it took.
    double slow_down(std::uint32_t number, double energy) {
        const auto& body = room_.bodies[number];
        detail::BodyMotion<D, Real> motion(p_, room_.rows[number]);
        const double taken = body.is_held ? 0 : motion.slow_inner(energy);
        const double whole = body.kinetic - taken, rest = min(energy - taken, whole);
        motion.slow(square_root(max(1 - rest * inverse_or_zero(whole), 0.0)), !room_.spin.empty());
        return taken + rest;
    }
    /// True for a body that touches nothing, itself included.
    bool is_apart(std::uint32_t number) const {
        const auto& body = bodies_.bodies[number];
        if (body.has_several_figures || body.figure >= world_.figures.size()) return false;
        if (world_.figures[body.figure].touches_itself) return false;
        const auto& box = bodies_.boxes[number];
        for (std::size_t i = 0; i < bodies_.boxes.size(); ++i) {
            if (i < bodies_.bodies.size() && (bodies_.bodies[i].is_movable || bodies_.bodies[i].figure == body.figure))
                continue;
            if (box.overlaps(bodies_.boxes[i])) return false;
        }
        return std::ranges::none_of(world_.bounds, [&](const auto& plane) {
            const auto lowest =
                Vec<D, Real>::map([&](int k) { return plane.normal[k] > Real(0) ? box.low[k] : box.high[k]; });
            return dot(plane.normal, lowest) < plane.offset;
        });
    }
    /// Keeps a share of the way of a body in the step: constraints alone have lifted it.
    void hold_back(std::uint32_t number, double share) {
        for (const Row row : room_.rows[number]) {
            const auto from = cast<double>(room_.position[row]);
            p_.position[row] = cast<Real>(from + (cast<double>(p_.position[row]) - from) * share);
            p_.residual[row] = {};
        }
        reshaped_ = true;
    }
    /// Takes energy from a body, and leaves both momenta. Returns how much it took.
    double slow_inside(std::uint32_t number, double energy) {
        if (room_.bodies[number].is_held) return 0;
        detail::BodyMotion<D, Real> motion(p_, room_.rows[number]);
        const double taken = motion.slow_inner(energy);
        if (taken >= energy) return taken;
        const double grown = motion.grow_back(room_.position, energy - taken);
        reshaped_ = reshaped_ || grown > 0;
        return taken + grown;
    }
    /// Takes what is left from the motion of the bodies of an island past each other.
    void slow_approach() {
        const auto past = [&](std::uint32_t i) {
            const auto &body = room_.bodies[i], &whole = island(i).sum;
            return body.after * inverse_or_zero(body.mass) - whole.after * inverse_or_zero(whole.mass);
        };
        const auto each = [&](auto&& visit) {
            each_judged([&](std::uint32_t i) {
                if (island(i).left > 0 && bodies_.bodies[i].is_movable) visit(i);
            });
        };
        each([&](std::uint32_t i) { island(i).apart += 0.5 * room_.bodies[i].mass * dot(past(i), past(i)); });
        each([&](std::uint32_t i) {
            const auto& whole = island(i);
            const auto less = past(i) * (1 - square_root(max(1 - whole.left * inverse_or_zero(whole.apart), 0.0)));
            for (const Row row : room_.rows[i]) p_.velocity[row] -= cast<Real>(less);
        });
        each([&](std::uint32_t i) { slow_turn(i); });
    }
    /// Takes the rest from the rotation of the bodies of an island: an unfinished sweep has turned them. A
    /// body whose springs gained more than that gets the shape back that it had.
    void slow_turn(std::uint32_t i) {
        const auto& island = this->island(i);
        const double left = island.left - island.apart, own = gained(i);
        if (!(left > 0) || !(own > 0) || room_.bodies[i].is_held) return;
        const double due = left * (own / island.all);
        detail::BodyMotion<D, Real> motion(p_, room_.rows[i]);
        if (due <= motion.slow_turn(due, !room_.spin.empty()) || !(room_.bodies[i].tenser > 0)) return;
        motion.put_back(room_.position);
        measure_.put_back_forces(i);
        reshaped_ = true;
    }
};

/// True if the last step moved a particle otherwise than in a direct block, which keeps its energy itself.
template <int D, class Real> bool any_swept(const Particles<D, Real>& p) {
    for (Row row = 0; row < p.size(); ++row)
        if (p.at_end[row] == 0 && p.mobility[row] > Real(0) && !p.asleep[row]) return true;
    return any_near(p);
}

} // namespace

template <int D, class Real> void make_energy_room(World<D, Real>& world, Solver<D, Real>& solver) {
    if (!solver.energy) solver.energy = std::make_shared<EnergyRoom<D, Real>>();
    if (world.settings.mode == Mode::classic) return;
    detail::EnergyMeasure<D, Real>(world, solver.sweep_state, *solver.energy, 0).find_bodies();
    solver.energy->reserve(world);
}

template <int D, class Real> void note_energy(World<D, Real>& world, Solver<D, Real>& solver) {
    EnergyBound<D, Real> bound(world, solver, 0);
    solver.energy->noted = bound.applies() && any_swept(world.particles);
    if (solver.energy->noted) bound.note();
}

template <int D, class Real> void bound_energy(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    if (solver.energy->noted) EnergyBound<D, Real>(world, solver, double(dt)).bound();
}

#define SINEW_ENERGY_BOUND(D, Real)                                                                                    \
    template void make_energy_room(World<D, Real>&, Solver<D, Real>&);                                                 \
    template void note_energy(World<D, Real>&, Solver<D, Real>&);                                                      \
    template void bound_energy(World<D, Real>&, Solver<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_ENERGY_BOUND)

} // namespace sinew
