#pragma once

#include "sinew/collide/broadphase.h"
#include "sinew/math/union_find.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>

/// Bodies: sets of movable particles connected by constraints, which fall asleep and wake as one, and sets of immovable
/// ones, which a pin may carry.
namespace sinew {

struct SleepBody {
    Row first = 0;                    ///< lowest row; carries the body's time at rest
    FigureIndex figure = no_figure;   ///< of all particles; meaningless if there are several
    bool has_several_figures = false; ///< may touch everything
    bool is_movable = false;
    bool is_motorized = false; ///< a limit moves: never at rest
};

template <int D, class Real> struct SleepRoom {
    std::vector<SleepBody> bodies;
    std::vector<std::uint32_t> body_of; ///< per row
    std::uint64_t edits = ~0ull;        ///< of the world when the bodies were found
    struct Attachment {
        std::uint32_t body = 0;
        Row row = 0;
    };
    std::vector<Attachment> attached; ///< immovable particles in constraints of movable bodies
    UnionFind sets;

    // Scratch of a step; colliders count as items after the bodies.
    std::vector<collide::BoundingBox<D, Real>> boxes;
    std::vector<char> is_restless;      ///< per item
    std::vector<Real> squared_speed;    ///< per body: of the fastest particle
    std::vector<Vec<D, Real>> momentum; ///< per body: at the start of the step, then its change
    std::vector<Vec<D, Real>> weight;   ///< per body: sum of the forces on it, at the end of the step
    std::vector<char> is_carried;       ///< per row: by a pin that moves
    collide::Broadphase<D, Real> broadphase;

    /// Room for `count` bodies.
    void reserve(const World<D, Real>& world, std::size_t count) {
        const auto particles = world.particles.size(), colliders = world.colliders.size();
        std::size_t members = 0;
        for_each_table(world, [&](const auto& table) {
            for (Row row = 0; row < table.size(); ++row) members += table.members[row].size();
        });
        attached.reserve(members);
        bodies.reserve(count), body_of.reserve(particles), squared_speed.reserve(count);
        boxes.reserve(count + colliders), is_restless.reserve(count + colliders);
        is_carried.reserve(particles);
        sets.reserve(std::max(particles, count + colliders));
        broadphase.reserve(count + colliders);
    }
};

namespace detail {

template <int D, class Real> class SleepBodyFinder {
  public:
    SleepBodyFinder(const World<D, Real>& world, SleepRoom<D, Real>& room)
        : world_(world), p_(world.particles), room_(room) {}

    void run() {
        room_.sets.reset(p_.size());
        each_constraint([&](const auto&, Row, std::span<const Row> members) { join(members); });
        number_bodies();
        room_.attached.clear();
        each_constraint([&](const auto& table, Row row, std::span<const Row> members) {
            attach(members);
            if (table.motorized[row] && table.motor_speed[row] != Real(0))
                for (const Row member : members) room_.bodies[room_.body_of[member]].is_motorized = true;
        });
    }

  private:
    const World<D, Real>& world_;
    const Particles<D, Real>& p_;
    SleepRoom<D, Real>& room_;

    bool is_movable(Row row) const { return p_.mobility[row] > Real(0); }
    template <class Visit> void each_constraint(Visit&& visit) const {
        for_each_table(world_, [&](const auto& table) {
            for (Row row = 0; row < table.size(); ++row) visit(table, row, std::span<const Row>(table.members[row]));
        });
    }
    /// Joins the movable members, and the immovable ones.
    void join(std::span<const Row> members) {
        for (const bool movable : {true, false}) {
            const auto of_kind = [&](Row row) { return is_movable(row) == movable; };
            const auto first = std::ranges::find_if(members, of_kind);
            for (auto it = first; it != members.end(); ++it)
                if (of_kind(*it)) room_.sets.join(*first, *it);
        }
    }
    void number_bodies() {
        room_.bodies.clear();
        room_.body_of.resize(p_.size());
        for (Row row = 0; row < p_.size(); ++row) {
            const Row first = room_.sets.first_of(row);
            if (first == row) {
                room_.body_of[row] = std::uint32_t(room_.bodies.size());
                room_.bodies.push_back({.first = row, .figure = p_.figure[row], .is_movable = is_movable(row)});
            }
            const auto number = room_.body_of[row] = room_.body_of[first];
            if (p_.figure[row] != room_.bodies[number].figure) room_.bodies[number].has_several_figures = true;
        }
    }
    void attach(std::span<const Row> members) {
        const auto movable = std::ranges::find_if(members, [&](Row row) { return is_movable(row); });
        if (movable == members.end()) return;
        for (const Row row : members)
            if (!is_movable(row)) room_.attached.push_back({room_.body_of[*movable], row});
    }
};

} // namespace detail
} // namespace sinew
