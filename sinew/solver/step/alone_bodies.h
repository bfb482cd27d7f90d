#pragma once

#include "sinew/collide/filter.h"
#include "sinew/solver/direct/eligibility.h"
#include "sinew/solver/step/sleep_bodies.h"

#include <algorithm>

/// Bodies that the direct blocks could move, were it not for contacts.
namespace sinew {

template <int D, class Real> struct AloneRoom {
    SleepRoom<D, Real> all;         ///< all bodies
    std::vector<char> may_be_block; ///< per body
    bool any_may_be_block = false;  ///< otherwise nobody is ever alone
    std::vector<BlockRoom::Part> parts;

    static constexpr std::uint32_t none = ~std::uint32_t(0);
    std::vector<std::uint32_t> bodies;   ///< colliding ones
    std::vector<std::uint32_t> index_of; ///< per body: index in `bodies`
    std::vector<Row> rows;               ///< of colliding bodies, body by body
    std::vector<Row> first_row;          ///< per colliding body, and the end: index in `rows`
    std::vector<Real> cover;             ///< per colliding body: most that a particle of cloth is wider than its radius

    // Scratch of a step, per colliding body.
    std::vector<collide::BoundingBox<D, Real>> boxes;
    std::vector<Real> way; ///< of the fastest particle
    std::vector<char> is_near;
    std::vector<std::uint32_t> order, met; ///< along the axis; found to be near something just now
    int axis = 0;
};

namespace detail {

template <int D, class Real> class AloneBodyFinder {
  public:
    AloneBodyFinder(const World<D, Real>& world, AloneRoom<D, Real>& room)
        : world_(world), p_(world.particles), room_(room) {}

    void run() {
        SleepBodyFinder<D, Real>(world_, room_.all).run();
        take_stock();
        list_colliding();
    }

  private:
    const World<D, Real>& world_;
    const Particles<D, Real>& p_;
    AloneRoom<D, Real>& room_;

    void take_stock() {
        const BlockGraph<D, Real> graph(world_);
        const BlockEligibility<D, Real> eligibility(graph);
        const auto& bodies = room_.all.bodies;
        room_.parts.assign(bodies.size(), {});
        for (const auto body : room_.all.body_of) ++room_.parts[body].particles;
        for_each_table(world_, [&](const auto& table) {
            for (Row row = 0; row < table.size(); ++row) {
                const auto members = table.members[row];
                const auto moving = std::count_if(members.begin(), members.end(), [&](Row m) { return moves(m); });
                const auto first = std::find_if(members.begin(), members.end(), [&](Row m) { return moves(m); });
                if (first == members.end()) continue;
                eligibility.take_stock(room_.parts[room_.all.body_of[*first]], table, row, std::uint32_t(moving));
            }
        });
        room_.may_be_block.assign(bodies.size(), 0);
        for (std::size_t i = 0; i < bodies.size(); ++i)
            room_.may_be_block[i] = is_candidate(bodies[i]) && eligibility.worthwhile(room_.parts[i]);
        room_.any_may_be_block =
            std::find(room_.may_be_block.begin(), room_.may_be_block.end(), 1) != room_.may_be_block.end();
    }
    bool moves(Row row) const { return p_.mobility[row] > Real(0); }

    /// A body that touches itself is never alone.
    bool is_candidate(const SleepBody& body) const {
        if (!body.is_movable || body.has_several_figures || body.figure >= world_.figures.size()) return false;
        const auto& figure = world_.figures[body.figure];
        return figure.collides && !figure.touches_itself && figure.direct != Direct::off;
    }

    bool collides(const SleepBody& body) const {
        if (body.has_several_figures) return true;
        return body.figure < world_.figures.size() && world_.figures[body.figure].collides;
    }
    void list_colliding() {
        room_.bodies.clear(), room_.rows.clear(), room_.first_row.clear();
        room_.index_of.assign(room_.all.bodies.size(), room_.none);
        const auto& body_of = room_.all.body_of;
        std::vector<Row> next(room_.all.bodies.size() + 1, 0);
        for (const auto body : body_of) ++next[body + 1];
        for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
        std::vector<Row> rows(p_.size());
        const auto first = next;
        for (Row row = 0; row < p_.size(); ++row) rows[next[body_of[row]]++] = row;
        for (std::uint32_t i = 0; i < room_.all.bodies.size(); ++i) {
            if (!collides(room_.all.bodies[i])) continue;
            room_.index_of[i] = std::uint32_t(room_.bodies.size());
            room_.bodies.push_back(i);
            room_.first_row.push_back(Row(room_.rows.size()));
            room_.rows.insert(room_.rows.end(), rows.begin() + first[i], rows.begin() + first[i + 1]);
        }
        room_.first_row.push_back(Row(room_.rows.size()));
        measure_covers();
    }
    void measure_covers() {
        constexpr Real share_of_cell = Real(0.75); // cloth_features.h
        room_.cover.assign(room_.bodies.size(), Real(0));
        if (D == 2) return;
        const auto& table = std::get<kind_number<Distance, D>>(world_.constraints);
        for (Row row = 0; row < table.size(); ++row)
            for (const Row member : table.members[row]) {
                const auto body = room_.all.body_of[member];
                if (room_.may_be_block[body] || room_.index_of[body] == room_.none) continue;
                auto& cover = room_.cover[room_.index_of[body]];
                cover = max(cover, share_of_cell * min(table.high(row), limit::coordinate<Real>));
            }
    }
};

} // namespace detail
} // namespace sinew
