#include "sinew/collide/collider.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/step/alone_bodies.h"
#include "sinew/solver/step/body_boxes.h"
#include "sinew/world/asleep.h"

#include <algorithm>
#include <numeric>

/// Bodies far from everything they may touch: direct blocks move them, as if figures did not collide. Who is alone is
/// state of the world.
namespace sinew {
namespace {

template <int D, class Real> class AloneFinder {
  public:
    using BoxT = collide::BoundingBox<D, Real>;
    using Vector = Vec<D, Real>;

    AloneFinder(World<D, Real>& world, AloneRoom<D, Real>& room, Real dt)
        : world_(world), p_(world.particles), room_(room), dt_(dt) {}

    void run() {
        if (world_.journal.changed || world_.journal.stale || room_.all.body_of.size() != p_.size()) {
            detail::AloneBodyFinder<D, Real>(world_, room_).run();
            part_mixed();
        }
        const bool may_become_alone = world_.steps % interval == 0 && room_.any_may_be_block;
        if (!may_become_alone && !any_alone(p_)) return;
        make_boxes();
        find_near();
        for (std::size_t i = 0; i < room_.bodies.size(); ++i) {
            const bool is_alone = p_.alone[first(i)] != 0;
            if (is_alone ? !may_stay_alone(i) : (may_become_alone && may_stay_alone(i) && !p_.asleep[first(i)]))
                set(i, !is_alone);
        }
    }

  private:
    World<D, Real>& world_;
    Particles<D, Real>& p_;
    AloneRoom<D, Real>& room_;
    Real dt_;

    /// Steps from one search for bodies that have become alone to the next: the world is prepared anew for them.
    static constexpr int interval = 16;

    Row first(std::size_t i) const { return room_.rows[room_.first_row[i]]; }
    bool may_stay_alone(std::size_t i) const { return room_.may_be_block[room_.bodies[i]] && !room_.is_near[i]; }
    /// A body joined from one that is alone and one that is not is not.
    void part_mixed() {
        if (!any_alone(p_)) return;
        for (std::size_t i = 0; i < room_.bodies.size(); ++i) {
            const auto rows = std::span(room_.rows).subspan(room_.first_row[i], size(i));
            if (std::any_of(rows.begin(), rows.end(), [&](Row row) { return p_.alone[row] != p_.alone[rows[0]]; }))
                set(i, false);
        }
    }
    void set(std::size_t i, bool is_alone) {
        for (Row k = room_.first_row[i]; k < room_.first_row[i + 1]; ++k) p_.alone.set(room_.rows[k], char(is_alone));
        world_.journal.touch(p_.handles.index_of(first(i)), Touch::joined);
    }

    // --- boxes -------------------------------------------------------------------------------------------------------

    /// The way of a step at present velocities, half as much again for what turns, the fall, and half a radius.
    void make_boxes() {
        const detail::BodyBoxes<D, Real> boxes(p_, dt_);
        const Real fall = norm(gravity()) * square(dt_);
        room_.boxes.clear(), room_.way.clear();
        for (std::size_t i = 0; i < room_.bodies.size(); ++i) {
            auto moving = boxes.of(std::span(room_.rows).subspan(room_.first_row[i], size(i)));
            if (body(i).is_movable) {
                const auto turn = (moving.fastest - moving.slowest) * (Real(0.5) * dt_);
                const Real margin = fall + Real(0.5) * moving.widest + room_.cover[i];
                moving.box = BoxT{moving.box.low - turn, moving.box.high + turn}.grown(margin);
            }
            room_.boxes.push_back(moving.box);
            room_.way.push_back(way_of(moving));
        }
        include_pins();
    }
    Real way_of(const detail::BodyBox<D, Real>& body) const {
        Real fastest = 0;
        for (int k = 0; k < D; ++k) fastest = max(fastest, max(absolute(body.slowest[k]), absolute(body.fastest[k])));
        return min(fastest, limit::speed<Real>) * dt_;
    }
    Real max_way_ = 0; ///< way in a step of the fastest that may be struck

    std::size_t size(std::size_t i) const { return room_.first_row[i + 1] - room_.first_row[i]; }
    Vector gravity() const {
        Vector sum{};
        for (const auto& force : world_.forces)
            if (const auto* field = std::get_if<Gravity<D, Real>>(&force)) sum += field->acceleration;
        return sum;
    }
    /// Pins may carry a particle along.
    void include_pins() {
        for (const auto& pin : world_.pins)
            if (const auto row = p_.handles.find(pin.particle)) {
                const auto at = room_.index_of[room_.all.body_of[*row]];
                if (at == none || pin.from == pin.target) continue;
                const auto wide = Vector::map([&](int) { return p_.radius[*row]; });
                room_.boxes[at].include(pin.target - wide);
                room_.boxes[at].include(pin.target + wide);
            }
    }
    static constexpr auto none = AloneRoom<D, Real>::none;

    // --- neighbours --------------------------------------------------------------------------------------------------

    void find_near() {
        room_.is_near.assign(room_.bodies.size(), 0);
        room_.met.clear();
        max_way_ = 0;
        for (std::uint32_t i = 0; i < room_.bodies.size(); ++i)
            if (body(i).is_movable && (!room_.may_be_block[room_.bodies[i]] || is_near_walls(i))) note_near(i);
        const int axis = widest_axis();
        do {
            grow_those_met();
            sort_along(axis);
            meet_neighbours();
        } while (!room_.met.empty());
    }
    void note_near(std::uint32_t i) {
        if (!std::exchange(room_.is_near[i], char(1)) && body(i).is_movable) room_.met.push_back(i);
    }
    bool is_near_walls(std::size_t i) const {
        const auto& box = room_.boxes[i];
        for (const auto& plane : world_.bounds) {
            const auto deepest =
                Vector::map([&](int k) { return plane.normal[k] > Real(0) ? box.low[k] : box.high[k]; });
            if (dot(plane.normal, deepest) <= plane.offset) return true;
        }
        if (body(i).has_several_figures) return true;
        const auto& filter = world_.figures[body(i).figure].filter;
        return std::any_of(world_.colliders.begin(), world_.colliders.end(), [&](const auto& collider) {
            return touch(filter, collider.filter) && collide::bounds_in_step(collider).overlaps(box);
        });
    }
    const SleepBody& body(std::size_t i) const { return room_.all.bodies[room_.bodies[i]]; }

    int widest_axis() const {
        BoxT all;
        for (const auto& box : room_.boxes) all.include(box.low);
        int widest = 0;
        for (int k = 1; k < D; ++k)
            if (all.high[k] - all.low[k] > all.high[widest] - all.low[widest]) widest = k;
        return widest;
    }
    /// The order of the last step needs few exchanges. What is found depends on no order.
    void sort_along(int axis) {
        auto& order = room_.order;
        const bool is_anew = order.size() != room_.bodies.size() || room_.axis != axis;
        if (is_anew) {
            order.resize(room_.bodies.size());
            std::iota(order.begin(), order.end(), 0U);
            room_.axis = axis;
        }
        if (is_anew || !insert_in_order())
            std::sort(order.begin(), order.end(), [&](auto i, auto k) { return low(i, axis) < low(k, axis); });
    }
    /// False if there were many exchanges.
    bool insert_in_order() {
        auto& order = room_.order;
        const auto max = 4 * order.size();
        std::size_t exchanges = 0;
        for (std::size_t i = 1; i < order.size() && exchanges < max; ++i)
            for (auto k = i; k > 0 && low(order[k], room_.axis) < low(order[k - 1], room_.axis); --k, ++exchanges)
                std::swap(order[k], order[k - 1]);
        return exchanges < max;
    }
    Real low(std::uint32_t i, int axis) const { return room_.boxes[i].low[axis]; }

    /// Marks what overlaps, and lists who did not until now.
    void meet_neighbours() {
        const auto& order = room_.order;
        for (std::size_t i = 0; i < order.size(); ++i) {
            const auto& box = room_.boxes[order[i]];
            for (auto k = i + 1; k < order.size() && low(order[k], room_.axis) <= box.high[room_.axis]; ++k)
                if (box.overlaps(room_.boxes[order[k]])) meet(order[i], order[k]);
        }
    }
    void meet(std::uint32_t i, std::uint32_t k) {
        if ((room_.is_near[i] && room_.is_near[k]) || !may_touch(body(i), body(k))) return;
        note_near(i), note_near(k);
    }
    bool may_touch(const SleepBody& a, const SleepBody& b) const {
        if (a.has_several_figures || b.has_several_figures) return true;
        return a.figure != b.figure && touch(world_.figures[a.figure].filter, world_.figures[b.figure].filter);
    }
    /// A body that has met another may fly off in any direction within the step.
    void grow_those_met() {
        for (const auto i : room_.met) max_way_ = max(max_way_, room_.way[i]);
        for (const auto i : room_.met) room_.boxes[i] = room_.boxes[i].grown(max_way_);
        room_.met.clear();
    }
};

/// Some figure that collides may be solved directly.
template <int D, class Real> bool may_be_alone(const World<D, Real>& world) {
    return world.settings.mode == Mode::physical &&
           std::any_of(world.figures.begin(), world.figures.end(),
                       [](const Figure& figure) { return figure.in_use() && figure.collides; });
}

} // namespace

template <int D, class Real> void find_alone(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    if (!may_be_alone(world)) return;
    if (!solver.alone) solver.alone = std::make_shared<AloneRoom<D, Real>>();
    AloneFinder<D, Real>(world, *solver.alone, dt).run();
}

#define SINEW_ALONE(D, Real) template void find_alone(World<D, Real>&, Solver<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_ALONE)

} // namespace sinew
