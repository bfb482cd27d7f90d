#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>

/// Connected components of the world under simple distances. Each becomes a component of the plan, or shares one with
/// others of the same shape.
namespace sinew::detail {

template <int D, class Real> class ComponentFinder {
  public:
    static constexpr Row none = ~Row(0);
    using Links = std::span<const Row>;

    ComponentFinder(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), solver_(solver), distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          swept_(solver.sweep_state), plan_(solver.sweep_state.plan), room_(solver.sweep_state.room) {}

    /// Finds the components of the swept particles outside kept components. A link to a kept component is reported by
    /// meet(slot) of a particle there instead, and the result is false.
    template <class Meet> bool find(Meet&& meet) {
        if (!take_plain(meet)) return false;
        join();
        sort_into_parts();
        return true;
    }
    /// Releases the adjacency lists.
    void forget_neighbours() { give_back(room_.near, room_.levels); }
    /// Releases all room of the planner.
    void forget() {
        give_back(room_.link_at, room_.left, room_.sets, room_.part_of, room_.members, room_.rank, room_.at, room_.near,
                  room_.chained, room_.colour, room_.used, room_.sorted, room_.left_over, room_.of_tile,
                  room_.left_of_tile, room_.sequences, room_.levels);
    }
    bool any() const {
        bool any = false;
        each_swept([&](Row) { any = true; });
        return any;
    }
    std::size_t size() const { return room_.members.size(); }

    std::span<const Row> members(std::size_t part) const { return room_.members[part]; }
    Links links(std::size_t part) const { return room_.link_at[part]; }
    Row rank(Row link, std::size_t i) const { return room_.rank[end(link, i)]; }
    Row end(Row link, std::size_t i) const { return distances_.members.rows[link][i]; }

    /// Number of consecutive parts, from this one on, of the same shape.
    std::size_t count_alike(std::size_t part) const {
        std::size_t count = 1;
        while (part + count < size() && are_alike(part, part + count)) ++count;
        return count;
    }

    void list_neighbours(std::size_t part) const {
        room_.near.fill(members(part).size(), [&](auto&& visit) {
            for (const Row link : links(part))
                for (std::size_t i = 0; i < 2; ++i) visit(rank(link, i), rank(link, 1 - i));
        });
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    const Constraints<Distance<D>, Real>& distances_;
    SweepState<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;

    std::size_t particles() const { return world_.particles.size(); }

    /// Releases columns in a large world. A small world keeps the room, because a tear calls for a new plan.
    template <class... Column> void give_back(Column&... columns) const {
        constexpr std::size_t small = 100'000;
        if (distances_.size() > small) ((columns = Column()), ...);
    }

    /// Visits the swept particles outside kept components.
    template <class Visit> void each_swept(Visit&& visit) const {
        const auto& in_block = world_.particles.at_end;
        for (Row row = 0; row < in_block.size(); ++row)
            if (!in_block[row] && swept_.slot_of[row] == none) visit(row);
    }

    /// True for a distance with default split and relaxation, without damping, drive or maximum force. Limits outside
    /// the range of coordinates are left out: products of three of them would overflow.
    bool is_plain(Row link) const {
        constexpr Real far = limit::coordinate<Real>;
        return distances_.split[link] == Real(0.5) && distances_.relaxation[link] == Real(1) &&
               !distances_.gives(link) && distances_.damping_time[link] == Real(0) && !distances_.motorized[link] &&
               distances_.low(link) <= far && distances_.high(link) >= Real(0);
    }

    bool is_at_port(int kind, Row row) const {
        const auto& ports = solver_.blocks.ports;
        bool found = false;
        if (ports.list.empty()) return found;
        visit_table(world_, kind, [&](const auto& table) {
            for (const Row member : table.members[row]) found = found || ports.at[member] != ports.none;
        });
        return found;
    }

    template <class Meet> bool take_plain(Meet&& meet) {
        bool is_separate = true;
        room_.links.clear();
        plan_.others.clear();
        for (const auto& run : solver_.blocks.runs) {
            const bool distances = run.kind == kind_number<Distance, D>;
            for (Row row = run.rows.first; row < run.rows.last; ++row) {
                if (distances && is_plain(row)) {
                    const Row a = swept_.slot_of[end(row, 0)], b = swept_.slot_of[end(row, 1)];
                    if (a != none && b != none) continue;
                    room_.links.push_back(row);
                    if (a == none && b == none) continue;
                    meet(std::min(a, b));
                    is_separate = false;
                    continue;
                }
                if (is_at_port(run.kind, row)) continue;
                auto* last = plan_.others.empty() ? nullptr : &plan_.others.back();
                if (!last || last->kind != run.kind || last->rows.last != row)
                    plan_.others.push_back({run.kind, {row, row}});
                plan_.others.back().rows.last = row + 1;
            }
        }
        return is_separate;
    }

    void join() {
        room_.sets.make_room(particles());
        each_swept([&](Row row) { room_.sets.separate(row); });
        for (const Row link : room_.links) room_.sets.join(end(link, 0), end(link, 1));
    }

    /// Sorts particles and links by component, each in row order, and components by the first particle. Particles
    /// without links share one component.
    void sort_into_parts() {
        const auto parts = number_parts();
        room_.members.fill(parts, [&](auto&& visit) { each_swept([&](Row row) { visit(room_.part_of[row], row); }); });
        room_.link_at.fill(parts, [&](auto&& visit) {
            for (const Row link : room_.links) visit(room_.part_of[end(link, 0)], link);
        });
        room_.rank.resize(particles());
        for (std::size_t part = 0; part < parts; ++part) {
            const auto all = members(part);
            for (Row i = 0; i < all.size(); ++i) room_.rank[all[i]] = i;
        }
        give_back(room_.links);
    }
    /// Numbers the components in `part_of`, and returns how many there are.
    Row number_parts() {
        room_.part_of.resize(particles());
        each_swept([&](Row row) { room_.part_of[row] = none; });
        for (const Row link : room_.links) room_.part_of[end(link, 0)] = room_.part_of[end(link, 1)] = 0;
        Row parts = 0;
        bool any_alone = false;
        each_swept([&](Row row) {
            const bool is_alone = room_.part_of[row] == none;
            any_alone = any_alone || is_alone;
            if (is_alone) return;
            const Row first = room_.sets.first_of(row);
            room_.part_of[row] = first == row ? parts++ : room_.part_of[first];
        });
        each_swept([&](Row row) {
            if (room_.part_of[row] == none) room_.part_of[row] = parts;
        });
        return parts + Row(any_alone);
    }

    bool are_alike(std::size_t a, std::size_t b) const {
        const auto first = links(a), second = links(b);
        if (first.empty() || first.size() != second.size() || members(a).size() != members(b).size()) return false;
        for (std::size_t i = 0; i < first.size(); ++i)
            if (rank(first[i], 0) != rank(second[i], 0) || rank(first[i], 1) != rank(second[i], 1)) return false;
        return true;
    }
};

} // namespace sinew::detail
