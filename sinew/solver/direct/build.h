#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/direct/add_ports.h"
#include "sinew/solver/direct/block_traits.h"
#include "sinew/solver/direct/build_rows.h"
#include "sinew/solver/direct/find_chain.h"
#include "sinew/solver/direct/find_program.h"
#include "sinew/solver/direct/flat_squares.h"
#include "sinew/solver/solver.h"

/// Builds a block of particles: nodes in elimination order, constraints, and entries of the matrix.
namespace sinew::detail {

template <int D, class Real> class BlockBuilder {
    using Graph = BlockGraph<D, Real>;

  public:
    BlockBuilder(World<D, Real>& world, Solver<D, Real>& solver, const Graph& graph)
        : world_(world), particles_(world.particles), blocks_(solver.blocks),
          elimination_(solver.blocks.elimination), scope_{graph, solver.blocks.room},
          rows_(world, solver.blocks, scope_) {}

    /// Builds a block of `members`, whose `part_of` is `part`, and appends the block to `list`. False if the
    /// factorisation would not stay sparse, or if room runs out: then everything is stale. A block `attached` to the
    /// rest of the world takes rigid constraints only.
    bool build(std::span<const Row> members, Row part, std::vector<Block>& list, bool attached) {
        SINEW_ASSERT(!members.empty(), "a block has a particle that moves");
        scope_.part = part, scope_.attached = attached;
        if (!eliminate(members)) return false;
        const auto each = 4 + (attached ? max_tethers : 0);
        if (!world_.journal.stale &&
            !blocks_.has_room(8 + each * members.size() + 2 * neighbours_ + elimination_.pairs())) {
            world_.journal.stale = true;
            return false;
        }
        Block block{.first_node = std::uint32_t(blocks_.nodes.size()),
                    .unknowns = std::uint32_t(members.size()),
                    .particle = particles_.handles.index_of(members.front()),
                    .row_moves = world_.journal.row_moves};
        for (const Row row : elimination_.order()) add_node(row);
        add_entries(blocks_, elimination_, block);
        add_rows(block);
        if (attached) add_ports(world_, blocks_, block);
        block.is_motorized = is_motorized(blocks_, block);
        block.ranges = ranges_of(blocks_, block);
        block.springy = is_springy(blocks_, block);
        end_nodes(block);
        if (!attached) {
            ChainFinder<D>(blocks_, block).run();
            ProgramFinder<D>(blocks_, block).run();
        }
        list.push_back(block);
        return true;
    }

  private:
    World<D, Real>& world_;
    const Particles<D, Real>& particles_;
    Blocks<D>& blocks_;
    Elimination& elimination_;
    BlockScope<D, Real> scope_;
    BlockRowBuilder<D, Real> rows_;
    std::size_t neighbours_ = 0; ///< neighbours of all members, with repetitions

    /// Orders the members for elimination. False if the factorisation would not stay sparse.
    bool eliminate(std::span<const Row> members) {
        neighbours_ = 0;
        elimination_.begin_graph();
        for (const Row row : members) {
            elimination_.begin_row(row);
            add_neighbours(scope_.graph.distances(), row);
            add_neighbours(scope_.graph.angles(), row);
            add_neighbours(scope_.graph.pulleys(), row);
            scope_.graph.with_volumes([&](const auto& volumes) { add_neighbours(volumes, row); });
            elimination_.end_row(row);
        }
        return elimination_.run(members);
    }

    template <class Table> void add_neighbours(const Table& table, Row row) {
        scope_.graph.each(table, row, [&](Row constraint) {
            if (!scope_.takes(table, constraint)) return;
            for (const Row other : table.members[constraint])
                if (++neighbours_; other != row && scope_.graph.mobile(other)) elimination_.add_neighbour(other);
        });
    }

    void add_node(Row row) {
        scope_.room.node_of[row] = Row(blocks_.nodes.size());
        blocks_.nodes.push_back({.row = row, .slot = particles_.handles.index_of(row)});
    }

    void add_rows(Block& block) {
        block.first_link = std::uint32_t(blocks_.links.size());
        for (const Row row : elimination_.order()) rows_.add_links(row);
        block.first_bend = std::uint32_t(blocks_.bends.size());
        if constexpr (D == 3)
            if (!scope_.attached) block.flat_squares = FlatSquares<D>(blocks_, block).run();
        block.links = std::uint32_t(blocks_.links.size()) - block.first_link;
        for (const Row row : elimination_.order()) rows_.add_bends(row), rows_.add_folds(row);
        block.bends = std::uint32_t(blocks_.bends.size()) - block.first_bend;
        block.first_way = std::uint32_t(blocks_.ways.size());
        for (const Row row : elimination_.order()) rows_.add_ways(row);
        block.ways = std::uint32_t(blocks_.ways.size()) - block.first_way;
    }

    /// Counts the nodes; those that are no unknowns have no entries.
    void end_nodes(Block& block) {
        block.nodes = std::uint32_t(blocks_.nodes.size()) - block.first_node;
        SINEW_ASSERT(block.nodes >= block.unknowns, "nodes that cannot move come after the unknowns");
        for (std::size_t i = block.unknowns; i < block.nodes; ++i) {
            blocks_.first_entry.push_back(std::uint32_t(blocks_.entries.size()));
            blocks_.first_pair.push_back(std::uint32_t(blocks_.pairs.size()));
        }
        SINEW_ASSERT(blocks_.first_entry.size() == blocks_.nodes.size(), "every node knows its first entry");
        SINEW_ASSERT(blocks_.first_pair.size() == blocks_.nodes.size(), "every node knows its first pair");
    }
};

} // namespace sinew::detail
