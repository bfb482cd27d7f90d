#include "sinew/solver/phases.h"
#include "sinew/solver/step/sleep_islands.h"
#include "sinew/world/asleep.h"
#include "sinew/world/changes.h"
#include "sinew/world/parameter_hash.h"

namespace sinew {
namespace {

/// Sleep at the beginning and the end of a step. Everything that decides who sleeps is state of the world; the bodies
/// follow from it.
template <int D, class Real> class Sleep {
  public:
    Sleep(World<D, Real>& world, Solver<D, Real>& solver, Real dt)
        : world_(world), p_(world.particles), room_(room_of(solver)), islands_(world, room_, dt), dt_(dt) {}

    /// Notes the momenta of bodies before the step.
    void note_momenta() {
        if (!sleeps(world_) || room_.body_of.size() != p_.size()) return;
        room_.momentum.assign(room_.bodies.size(), {});
        for (Row row = 0; row < p_.size(); ++row)
            if (p_.inverse_mass[row] > Real(0))
                room_.momentum[room_.body_of[row]] += p_.velocity[row] * (Real(1) / p_.inverse_mass[row]);
    }

    /// Wakes the islands that something may touch in the step, that are moved, or all after an edit.
    void wake() {
        if (std::exchange(room_.edits, world_.journal.edits) != world_.journal.edits)
            detail::SleepBodyFinder(world_, room_).run();
        if (!any_asleep(p_)) return;
        if (!sleeps(world_) || parameter_hash(world_) != world_.sleep_parameters)
            return wake_if([](auto) { return true; });
        islands_.mark_moved();
        for (Row row = 0; row < p_.size(); ++row)
            if (p_.asleep[row] ? is_disturbed(row) : p_.mobility[row] > Real(0))
                room_.is_restless[room_.body_of[row]] = 1;
        if (std::find(room_.is_restless.begin(), room_.is_restless.end(), 1) == room_.is_restless.end()) return;
        islands_.find();
        wake_if([&](std::uint32_t body) { return islands_.is_restless(body); });
    }

    /// Puts islands to sleep whose bodies have been at rest for the delay.
    void fall_asleep() {
        if (room_.body_of.size() != p_.size() || room_.momentum.size() != room_.bodies.size()) return;
        islands_.measure_speeds();
        measure_forces();
        if (!count_rest()) return;
        islands_.mark_moved();
        for (std::uint32_t i = 0; i < room_.bodies.size(); ++i)
            if (room_.bodies[i].is_movable && !is_ready(room_.bodies[i])) room_.is_restless[i] = 1;
        islands_.find();
        for (Row row = 0; row < p_.size(); ++row)
            if (room_.bodies[room_.body_of[row]].is_movable && !p_.asleep[row] &&
                !islands_.is_restless(room_.body_of[row]))
                put_to_sleep(row);
    }

    static bool sleeps(const World<D, Real>& world) {
        return world.settings.sleep.speed > Real(0) && world.settings.mode == Mode::physical;
    }

  private:
    World<D, Real>& world_;
    Particles<D, Real>& p_;
    SleepRoom<D, Real>& room_;
    detail::SleepIslands<D, Real> islands_;
    Real dt_;

    static SleepRoom<D, Real>& room_of(Solver<D, Real>& solver) {
        if (!solver.sleep) solver.sleep = std::make_shared<SleepRoom<D, Real>>();
        return *solver.sleep;
    }
    bool is_disturbed(Row row) const {
        return p_.velocity[row] != Vec<D, Real>{} || p_.force[row] != Vec<D, Real>{} ||
               p_.spin[row] != Vec<spins<D>, Real>{};
    }
    template <class Is> void wake_if(Is&& is_woken) {
        for (Row row = 0; row < p_.size(); ++row) {
            const auto body = room_.body_of[row];
            if (!p_.asleep[row] || !is_woken(body)) continue;
            p_.asleep.set(row, 0);
            p_.rest_time.set(room_.bodies[body].first, Real(0));
            world_.journal.touch(p_.handles.index_of(row), Touch::joined);
        }
    }

    bool is_ready(const SleepBody& body) const {
        const Real rest = p_.rest_time[body.first];
        return p_.asleep[body.first] || (rest > Real(0) && rest >= world_.settings.sleep.delay);
    }
    /// Adds the step to the time at rest of each body, or begins it anew. True if a body is ready to fall asleep.
    bool count_rest() {
        const Real max = square(world_.settings.sleep.speed);
        const bool is_steady = std::all_of(world_.forces.begin(), world_.forces.end(), [](const auto& force) {
            const auto* wind = std::get_if<Wind<D, Real>>(&force);
            return !std::holds_alternative<RandomPush<D, Real>>(force) && !(wind && wind->gust != Vec<D, Real>{});
        });
        bool any = false;
        for (std::size_t i = 0; i < room_.bodies.size(); ++i) {
            const auto& body = room_.bodies[i];
            if (!body.is_movable || p_.asleep[body.first]) continue;
            const bool rests = is_steady && room_.squared_speed[i] <= max && is_held(i);
            p_.rest_time.set(body.first, rests ? p_.rest_time[body.first] + dt_ : Real(0));
            any = any || is_ready(body);
        }
        return any;
    }
    /// Momentum that each body has gained in the step, and what the forces on it alone would have added.
    void measure_forces() {
        room_.weight.assign(room_.bodies.size(), {});
        for (auto& momentum : room_.momentum) momentum = -momentum;
        for (Row row = 0; row < p_.size(); ++row) {
            if (!(p_.inverse_mass[row] > Real(0))) continue;
            const Real mass = Real(1) / p_.inverse_mass[row];
            room_.momentum[room_.body_of[row]] += p_.velocity[row] * mass;
            room_.weight[room_.body_of[row]] += forcing_on(world_, row).acceleration * (mass * dt_);
        }
    }
    /// True for a body whose weight something bears: at the top of a throw, or of a swing, it is slow and not at rest.
    bool is_held(std::size_t body) const {
        constexpr Real share = Real(0.05); // of its weight: a pendulum at 3 degrees
        return norm(room_.momentum[body]) <= share * norm(room_.weight[body]) || room_.weight[body] == Vec<D, Real>{};
    }
    void put_to_sleep(Row row) {
        p_.asleep.set(row, 1);
        p_.velocity[row] = {};
        if (p_.spin[row] != Vec<spins<D>, Real>{}) p_.spin.set(row, {});
        p_.previous[row] = p_.position[row];
        world_.journal.touch(p_.handles.index_of(row), Touch::joined);
    }
};

} // namespace

template <int D, class Real> void wake(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    if (!solver.sleep && !Sleep<D, Real>::sleeps(world) && world.sleep_parameters == 0) return;
    Sleep sleep(world, solver, dt);
    sleep.wake();
    sleep.note_momenta();
}

template <int D, class Real> void fall_asleep(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    if (Sleep<D, Real>::sleeps(world)) Sleep(world, solver, dt).fall_asleep();
}

template <int D, class Real> void note_sleep_parameters(World<D, Real>& world) {
    world.sleep_parameters = any_asleep(world.particles) ? parameter_hash(world) : 0;
}

#define SINEW_SLEEP(D, Real)                                                                                           \
    template void wake(World<D, Real>&, Solver<D, Real>&, Real);                                                       \
    template void fall_asleep(World<D, Real>&, Solver<D, Real>&, Real);                                                \
    template void note_sleep_parameters(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_SLEEP)

} // namespace sinew
