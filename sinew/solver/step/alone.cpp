#include "sinew/solver/phases.h"
#include "sinew/solver/step/alone_bodies.h"
#include "sinew/solver/step/body_boxes.h"
#include "sinew/solver/step/hand_over.h"
#include "sinew/solver/step/wall_reach.h"
#include "sinew/world/asleep.h"

#include <algorithm>

/// Bodies far from everything they may touch are alone: direct blocks move them, as if nothing collided. Bodies near
/// something are held by rows of contact. Who is near is state of the world.
namespace sinew {
namespace {

template <int D, class Real> class AloneFinder {
  public:
    using BoxT = collide::BoundingBox<D, Real>;
    using Vector = Vec<D, Real>;

    AloneFinder(World<D, Real>& world, AloneRoom<D, Real>& room, Real dt)
        : world_(world), p_(world.particles), room_(room), dt_(dt) {}

    void run() {
        list();
        const bool may_become_alone = world_.steps % interval == 0 && room_.any_may_be_block;
        if (room_.bodies.empty()) return;
        make_boxes();
        find_near();
        bool any_changes = false;
        for (std::size_t i = 0; i < room_.bodies.size(); ++i) {
            if (!may_be_block(i)) continue;
            const bool was_near = is_near(i);
            if (was_near ? may_become_alone && !room_.is_near[i] && !p_.asleep[first(i)] : room_.is_near[i] != 0)
                set(i, !was_near), any_changes = true;
        }
        if (any_changes) mark_attached();
    }
    /// Lists the bodies of an edited world.
    void list() {
        if (std::exchange(room_.edits, world_.journal.edits) == world_.journal.edits) return;
        detail::AloneBodyFinder<D, Real>(world_, room_).run();
        take_over();
    }
    /// Nothing is near.
    static void clear(World<D, Real>& world) {
        auto& p = world.particles;
        if (!any_near(p)) return;
        p.near.fill(char(0));
        world.journal.change_all();
    }

  private:
    World<D, Real>& world_;
    Particles<D, Real>& p_;
    AloneRoom<D, Real>& room_;
    Real dt_;

    /// Steps from one search for bodies that have become alone to the next: the world is prepared anew for them.
    static constexpr int interval = 16;

    Row first(std::size_t i) const { return room_.rows[room_.first_row[i]]; }
    bool may_be_block(std::size_t i) const { return room_.may_be_block[room_.bodies[i]] != 0; }
    bool collides(std::size_t i) const { return room_.collides[room_.bodies[i]] != 0; }
    bool collides(Row row) const {
        return has_figure(world_, p_.figure[row]) && world_.figures[p_.figure[row]].collides;
    }
    bool is_near(std::size_t i) const { return p_.near[first(i)] != 0; }
    std::span<const Row> rows_of(std::size_t i) const {
        return std::span(room_.rows).subspan(room_.first_row[i], size(i));
    }

    /// After an edit: a body joined from one that is near and one that is not is near. Of bodies that no block could
    /// solve, the particles that collide always are; and rods are where there are walls, which their links lie on.
    void take_over() {
        for (Row row = 0; row < p_.size(); ++row)
            if (const auto at = room_.index_of[room_.all.body_of[row]]; at == none || !may_be_block(at))
                mark(row, collides(row) || (room_.is_rod[room_.all.body_of[row]] && has_walls(world_)));
        for (std::size_t i = 0; i < room_.bodies.size(); ++i) {
            if (!may_be_block(i)) continue;
            const auto count = std::ranges::count_if(rows_of(i), [&](Row row) { return p_.near[row] != 0; });
            if (count > 0 && std::size_t(count) < size(i)) set(i, true);
        }
        mark_attached();
    }
    void set(std::size_t i, bool near) {
        if (world_.last_substep > Real(0)) detail::hand_over(world_, rows_of(i), near, is_held(i));
        for (const Row row : rows_of(i)) p_.near.set(row, char(near));
        world_.journal.touch(p_.handles.index_of(first(i)), Touch::joined);
    }
    /// True for a body that a pin or something immovable holds: other forces accelerate it, too.
    bool is_held(std::size_t i) const {
        const auto body = room_.bodies[i];
        return std::ranges::any_of(room_.all.attached, [&](const auto& end) { return end.body == body; }) ||
               std::ranges::any_of(world_.pins, [&](const auto& pin) {
                   const auto row = p_.handles.find(pin.particle);
                   return row && room_.all.body_of[*row] == body;
               });
    }
    void mark(Row row, bool near) {
        if ((p_.near[row] != 0) == near) return;
        p_.near.set(row, char(near));
        world_.journal.touch(p_.handles.index_of(row), Touch::joined);
    }
    /// An immovable particle is near with any body that hangs on it.
    void mark_attached() {
        for (const auto& end : room_.all.attached) mark(end.row, collides(end.row));
        for (const auto& end : room_.all.attached)
            if (const auto at = room_.index_of[end.body]; at != none && is_near(at)) mark(end.row, true);
    }

    // --- boxes -------------------------------------------------------------------------------------------------------

    /// The way of a step at present velocities, half as much again for turning figures, the fall, and half a radius.
    void make_boxes() {
        const detail::BodyBoxes<D, Real> boxes(p_, dt_);
        fall_ = norm(gravity()) * square(dt_);
        room_.boxes.clear(), room_.way.clear();
        room_.is_pulled.assign(room_.bodies.size(), 0);
        for (std::size_t i = 0; i < room_.bodies.size(); ++i) {
            auto moving = boxes.of(std::span(room_.rows).subspan(room_.first_row[i], size(i)));
            if (body(i).is_movable) {
                const auto turn = (moving.fastest - moving.slowest) * (Real(0.5) * dt_);
                const Real margin = fall_ + Real(0.5) * moving.widest + room_.cover[i];
                moving.box = BoxT{moving.box.low - turn, moving.box.high + turn}.grown(margin);
            }
            room_.boxes.push_back(moving.box);
            room_.way.push_back(way_of(moving));
        }
        include_pins();
        find_buried();
    }
    /// Bodies that meet walls alone, and hang on a particle behind one: no row could hold them in front, and a block
    /// gives way.
    void find_buried() {
        room_.is_buried.assign(room_.bodies.size(), 0);
        for (const auto& end : room_.all.attached) {
            const auto at = room_.index_of[end.body];
            if (at != none && !collides(at) && detail::is_behind_walls(world_, end.row)) room_.is_buried[at] = 1;
        }
    }
    Real way_of(const detail::BodyBox<D, Real>& body) const {
        Real fastest = 0;
        for (int k = 0; k < D; ++k) fastest = max(fastest, max(absolute(body.slowest[k]), absolute(body.fastest[k])));
        return min(fastest, limit::speed<Real>) * dt_;
    }
    Real max_way_ = 0; ///< way in a step of the fastest that may be struck
    Real fall_ = 0;    ///< in a step, m

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
                room_.is_pulled[at] = 1;
            }
    }
    static constexpr auto none = AloneRoom<D, Real>::none;

