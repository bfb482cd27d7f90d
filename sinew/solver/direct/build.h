#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/direct/find_chain.h"
#include "sinew/solver/direct/graph.h"
#include "sinew/solver/solver.h"

#include <algorithm>

/// Builds a block of particles: nodes in elimination order, constraints, and entries of the matrix.
namespace sinew::detail {

template <int D, class Real> class BlockBuilder {
    using Graph = BlockGraph<D, Real>;

  public:
    BlockBuilder(World<D, Real>& world, Solver<D, Real>& solver, const Graph& graph)
        : world_(world), graph_(graph), particles_(world.particles),
          distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          angles_(std::get<kind_number<Angle, D>>(world.constraints)),
          pulleys_(std::get<kind_number<Pulley, D>>(world.constraints)), constraints_(world.constraints),
          blocks_(solver.blocks), elimination_(solver.blocks.elimination), room_(solver.blocks.room) {}

    /// Builds a block of `members`, whose `part_of` is `part`, and appends the block to `list`. False if the
    /// factorisation would not stay sparse, or if room runs out: then everything is stale. A block that `hangs` on the
    /// rest of the world takes rigid constraints only.
    bool build(std::span<const Row> members, Row part, std::vector<Block>& list, bool attached) {
        SINEW_ASSERT(!members.empty(), "a block has a particle that moves");
        part_ = part, hangs_ = attached;
        if (!eliminate(members)) return false;
        const auto each = 4 + (attached ? most_tethers : 0);
        if (!world_.journal.stale &&
            !blocks_.has_room(each * members.size() + 2 * neighbours_ + elimination_.pairs())) {
            world_.journal.stale = true;
            return false;
        }
        Block block{.first_node = std::uint32_t(blocks_.nodes.size()),
                    .unknowns = std::uint32_t(members.size()),
                    .particle = particles_.slots.slot_of(members.front()),
                    .row_moves = world_.journal.row_moves};
        for (const Row row : elimination_.order()) add_node(row);
        add_entries(block);
        block.first_link = std::uint32_t(blocks_.links.size());
        for (const Row row : elimination_.order()) add_links(row);
        block.links = std::uint32_t(blocks_.links.size()) - block.first_link;
        block.first_bend = std::uint32_t(blocks_.bends.size());
        for (const Row row : elimination_.order()) add_bends(row), add_folds(row);
        block.bends = std::uint32_t(blocks_.bends.size()) - block.first_bend;
        block.first_way = std::uint32_t(blocks_.ways.size());
        for (const Row row : elimination_.order()) add_ways(row);
        block.ways = std::uint32_t(blocks_.ways.size()) - block.first_way;
        if (attached) add_ports(block);
        block.is_motorized = is_motorized(block);
        block.ranges = ranges_of(block);
        block.springy = is_springy(block);
        block.nodes = std::uint32_t(blocks_.nodes.size()) - block.first_node;
        SINEW_ASSERT(block.nodes >= block.unknowns, "nodes that cannot move come after the unknowns");
        for (std::size_t i = block.unknowns; i < block.nodes; ++i) {
            blocks_.first_entry.push_back(std::uint32_t(blocks_.entries.size()));
            blocks_.first_pair.push_back(std::uint32_t(blocks_.pairs.size()));
        }
        SINEW_ASSERT(blocks_.first_entry.size() == blocks_.nodes.size(), "every node knows its first entry");
        SINEW_ASSERT(blocks_.first_pair.size() == blocks_.nodes.size(), "every node knows its first pair");
        if (!attached) ChainFinder<D>(blocks_, block).run();
        list.push_back(block);
        return true;
    }

  private:
    World<D, Real>& world_;
    const Graph& graph_;
    const Particles<D, Real>& particles_;
    Constraints<Distance<D>, Real>& distances_;
    Constraints<Angle<D>, Real>& angles_;
    Constraints<Pulley<D>, Real>& pulleys_;
    ConstraintTables<D, Real>& constraints_;
    Blocks<D>& blocks_;
    Elimination& elimination_;
    BlockRoom& room_;
    Row part_ = no_row;
    bool hangs_ = false;
    std::size_t neighbours_ = 0; ///< neighbours of all members, with repetitions

    bool mobile(Row particle) const { return graph_.mobile(particle); }
    template <class Table> static bool is_driven(const Table& table, Row row) { return Graph::is_driven(table, row); }

    /// Orders the members for elimination. False if the factorisation would not stay sparse.
    bool eliminate(std::span<const Row> members) {
        neighbours_ = 0;
        elimination_.begin_graph();
        for (const Row row : members) {
            elimination_.begin_row(row);
            add_neighbours(distances_, row);
            add_neighbours(angles_, row);
            add_neighbours(pulleys_, row);
            graph_.with_volumes([&](const auto& volumes) { add_neighbours(volumes, row); });
            elimination_.end_row(row);
        }
        return elimination_.run(members);
    }

    /// True if all movable members of a constraint are in this block.
    template <class Table> bool takes(const Table& table, Row row) const {
        for (const Row member : table.members[row])
            if (mobile(member) && room_.part_of[member] != part_) return false;
        return !hangs_ || graph_.is_rigid(table, row);
    }

    template <class Table> void add_neighbours(const Table& table, Row row) {
        graph_.each(table, row, [&](Row constraint) {
            if (!takes(table, constraint)) return;
            for (const Row other : table.members[constraint])
                if (++neighbours_; other != row && mobile(other)) elimination_.add_neighbour(other);
        });
    }

    void add_node(Row row) {
        room_.node_of[row] = Row(blocks_.nodes.size());
        blocks_.nodes.push_back({.row = row, .slot = particles_.slots.slot_of(row)});
    }

    std::uint32_t entry_of(std::uint32_t column, std::uint32_t node) const {
        auto entry = blocks_.first_entry[column];
        while (blocks_.entries[entry].node != node) ++entry;
        SINEW_ASSERT(column + 1 >= blocks_.first_entry.size() || entry < blocks_.first_entry[column + 1],
                     "two nodes of a constraint are coupled");
        return entry;
    }

    void add_entries(const Block& block) {
        for (std::uint32_t i = 0; i < block.unknowns; ++i) {
            blocks_.first_entry.push_back(std::uint32_t(blocks_.entries.size()));
            const auto begin = std::ptrdiff_t(blocks_.entries.size());
            for (const Row neighbour : elimination_.neighbours(elimination_.order()[i]))
                blocks_.entries.push_back({.node = block.first_node + elimination_.position(neighbour)});
            std::sort(blocks_.entries.begin() + begin, blocks_.entries.end(),
                      [](const auto& a, const auto& b) { return a.node < b.node; });
        }
        blocks_.first_entry.push_back(std::uint32_t(blocks_.entries.size()));
        for (std::uint32_t i = block.first_node; i < block.first_node + block.unknowns; ++i) {
            blocks_.first_pair.push_back(std::uint32_t(blocks_.pairs.size()));
            for (auto e = blocks_.first_entry[i]; e < blocks_.first_entry[i + 1]; ++e)
                for (auto g = e + 1; g < blocks_.first_entry[i + 1]; ++g)
                    blocks_.pairs.push_back(entry_of(blocks_.entries[e].node, blocks_.entries[g].node));
        }
        blocks_.first_entry.pop_back();
    }

    /// Adds the links of a particle that no earlier particle of the block has added.
    void add_links(Row row) {
        graph_.each(distances_, row, [&](Row link) {
            const Row other = graph_.other_end(link, row);
            const bool inner = mobile(other);
            if (!takes(distances_, link) || is_driven(distances_, link)) return;
            if (inner && elimination_.position(other) < elimination_.position(row)) return;
            const auto a = room_.node_of[row], b = node_for(other);
            DistanceRow<D> added;
            static_cast<BlockLimit&>(added) = limit_of(distances_, link);
            added.low = maximum(added.low, 0.0);
            added.a = a, added.b = b;
            added.entry = inner ? entry_of(a, b) : Blocks<D>::none;
            constexpr double far = 1e12; // as good as no limit
            added.length = added.high < far ? added.high : maximum(added.low, 1e-6);
            if (added.is_range()) added.length = minimum(added.high, 2 * added.low);
            added.per_length2 = 1 / square(added.length);
            blocks_.links.push_back(added);
            hold(distances_, link);
        });
    }

    template <class Table> void hold(const Table& table, Row row) {
        blocks_.constraints_of(table).set(table.slots.slot_of(row), true);
    }

    // --- ports

    /// Adds the ports: nodes on which constraints outside the block act. Each gets load tethers, inactive at first
    /// (ports/load_tethers.h). Load tethers are the last links of the block, hence added after everything else.
    void add_ports(Block& block) {
        for (std::uint32_t i = block.first_node; i < block.first_node + block.unknowns; ++i) {
            if (!is_port(blocks_.nodes[i].row)) continue;
            ++block.ports;
            for (std::size_t t = 0; t < most_tethers; ++t) add_load_tether(i);
            block.load_tethers += std::uint32_t(most_tethers);
        }
        block.links += block.load_tethers;
    }
    bool is_port(Row row) const {
        bool found = false;
        for_each_constraint(world_, row, [&](const auto& table, Row constraint) {
            found = found || !blocks_.holds(table, constraint);
        });
        return found;
    }
    void add_load_tether(std::uint32_t node) {
        constexpr double far = 1e12;
        DistanceRow<D> tether;
        tether.slot = no_row;
        tether.high = far;
        tether.a = node;
        tether.b = std::uint32_t(blocks_.nodes.size());
        tether.entry = Blocks<D>::none;
        const auto& at = blocks_.nodes[node];
        blocks_.nodes.push_back({.row = at.row, .slot = at.slot});
        blocks_.links.push_back(tether);
    }

    /// Node of a particle. An immovable particle gets a new node at each use.
    std::uint32_t node_for(Row particle) {
        if (mobile(particle)) return room_.node_of[particle];
        blocks_.nodes.push_back({.row = particle, .slot = particles_.slots.slot_of(particle)});
        return std::uint32_t(blocks_.nodes.size() - 1);
    }

    template <class Table> static BlockLimit limit_of(const Table& table, Row row) {
        return {.constraint = row,
                .slot = table.slots.slot_of(row),
                .low = double(table.low(row)),
                .high = double(table.high(row)),
                .compliance = double(table.compliance[row])};
    }

    bool is_first(Row row, std::span<const Row> members) const {
        return std::none_of(members.begin(), members.end(), [&](Row other) {
            return mobile(other) && elimination_.position(other) < elimination_.position(row);
        });
    }

    void add_ways(Row row) {
        graph_.each(distances_, row, [&](Row link) {
            if (takes(distances_, link) && is_driven(distances_, link) && is_first(row, distances_.members[link]))
                add_way(distances_, link, false);
        });
        graph_.each(pulleys_, row, [&](Row way) {
            if (takes(pulleys_, way) && is_first(row, pulleys_.members[way])) add_way(pulleys_, way, true);
        });
    }

    template <class Table> void add_way(Table& table, Row row, bool is_pulley) {
        const auto members = std::as_const(table).members[row];
        CableRow added;
        static_cast<BlockLimit&>(added) = limit_of(table, row);
        added.low = maximum(added.low, 0.0);
        added.is_pulley = is_pulley;
        added.motorized = is_driven(table, row);
        added.first = std::uint32_t(blocks_.way_nodes.size());
        added.nodes = std::uint32_t(members.size());
        added.first_entry = std::uint32_t(blocks_.way_entries.size());
        for (const Row member : members) blocks_.way_nodes.push_back({.node = node_for(member)});
        for (std::size_t i = 0; i < members.size(); ++i)
            for (std::size_t j = i + 1; j < members.size(); ++j) {
                const auto [early, late] =
                    std::minmax(blocks_.way_nodes[added.first + i].node, blocks_.way_nodes[added.first + j].node);
                blocks_.way_entries.push_back(mobile(members[i]) && mobile(members[j]) ? entry_of(early, late)
                                                                                       : Blocks<D>::none);
            }
        blocks_.ways.push_back(added);
        hold(table, row);
    }

    bool is_motorized(const Block& block) const {
        const auto any = [](const auto& list, std::uint32_t first, std::uint32_t count) {
            return std::any_of(list.begin() + first, list.begin() + first + count,
                               [](const BlockDrive& drive) { return drive.motorized; });
        };
        return any(blocks_.ways, block.first_way, block.ways) || any(blocks_.bends, block.first_bend, block.bends);
    }

    std::uint32_t ranges_of(const Block& block) const {
        const auto first = blocks_.links.begin() + block.first_link;
        return std::uint32_t(
            std::count_if(first, first + block.links, [](const DistanceRow<D>& link) { return link.is_range(); }));
    }

    bool is_springy(const Block& block) const {
        const auto any = [](const auto& list, std::uint32_t first, std::uint32_t count) {
            return std::any_of(list.begin() + first, list.begin() + first + count,
                               [](const BlockLimit& limit) { return limit.compliance > 0; });
        };
        return any(blocks_.links, block.first_link, block.links) || any(blocks_.bends, block.first_bend, block.bends) ||
               any(blocks_.ways, block.first_way, block.ways);
    }

    /// Squared length at which the link between two particles is taut, m^2; 0 for a link that is never slack, or
    /// driven.
    double slack_arm(Row a, Row b) const {
        double arm = 0;
        graph_.each(distances_, a, [&](Row link) {
            const Real high = distances_.high(link);
            const bool slack = distances_.low(link) < high && high < limit::coordinate<Real>;
            if (slack && !is_driven(distances_, link) && graph_.other_end(link, a) == b) arm = square(double(high));
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
                bend.entries[pair] = mobile(members[i]) && mobile(members[j]) ? entry_of(early, late) : Blocks<D>::none;
            }
    }

    void add_folds(Row row) {
        if constexpr (D == 3) {
            auto& volumes = std::get<kind_number<Volume, D>>(constraints_);
            graph_.each(volumes, row, [&](Row fold) {
                const auto members = std::as_const(volumes).members[fold];
                if (!takes(volumes, fold) || !is_first(row, members)) return;
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

    /// Adds the angles in which a particle is eliminated first.
    void add_bends(Row row) {
        graph_.each(angles_, row, [&](Row bend) {
            const auto members = std::as_const(angles_).members[bend];
            if (!takes(angles_, bend) || !is_first(row, members)) return;
            AngleRow<D> added;
            static_cast<BlockLimit&>(added) = limit_of(angles_, bend);
            added.motorized = is_driven(angles_, bend);
            join(added, members);
            for (std::size_t i = 0; i < 2; ++i) added.arms[i] = slack_arm(members[i], members[i + 1]);
            blocks_.bends.push_back(added);
            hold(angles_, bend);
        });
    }
};

} // namespace sinew::detail
