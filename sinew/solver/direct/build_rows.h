#pragma once

#include "sinew/solver/direct/block_scope.h"
#include "sinew/solver/direct/matrix_structure.h"
#include "sinew/world/slack_links.h"

#include <algorithm>

namespace sinew::detail {

/// Rows of the block being built, each added at the member eliminated first.
template <int D, class Real> class BlockRowBuilder {
    using Graph = BlockGraph<D, Real>;

  public:
    BlockRowBuilder(const World<D, Real>& world, Blocks<D>& blocks, const BlockScope<D, Real>& scope)
        : world_(world), particles_(world.particles), distances_(scope.graph.distances()),
          angles_(scope.graph.angles()), pulleys_(scope.graph.pulleys()), blocks_(blocks),
          elimination_(blocks.elimination), scope_(scope) {}

    /// Adds the links of a particle that no earlier particle of the block has added.
    void add_links(Row row) {
        scope_.graph.each(distances_, row, [&](Row link) {
            const Row other = scope_.graph.other_end(link, row);
            const bool inner = scope_.graph.mobile(other);
            if (!scope_.takes(distances_, link) || Graph::is_driven(distances_, link)) return;
            if (inner && elimination_.position(other) < elimination_.position(row)) return;
            const auto a = scope_.room.node_of[row], b = node_for(other);
            DistanceRow<D> added;
            static_cast<BlockLimit&>(added) = limit_of(distances_, link);
            added.low = max(added.low, 0.0);
            added.a = a, added.b = b;
            added.entry = inner ? entry_of(blocks_, a, b) : Blocks<D>::none;
            constexpr double far = 1e12; // as good as no limit
            added.length = added.high < far ? added.high : max(added.low, 1e-6);
            if (added.is_range()) added.length = min(added.high, 2 * added.low);
            added.per_length2 = 1 / square(added.length);
            blocks_.links.push_back(added);
            hold(distances_, link);
        });
    }

    /// Adds the angles in which a particle is eliminated first.
    void add_bends(Row row) {
        scope_.graph.each(angles_, row, [&](Row bend) {
            const auto members = angles_.members[bend];
            if (!scope_.takes(angles_, bend) || !is_first(row, members)) return;
            AngleRow<D> added;
            static_cast<BlockLimit&>(added) = limit_of(angles_, bend);
            added.motorized = Graph::is_driven(angles_, bend);
            join(added, members);
            for (std::size_t i = 0; i < 2; ++i) added.arms[i] = slack_arm(members[i], members[i + 1]);
            blocks_.bends.push_back(added);
            hold(angles_, bend);
        });
    }

    void add_folds(Row row) {
        if constexpr (D == 3) {
            const auto& volumes = std::get<kind_number<Volume, D>>(world_.constraints);
            scope_.graph.each(volumes, row, [&](Row fold) {
                const auto members = volumes.members[fold];
                if (!scope_.takes(volumes, fold) || !is_first(row, members)) return;
                AngleRow<D> added;
                static_cast<BlockLimit&>(added) = limit_of(volumes, fold);
                added.unit = Graph::fold_unit(volumes, fold);
                added.low_begun = added.low /= added.unit;
                added.high_begun = added.high /= added.unit;
                join(added, members);
                blocks_.bends.push_back(added);
                hold(volumes, fold);
            });
        }
    }

    void add_ways(Row row) {
        scope_.graph.each(distances_, row, [&](Row link) {
            if (scope_.takes(distances_, link) && Graph::is_driven(distances_, link) &&
                is_first(row, distances_.members[link]))
                add_way(distances_, link, false);
        });
        scope_.graph.each(pulleys_, row, [&](Row way) {
            if (scope_.takes(pulleys_, way) && is_first(row, pulleys_.members[way])) add_way(pulleys_, way, true);
        });
    }

  private:
    const World<D, Real>& world_;
    const Particles<D, Real>& particles_;
    const Constraints<Distance<D>, Real>& distances_;
    const Constraints<Angle<D>, Real>& angles_;
    const Constraints<Pulley<D>, Real>& pulleys_;
    Blocks<D>& blocks_;
    const Elimination& elimination_;
    const BlockScope<D, Real>& scope_;

    template <class Table> void hold(const Table& table, Row row) {
        blocks_.constraints_of(table).set(table.handles.index_of(row), true);
    }

    /// Node of a particle. An immovable particle gets a new node at each use.
    std::uint32_t node_for(Row particle) {
        if (scope_.graph.mobile(particle)) return scope_.room.node_of[particle];
        blocks_.nodes.push_back({.row = particle, .slot = particles_.handles.index_of(particle)});
        return std::uint32_t(blocks_.nodes.size() - 1);
    }

    template <class Table> static BlockLimit limit_of(const Table& table, Row row) {
        return {.constraint = row,
                .slot = table.handles.index_of(row),
                .low = double(table.low(row)),
                .high = double(table.high(row)),
                .compliance = double(table.compliance[row])};
    }

    bool is_first(Row row, std::span<const Row> members) const {
        return std::none_of(members.begin(), members.end(), [&](Row other) {
            return scope_.graph.mobile(other) && elimination_.position(other) < elimination_.position(row);
        });
    }

    template <class Table> void add_way(const Table& table, Row row, bool is_pulley) {
        const auto members = table.members[row];
        CableRow added;
        static_cast<BlockLimit&>(added) = limit_of(table, row);
        added.low = max(added.low, 0.0);
        added.is_pulley = is_pulley;
        added.motorized = Graph::is_driven(table, row);
        added.first = std::uint32_t(blocks_.way_nodes.size());
        added.nodes = std::uint32_t(members.size());
        added.first_entry = std::uint32_t(blocks_.way_entries.size());
        for (const Row member : members) blocks_.way_nodes.push_back({.node = node_for(member)});
        for (std::size_t i = 0; i < members.size(); ++i)
            for (std::size_t j = i + 1; j < members.size(); ++j) {
                const auto [early, late] =
                    std::minmax(blocks_.way_nodes[added.first + i].node, blocks_.way_nodes[added.first + j].node);
                blocks_.way_entries.push_back(scope_.graph.mobile(members[i]) && scope_.graph.mobile(members[j])
                                                  ? entry_of(blocks_, early, late)
                                                  : Blocks<D>::none);
            }
        blocks_.ways.push_back(added);
        hold(table, row);
    }

    /// Square of the fading length of the link between two particles, m^2; 0 for a link that keeps its length, or is
    /// driven.
    double slack_arm(Row a, Row b) const {
        double arm = 0;
        scope_.graph.each(distances_, a, [&](Row link) {
            const double length = fading_length(distances_, link);
            if (length > 0 && !Graph::is_driven(distances_, link) && scope_.graph.other_end(link, a) == b)
                arm = square(length);
        });
        return arm;
    }

    /// Sets the nodes of a bend, and the matrix entries of all pairs.
    void join(AngleRow<D>& bend, std::span<const Row> members) {
        bend.arity = members.size();
        for (std::size_t i = 0; i < members.size(); ++i) bend.nodes[i] = node_for(members[i]);
        for (std::size_t i = 0, pair = 0; i < members.size(); ++i)
            for (std::size_t j = i + 1; j < members.size(); ++j, ++pair) {
                const auto [early, late] = std::minmax(bend.nodes[i], bend.nodes[j]);
                bend.entries[pair] = scope_.graph.mobile(members[i]) && scope_.graph.mobile(members[j])
                                         ? entry_of(blocks_, early, late)
                                         : Blocks<D>::none;
            }
    }
};

} // namespace sinew::detail