    // --- neighbours --------------------------------------------------------------------------------------------------

    void find_near() {
        room_.is_near.assign(room_.bodies.size(), 0);
        room_.meets.assign(room_.bodies.size(), 0);
        room_.met.clear();
        max_way_ = 0;
        for (std::uint32_t i = 0; i < room_.bodies.size(); ++i) {
            if (!body(i).is_movable) continue;
            room_.meets[i] = is_near_walls(i) || touches_itself(i);
            if (!may_be_block(i) || room_.meets[i]) note_near(i);
        }
        const int axis = widest_axis();
        do {
            grow_those_met();
            sort_along(axis);
            meet_neighbours();
        } while (!room_.met.empty());
    }
    void note_near(std::uint32_t i) {
        if (!std::exchange(room_.is_near[i], char(1)) && body(i).is_movable && collides(i)) room_.met.push_back(i);
    }
    bool touches_itself(std::size_t i) const {
        return has_figure(world_, body(i).figure) && world_.figures[body(i).figure].touches_itself;
    }
    bool is_near_walls(std::size_t i) const {
        if (collides(i) && body(i).has_several_figures) return true;
        if (room_.is_buried[i]) return false;
        return detail::WallReach<D, Real>(world_, rows_of(i), room_.boxes[i], dt_)
            .any({.fall = fall_, .link = room_.reach[i], .is_pulled = room_.is_pulled[i] != 0});
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
        const bool is_anew = order.size() != room_.colliding.size() || room_.axis != axis;
        if (is_anew) order = room_.colliding, room_.axis = axis;
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

    /// Marks the bodies that overlap, and lists who did not until now.
    void meet_neighbours() {
        const auto& order = room_.order;
        for (std::size_t i = 0; i < order.size(); ++i) {
            const auto& box = room_.boxes[order[i]];
            for (auto k = i + 1; k < order.size() && low(order[k], room_.axis) <= box.high[room_.axis]; ++k)
                if (box.overlaps(room_.boxes[order[k]])) meet(order[i], order[k]);
        }
    }
    void meet(std::uint32_t i, std::uint32_t k) {
        if ((room_.meets[i] && room_.meets[k]) || !may_touch(body(i), body(k))) return;
        room_.meets[i] = room_.meets[k] = 1;
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

/// There may be contacts.
template <int D, class Real> bool may_touch(const World<D, Real>& world) {
    return world.settings.mode == Mode::physical &&
           (has_walls(world) || std::ranges::any_of(world.figures, [](const Figure& figure) {
                return figure.in_use() && figure.collides;
            }));
}

template <int D, class Real> AloneRoom<D, Real>& alone_room(Solver<D, Real>& solver) {
    if (!solver.alone) solver.alone = std::make_shared<AloneRoom<D, Real>>();
    return *solver.alone;
}

} // namespace

template <int D, class Real> void find_alone(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    if (!may_touch(world)) return AloneFinder<D, Real>::clear(world);
    AloneFinder<D, Real>(world, alone_room(solver), dt).run();
}

template <int D, class Real> bool meets_others(const Solver<D, Real>& solver, Row row) {
    const auto& room = *solver.alone;
    const auto at = room.index_of[room.all.body_of[row]];
    return at == room.none || room.meets[at] != 0;
}

template <int D, class Real> void list_bodies(World<D, Real>& world, Solver<D, Real>& solver) {
    if (!may_touch(world)) return;
    AloneFinder<D, Real>(world, alone_room(solver), Real(0)).list();
}

#define SINEW_ALONE(D, Real)                                                                                           \
    template void find_alone(World<D, Real>&, Solver<D, Real>&, Real);                                                 \
    template void list_bodies(World<D, Real>&, Solver<D, Real>&);                                                      \
    template bool meets_others(const Solver<D, Real>&, Row);
SINEW_INSTANTIATE(SINEW_ALONE)

} // namespace sinew
