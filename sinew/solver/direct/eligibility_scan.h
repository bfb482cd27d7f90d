#pragma once

#include "sinew/math/union_find.h"
#include "sinew/solver/direct/eligibility.h"

#include <algorithm>

/// Quick check of a large world, mostly cloth: a pass over the constraints shows the absence of blocks and of attached
/// trees. Then the constraints of each particle need not be listed.
namespace sinew::detail {

template <int D, class Real> class BlockEligibilityScan {
  public:
    BlockEligibilityScan(const World<D, Real>& world, const BlockGraph<D, Real>& graph)
        : world_(world), graph_(graph), worth_(graph) {}

    bool sees_no_blocks() const { return !any_end() && !any_worthwhile(); }

  private:
    const World<D, Real>& world_;
    const BlockGraph<D, Real>& graph_;
    BlockEligibility<D, Real> worth_;

    std::size_t particles() const { return world_.particles.size(); }

    /// True if some particle has a single link, by which a tree could be attached.
    bool any_end() const {
        constexpr unsigned char many = 2;
        const auto& links = graph_.distances();
        std::vector<unsigned char> adjacency(particles());
        for (Row link = 0; link < links.size(); ++link) {
            const Row a = graph_.end(link, 0), b = graph_.end(link, 1);
            if (adjacency[a] == many && adjacency[b] == many) continue;
            if (!graph_.mobile(a) || !graph_.mobile(b)) continue;
            const bool is_first = graph_.may_hang(link);
            for (const Row end : {a, b}) adjacency[end] = is_first && adjacency[end] == 0 ? 1 : many;
        }
        return std::find(adjacency.begin(), adjacency.end(), 1) != adjacency.end();
    }

    bool any_worthwhile() const {
        std::vector<BlockRoom::Part> parts(particles()); // by first particle
        UnionFind joined(particles());
        each_moving([&](const auto&, Row, std::span<const Row> members, Row first) {
            for (const Row member : members)
                if (member != first && graph_.mobile(member)) joined.join(first, member);
        });
        for (Row row = 0; row < particles(); ++row)
            if (graph_.mobile(row)) worth_.take_stock(parts[joined.first_of(row)], row);
        each_moving([&](const auto& table, Row row, std::span<const Row> members, Row first) {
            const auto moving = std::count_if(members.begin(), members.end(), [&](Row m) { return graph_.mobile(m); });
            worth_.take_stock(parts[joined.first_of(first)], table, row, std::uint32_t(moving));
        });
        return std::any_of(parts.begin(), parts.end(), worth_.worthwhile);
    }

    /// Calls visit(table, row, members, first mobile member) for constraints with a mobile member.
    template <class Visit> void each_moving(Visit&& visit) const {
        for_each_table(world_, [&](const auto& table) {
            for (Row row = 0; row < table.size(); ++row) {
                const auto members = table.members[row];
                const auto first =
                    std::find_if(members.begin(), members.end(), [&](Row member) { return graph_.mobile(member); });
                if (first != members.end()) visit(table, row, members, *first);
            }
        });
    }
};

} // namespace sinew::detail
