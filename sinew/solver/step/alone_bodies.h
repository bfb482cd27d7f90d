#pragma once

#include "sinew/collide/filter.h"
#include "sinew/solver/contact/rigid_links.h"
#include "sinew/solver/direct/eligibility.h"
#include "sinew/solver/step/sleep_bodies.h"

#include <algorithm>
#include <limits>

/// Bodies that the direct blocks could move, were it not for contacts.
namespace sinew {

template <int D, class Real> struct AloneRoom {
    SleepRoom<D, Real> all;      ///< all bodies
    std::uint64_t edits = ~0ull; ///< of the world when the bodies were found
    std::vector<char> collides;  ///< per body: touches other figures
    std::vector<char> is_rod;    ///< per body: a single rigid link, too short for a block
    std::vector<char> is_plain;  ///< per body: of rigid links alone and like masses, which rows of contact hold exactly
    std::vector<std::array<Real, 2>> mobilities; ///< per body: least and most, 1/kg
    std::vector<char> may_be_block;              ///< per body
    bool any_may_be_block = false;               ///< otherwise nobody is ever alone
    std::vector<BlockRoom::Part> parts;

    static constexpr std::uint32_t none = ~std::uint32_t(0);
    std::vector<std::uint32_t> bodies;    ///< that collide, or are plain and may meet walls
    std::vector<std::uint32_t> index_of;  ///< per body: index in `bodies`
    std::vector<std::uint32_t> colliding; ///< indices in `bodies`
    std::vector<Row> rows;                ///< of listed bodies, body by body
    std::vector<Row> first_row;           ///< per listed body, and the end: index in `rows`
    std::vector<Real> cover;              ///< per listed body: most that a particle of cloth is wider than its radius
    std::vector<Real> reach;              ///< per listed body: half of the longest link

    std::vector<Row> sorted, end; ///< scratch: rows by bodies; per body, where the one before it ends

    // Scratch of a step, per listed body.
    std::vector<collide::BoundingBox<D, Real>> boxes;
    std::vector<Real> way;                           ///< of the fastest particle
    std::vector<char> is_near, is_pulled, is_buried; ///< is_pulled: by a pin; is_buried: held behind a wall
    std::vector<char> meets;                         ///< may touch something in this step
    std::vector<std::uint32_t> order, met;           ///< along the axis; found to be near something just now
    int axis = 0;
};

namespace detail {

template <int D, class Real> class AloneBodyFinder {
  public:
    AloneBodyFinder(const World<D, Real>& world, AloneRoom<D, Real>& room)
        : world_(world), p_(world.particles), room_(room) {}

    void run() {
        SleepBodyFinder<D, Real>(world_, room_.all).run();
        reserve();
        note_figures();
        take_stock();
        list();
    }

  private:
    const World<D, Real>& world_;
    const Particles<D, Real>& p_;
    AloneRoom<D, Real>& room_;

    /// As many bodies as there are particles, where constraints may tear: a tear must not make a step allocate.
    void reserve() {
        bool may_tear = false;
        std::size_t constraints = 0;
        for_each_table(world_, [&](const auto& table) {
            may_tear = may_tear || table.may_tear();
            constraints += table.size();
        });
        if (may_tear) room_.all.attached.reserve(2 * constraints);
        const auto count = may_tear ? p_.size() : room_.all.bodies.size();
        for (auto* flags : {&room_.collides, &room_.is_rod, &room_.is_plain, &room_.may_be_block, &room_.is_near,
                            &room_.is_pulled, &room_.is_buried, &room_.meets})
            flags->reserve(count);
        for (auto* numbers : {&room_.bodies, &room_.index_of, &room_.colliding, &room_.order, &room_.met})
            numbers->reserve(count);
        for (auto* reals : {&room_.cover, &room_.reach, &room_.way}) reals->reserve(count);
        room_.mobilities.reserve(count), room_.all.bodies.reserve(count), room_.parts.reserve(count),
            room_.boxes.reserve(count);
        room_.end.reserve(count + 2), room_.first_row.reserve(count + 1), room_.rows.reserve(p_.size());
    }
    void note_figures() {
        const auto count = room_.all.bodies.size();
        room_.collides.assign(count, 0), room_.is_plain.assign(count, 1);
        room_.mobilities.assign(count, {std::numeric_limits<Real>::max(), Real(0)});
        for (Row row = 0; row < p_.size(); ++row) {
            const auto body = room_.all.body_of[row];
            const auto index = p_.figure[row];
            if (index >= world_.figures.size()) {
                room_.is_plain[body] = 0;
                continue;
            }
            const auto& figure = world_.figures[index];
            room_.collides[body] |= figure.collides;
            room_.is_plain[body] &= figure.direct == Direct::automatic;
            if (!moves(row)) continue;
            auto& [least, most] = room_.mobilities[body];
            least = min(least, p_.mobility[row]), most = max(most, p_.mobility[row]);
        }
        constexpr Real ratio = Real(1e4); // rows with links held keep lengths up to 5e4 (docs/measured/contact.md)
        for (std::size_t i = 0; i < count; ++i)
            room_.is_plain[i] &= room_.mobilities[i][1] <= ratio * room_.mobilities[i][0];
    }
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
                const auto body = room_.all.body_of[*first];
                eligibility.take_stock(room_.parts[body], table, row, std::uint32_t(moving));
                room_.is_plain[body] &= is_plain_link(table, row);
            }
        });
        room_.may_be_block.assign(bodies.size(), 0);
        for (std::size_t i = 0; i < bodies.size(); ++i)
            room_.may_be_block[i] = is_candidate(i) && eligibility.worthwhile(room_.parts[i]);
        room_.is_rod.assign(bodies.size(), 0);
        for (std::size_t i = 0; i < bodies.size(); ++i)
            room_.is_rod[i] = bodies[i].is_movable && room_.is_plain[i] && !room_.may_be_block[i] &&
                              room_.parts[i].particles == 2 && room_.parts[i].links == 1;
        room_.any_may_be_block =
            std::find(room_.may_be_block.begin(), room_.may_be_block.end(), 1) != room_.may_be_block.end();
    }
    bool moves(Row row) const { return p_.mobility[row] > Real(0); }

    /// Rows of contact go with exact links; limits of joints would be softer than in a block.
    template <class Table> static bool is_plain_link(const Table& table, Row row) {
        if constexpr (std::is_same_v<typename Table::Kind, Distance<D>>)
            return is_link(table, row);
        else
            return false;
    }

    /// A body that touches itself is never alone.
    bool is_candidate(std::size_t i) const {
        const auto& body = room_.all.bodies[i];
        if (!body.is_movable) return false;
        if (!room_.collides[i]) return room_.is_plain[i] != 0;
        if (body.has_several_figures) return false;
        const auto& figure = world_.figures[body.figure];
        return !figure.touches_itself && figure.direct != Direct::off;
    }

    void list() {
        room_.bodies.clear(), room_.colliding.clear(), room_.order.clear(), room_.rows.clear(), room_.first_row.clear();
        room_.index_of.assign(room_.all.bodies.size(), room_.none);
        sort_by_body();
        for (std::uint32_t i = 0; i < room_.all.bodies.size(); ++i) {
            if (!room_.collides[i] && !room_.may_be_block[i]) continue;
            room_.index_of[i] = std::uint32_t(room_.bodies.size());
            if (room_.collides[i]) room_.colliding.push_back(room_.index_of[i]);
            room_.bodies.push_back(i);
            room_.first_row.push_back(Row(room_.rows.size()));
            const auto sorted = room_.sorted.begin();
            room_.rows.insert(room_.rows.end(), sorted + room_.end[i], sorted + room_.end[i + 1]);
        }
        room_.first_row.push_back(Row(room_.rows.size()));
        measure_links();
    }
    /// Rows by bodies, and where each body ends.
    void sort_by_body() {
        const auto& body_of = room_.all.body_of;
        auto& end = room_.end;
        end.assign(room_.all.bodies.size() + 2, 0);
        for (const auto body : body_of) ++end[body + 2];
        for (std::size_t i = 2; i < end.size(); ++i) end[i] += end[i - 1];
        room_.sorted.resize(p_.size());
        for (Row row = 0; row < p_.size(); ++row) room_.sorted[end[body_of[row] + 1]++] = row;
    }
    void measure_links() {
        constexpr Real share_of_cell = Real(0.75); // cloth_features.h
        room_.cover.assign(room_.bodies.size(), Real(0));
        room_.reach.assign(room_.bodies.size(), Real(0));
        const auto& table = std::get<kind_number<Distance, D>>(world_.constraints);
        for (Row row = 0; row < table.size(); ++row)
            for (const Row member : table.members[row]) {
                const auto body = room_.all.body_of[member];
                const auto at = room_.index_of[body];
                if (at == room_.none) continue;
                const Real length = min(table.high(row), limit::coordinate<Real>);
                room_.reach[at] = max(room_.reach[at], Real(0.5) * length);
                if (D == 3 && !room_.may_be_block[body]) room_.cover[at] = max(room_.cover[at], share_of_cell * length);
            }
    }
};

} // namespace detail
} // namespace sinew
