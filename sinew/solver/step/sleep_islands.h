#pragma once

#include "sinew/collide/filter.h"
#include "sinew/solver/step/sleep_bodies.h"

#include <algorithm>

/// Islands: sets of bodies near enough to touch each other within a step, found anew from the state of the world.
namespace sinew::detail {

template <int D, class Real> class SleepIslands {
  public:
    SleepIslands(const World<D, Real>& world, SleepRoom<D, Real>& room, Real dt)
        : world_(world), p_(world.particles), room_(room), dt_(dt) {}

    /// Marks the moving colliders, the bodies that a moving pin holds, and those with a motor.
    void mark_moved() {
        room_.is_restless.assign(room_.bodies.size() + world_.colliders.size(), 0);
        room_.is_carried.assign(p_.size(), 0);
        for (std::size_t i = 0; i < room_.bodies.size(); ++i) room_.is_restless[i] = room_.bodies[i].is_motorized;
        for (std::size_t i = 0; i < world_.colliders.size(); ++i)
            room_.is_restless[room_.bodies.size() + i] = !world_.colliders[i].is_at_rest();
        for (const auto& pin : world_.pins)
            if (const auto row = p_.handles.find(pin.particle); row && pin.from != pin.target)
                room_.is_carried[*row] = room_.is_restless[room_.body_of[*row]] = 1;
        for (const auto& [body, row] : room_.attached)
            if (room_.is_carried[row]) room_.is_restless[body] = 1;
    }

    /// Joins what may touch within the step into sets; a set with anything restless is restless.
    void find() {
        measure_speeds();
        make_boxes();
        join();
    }
    /// Joins what may have touched in a step that is over, which began at the positions and velocities `before`: a blow
    /// is foreseen, and turns a body back before it gets there.
    void find_met(std::span<const Vec<D, Real>> before, std::span<const Vec<D, Real>> velocity) {
        constexpr Real little = Real(0.01); // of the size: gaps at which contacts begin
        room_.boxes.assign(room_.bodies.size(), BoxT{});
        for (Row row = 0; row < p_.size(); ++row) {
            const Real way = max(norm(velocity[row]), norm(p_.velocity[row])) * dt_;
            for (const auto& place : {before[row], p_.position[row]})
                include(room_.boxes[room_.body_of[row]], row, place, way);
        }
        for (const auto& [body, row] : room_.attached) include(room_.boxes[body], row, p_.position[row]);
        for (auto& box : room_.boxes)
            if (box.low[0] <= box.high[0]) box = box.grown(little * norm(box.high - box.low));
        for (const auto& collider : world_.colliders) room_.boxes.push_back(collide::bounds_in_step(collider));
        join();
    }
    bool is_restless(std::uint32_t body) { return room_.is_restless[room_.sets.first_of(body)] != 0; }

    void measure_speeds() {
        room_.squared_speed.assign(room_.bodies.size(), Real(0));
        for (Row row = 0; row < p_.size(); ++row) {
            auto& fastest2 = room_.squared_speed[room_.body_of[row]];
            fastest2 = max(fastest2, dot(p_.velocity[row], p_.velocity[row]));
            fastest2 = max(fastest2, dot(p_.spin[row], p_.spin[row]) * square(p_.radius[row]));
        }
    }

  private:
    using BoxT = collide::BoundingBox<D, Real>;
    const World<D, Real>& world_;
    const Particles<D, Real>& p_;
    SleepRoom<D, Real>& room_;
    Real dt_;

    void join() {
        room_.sets.reset(room_.boxes.size());
        const auto& pairs = room_.broadphase.find(room_.boxes, [&](auto i, auto k) { return may_touch(i, k); });
        for (const auto& pair : pairs) room_.sets.join(pair.first, pair.second);
        for (std::uint32_t i = 0; i < room_.boxes.size(); ++i)
            if (room_.is_restless[i]) room_.is_restless[room_.sets.first_of(i)] = 1;
    }

    /// Distance within which bodies are near: the way of the fastest particle in the step, and that of one which just
    /// counts as at rest during the delay.
    Real margin() const {
        Real fastest2 = 0;
        for (const auto speed : room_.squared_speed) fastest2 = max(fastest2, speed);
        for (const auto& pin : world_.pins)
            fastest2 = max(fastest2, dot(pin.target - pin.from, pin.target - pin.from) * inverse_or_zero(square(dt_)));
        Vec<D, Real> gravity{};
        for (const auto& force : world_.forces)
            if (const auto* field = std::get_if<Gravity<D, Real>>(&force)) gravity += field->acceleration;
        const auto& sleep = world_.settings.sleep;
        return square_root(fastest2) * dt_ + norm(gravity) * square(dt_) + sleep.speed * sleep.delay;
    }

    void make_boxes() {
        room_.boxes.assign(room_.bodies.size(), BoxT{});
        for (Row row = 0; row < p_.size(); ++row) include(room_.boxes[room_.body_of[row]], row, p_.position[row]);
        for (const auto& [body, row] : room_.attached) include(room_.boxes[body], row, p_.position[row]);
        for (const auto& pin : world_.pins)
            if (const auto row = p_.handles.find(pin.particle)) room_.boxes[room_.body_of[*row]].include(pin.target);
        const Real half = Real(0.5) * margin();
        for (auto& box : room_.boxes) box = box.grown(half);
        for (const auto& collider : world_.colliders)
            room_.boxes.push_back(collide::bounds_in_step(collider).grown(half));
    }
    void include(BoxT& box, Row row, const Vec<D, Real>& place, Real way = 0) const {
        const auto wide = Vec<D, Real>::map([&](int) { return p_.radius[row] + way; });
        if (!is_finite(place) || !is_finite(wide)) return;
        box.include(place - wide);
        box.include(place + wide);
    }

    /// Immovable bodies and colliders at rest do not connect the bodies that lie on them.
    bool connects(std::uint32_t item) const {
        return room_.is_restless[item] || (item < room_.bodies.size() && room_.bodies[item].is_movable);
    }
    bool may_touch(std::uint32_t i, std::uint32_t k) const {
        const auto count = room_.bodies.size();
        if (i >= count || !connects(i) || !connects(k)) return false;
        if (k >= count) return may_touch(room_.bodies[i], world_.colliders[k - count].filter);
        return may_touch(room_.bodies[i], room_.bodies[k]);
    }
    bool may_touch(const SleepBody& body, const collide::Filter& filter) const {
        if (body.has_several_figures || body.figure >= world_.figures.size()) return true;
        return touch(filter, world_.figures[body.figure].filter);
    }
    bool may_touch(const SleepBody& a, const SleepBody& b) const {
        if (a.has_several_figures || b.has_several_figures) return true;
        if (a.figure >= world_.figures.size() || b.figure >= world_.figures.size()) return false;
        const auto &one = world_.figures[a.figure], &other = world_.figures[b.figure];
        if (a.figure == b.figure) return one.touches_itself;
        return one.collides && other.collides && touch(one.filter, other.filter);
    }
};

} // namespace sinew::detail
