#include "sinew/solver/step.h"

#include <algorithm>

/// Finding the blocks: which parts of the world hang together, and whether their equations stay sparse.
namespace sinew {
namespace {

template <int D, class Real> class Finder {
  public:
    explicit Finder(World<D, Real>& world)
        : world_(world), particles_(world.particles), distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          angles_(std::get<kind_number<Angle, D>>(world.constraints)),
          pulleys_(std::get<kind_number<Pulley, D>>(world.constraints)), blocks_(world.blocks),
          islands_(world.blocks.islands), elimination_(world.blocks.elimination), room_(world.blocks.room) {}

    void run() {
        blocks_.clear();
        blocks_.holds.assign(particles_.size(), 0);
        blocks_.pin_of.resize(particles_.size());
        blocks_.next_pin.resize(world_.pins.size());
        room_.node_of.assign(particles_.size(), no_row);
        elimination_.reset(particles_.size());
        join_islands();
        take_stock();
        list(distances_, room_.first_link, room_.link_at);
        list(angles_, room_.first_bend, room_.bend_at);
        list(pulleys_, room_.first_way, room_.way_at);
        for (Row row = 0; row < particles_.size(); ++row)
            if (mobile(row) && islands_.of(row) == row && worthwhile(room_.about[row])) build(row);
        blocks_.first_entry.push_back(std::uint32_t(blocks_.entries.size()));
        list_loose();
        blocks_.stale = false;
    }

  private:
    using About = BlockRoom::About;

    World<D, Real>& world_;
    Particles<D, Real>& particles_;
    Constraints<Distance<D>, Real>& distances_;
    Constraints<Angle<D>, Real>& angles_;
    Constraints<Pulley<D>, Real>& pulleys_;
    Blocks<D>& blocks_;
    Islands& islands_;
    Elimination& elimination_;
    BlockRoom& room_;

    bool mobile(Row particle) const { return particles_.mobility[particle] > Real(0); }

    /// What shares no constraint moves by itself. What cannot move joins nothing.
    void join_islands() {
        islands_.reset(particles_.size());
        for_each_table(world_, [&](const auto& table) {
            for (Row row = 0; row < table.size(); ++row) {
                Row first = no_row;
                for (const Row member : table.members[row]) {
                    if (!mobile(member)) continue;
                    if (first == no_row) first = member;
                    islands_.join(first, member);
                }
            }
        });
    }

    /// A single link is as well solved in the sweep, whose one step is then exact. With many loops the factors fill in.
    static bool worthwhile(const About& about) {
        const auto loops = about.inner_links + 1 > about.particles ? about.inner_links + 1 - about.particles : 0;
        if (about.wanted) return about.suits && about.links >= 1;
        return about.suits && about.links >= 2 && loops <= about.particles / 2 + 32;
    }

    /// Shares and relaxations other than the natural ones are wishes about the sweep.
    template <class Table> static bool natural(const Table& table, Row row) {
        return table.split[row] == Real(0.5) && table.relaxation[row] == Real(1);
    }
    /// Without one it has no direction.
    bool has_length(Row link) const { return distances_.high[link] >= Real(1e-6); }

    Row end(Row link, std::size_t i) const { return distances_.members.rows[link][i]; }

    Direct direct_of(Row particle) const {
        const auto figure = particles_.figure[particle];
        return figure < world_.figures.size() ? world_.figures[figure].direct : Direct::automatic;
    }

    void take_stock() {
        room_.about.assign(particles_.size(), {});
        for (Row row = 0; row < particles_.size(); ++row)
            if (mobile(row)) {
                auto& about = room_.about[islands_.of(row)];
                ++about.particles;
                const auto direct = direct_of(row);
                about.suits = about.suits && direct != Direct::off;
                about.wanted = about.wanted || direct == Direct::on;
            }
        for_each_table(world_, [&](const auto& table) {
            using Kind = typename std::decay_t<decltype(table)>::Kind;
            for (Row row = 0; row < table.size(); ++row) {
                Row island = no_row;
                std::uint32_t moving = 0;
                for (const Row member : table.members[row])
                    if (mobile(member)) island = islands_.of(member), ++moving;
                if (island == no_row) continue;
                auto& about = room_.about[island];
                if constexpr (std::is_same_v<Kind, Distance<D>>) {
                    ++about.links;
                    about.inner_links += moving == 2;
                    about.suits = about.suits && natural(table, row) && has_length(row);
                } else if constexpr (std::is_same_v<Kind, Pulley<D>>) {
                    about.links += 2;
                    about.inner_links += moving - 1;
                    about.suits = about.suits && natural(table, row);
                } else {
                    // unsigned, an angle that has to be more than none has no direction to open in
                    const bool opens = D == 3 && table.low[row] > Real(0);
                    about.suits = about.suits && std::is_same_v<Kind, Angle<D>> && natural(table, row) && !opens;
                }
            }
        });
        // particles by island
        room_.first_member.assign(particles_.size() + 1, 0);
        for (Row row = 0; row < particles_.size(); ++row)
            if (mobile(row)) ++room_.first_member[islands_.of(row) + 1];
        for (std::size_t i = 1; i < room_.first_member.size(); ++i) room_.first_member[i] += room_.first_member[i - 1];
        room_.members.resize(room_.first_member.back());
        auto& next = room_.cursor;
        next = room_.first_member;
        for (Row row = 0; row < particles_.size(); ++row)
            if (mobile(row)) room_.members[next[islands_.of(row)]++] = row;
    }

    /// The constraints of each particle, side by side.
    template <class Table> void list(const Table& table, std::vector<Row>& first, std::vector<Row>& at) {
        first.assign(particles_.size() + 1, 0);
        for (Row row = 0; row < table.size(); ++row)
            for (const Row member : table.members[row]) ++first[member + 1];
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        at.resize(first.back());
        auto& next = room_.cursor;
        next = first;
        for (Row row = 0; row < table.size(); ++row)
            for (const Row member : table.members[row]) at[next[member]++] = row;
    }

    std::span<const Row> links_of(Row particle) const { return those_of(particle, room_.first_link, room_.link_at); }
    std::span<const Row> ways_of(Row particle) const { return those_of(particle, room_.first_way, room_.way_at); }
    std::span<const Row> bends_of(Row particle) const { return those_of(particle, room_.first_bend, room_.bend_at); }
    static std::span<const Row> those_of(Row particle, const std::vector<Row>& first, const std::vector<Row>& at) {
        return std::span(at).subspan(first[particle], first[particle + 1] - first[particle]);
    }
    Row other_end(Row link, Row particle) const { return end(link, 0) == particle ? end(link, 1) : end(link, 0); }

    void build(Row island) {
        const auto members =
            std::span(std::as_const(room_.members))
                .subspan(room_.first_member[island], room_.first_member[island + 1] - room_.first_member[island]);
        elimination_.begin_graph();
        for (const Row row : members) {
            elimination_.begin_row(row);
            for (const Row link : links_of(row))
                if (const Row other = other_end(link, row); mobile(other)) elimination_.add_neighbour(other);
            for (const Row bend : bends_of(row))
                for (const Row other : angles_.members[bend])
                    if (other != row && mobile(other)) elimination_.add_neighbour(other);
            for (const Row way : ways_of(row))
                for (const Row other : pulleys_.members[way])
                    if (other != row && mobile(other)) elimination_.add_neighbour(other);
            elimination_.end_row(row);
        }
        if (!elimination_.run(members)) return;

        Block block{.first_node = std::uint32_t(blocks_.nodes.size()), .unknowns = std::uint32_t(members.size())};
        for (const Row row : elimination_.order()) add_node(row);
        add_entries(block);
        block.first_link = std::uint32_t(blocks_.links.size());
        for (const Row row : elimination_.order()) add_links(row);
        block.links = std::uint32_t(blocks_.links.size()) - block.first_link;
        block.first_bend = std::uint32_t(blocks_.bends.size());
        for (const Row row : elimination_.order()) add_bends(row);
        block.bends = std::uint32_t(blocks_.bends.size()) - block.first_bend;
        block.first_way = std::uint32_t(blocks_.ways.size());
        for (const Row row : elimination_.order()) add_ways(row);
        block.ways = std::uint32_t(blocks_.ways.size()) - block.first_way;
        block.motored = block.motored || is_motored(block);
        block.nodes = std::uint32_t(blocks_.nodes.size()) - block.first_node;
        for (std::size_t i = block.unknowns; i < block.nodes; ++i) {
            blocks_.first_entry.push_back(std::uint32_t(blocks_.entries.size()));
            blocks_.first_pair.push_back(std::uint32_t(blocks_.pairs.size()));
        }
        blocks_.list.push_back(block);
    }

    void add_node(Row row) {
        room_.node_of[row] = Row(blocks_.nodes.size());
        blocks_.nodes.push_back({.row = row});
        blocks_.holds[row] = 1;
    }

    std::uint32_t entry_of(std::uint32_t column, std::uint32_t node) const {
        auto entry = blocks_.first_entry[column];
        while (blocks_.entries[entry].node != node) ++entry;
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

    /// Those of a particle that no earlier one of the block has added.
    void add_links(Row row) {
        for (const Row link : links_of(row)) {
            const Row other = other_end(link, row);
            const bool inner = mobile(other);
            if (inner && elimination_.position(other) < elimination_.position(row)) continue;
            if (is_driven(distances_, link)) continue;
            const auto a = room_.node_of[row], b = node_for(other);
            BlockLink<D> added;
            static_cast<BlockLimit&>(added) = limit_of(distances_, link);
            added.low = maximum(added.low, 0.0);
            added.a = a, added.b = b;
            added.entry = inner ? entry_of(a, b) : Blocks<D>::none;
            constexpr double far = 1e12; // as good as no limit
            added.length = added.high < far ? added.high : maximum(added.low, 1e-6);
            added.per_length2 = 1 / square(added.length);
            blocks_.links.push_back(added);
        }
    }

    /// A particle that cannot move is a node each time it is needed.
    std::uint32_t node_for(Row particle) {
        if (mobile(particle)) return room_.node_of[particle];
        blocks_.nodes.push_back({.row = particle});
        return std::uint32_t(blocks_.nodes.size() - 1);
    }

    template <class Table> static BlockLimit limit_of(const Table& table, Row row) {
        return {.constraint = row,
                .low = double(table.low[row]),
                .high = double(table.high[row]),
                .compliance = double(table.compliance[row])};
    }

    template <class Table> static bool is_driven(const Table& table, Row row) {
        return table.driven[row] || table.gives(row);
    }

    bool is_first(Row row, std::span<const Row> members) const {
        return std::none_of(members.begin(), members.end(), [&](Row other) {
            return mobile(other) && elimination_.position(other) < elimination_.position(row);
        });
    }

    void add_ways(Row row) {
        for (const Row link : links_of(row))
            if (is_driven(distances_, link) && is_first(row, std::as_const(distances_).members[link]))
                add_way(distances_, link, false);
        for (const Row way : ways_of(row))
            if (is_first(row, std::as_const(pulleys_).members[way])) add_way(pulleys_, way, true);
    }

    template <class Table> void add_way(const Table& table, Row row, bool is_pulley) {
        const auto members = table.members[row];
        BlockWay added;
        static_cast<BlockLimit&>(added) = limit_of(table, row);
        added.low = maximum(added.low, 0.0);
        added.is_pulley = is_pulley;
        added.driven = is_driven(table, row);
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
    }

    bool is_motored(const Block& block) const {
        const auto any = [](const auto& list, std::uint32_t first, std::uint32_t count) {
            return std::any_of(list.begin() + first, list.begin() + first + count,
                               [](const BlockDrive& drive) { return drive.driven; });
        };
        return any(blocks_.ways, block.first_way, block.ways) || any(blocks_.bends, block.first_bend, block.bends);
    }

    /// Those of which a particle is the first to be eliminated.
    void add_bends(Row row) {
        for (const Row bend : bends_of(row)) {
            const auto members = std::as_const(angles_).members[bend];
            if (!is_first(row, members)) continue;
            BlockBend<D> added;
            static_cast<BlockLimit&>(added) = limit_of(angles_, bend);
            added.driven = is_driven(angles_, bend);
            for (std::size_t i = 0; i < 3; ++i) added.nodes[i] = node_for(members[i]);
            for (std::size_t i = 0; i < 3; ++i) {
                const auto j = (i + 1) % 3;
                const auto [early, late] = std::minmax(added.nodes[i], added.nodes[j]);
                added.entries[i] = mobile(members[i]) && mobile(members[j]) ? entry_of(early, late) : Blocks<D>::none;
            }
            blocks_.bends.push_back(added);
        }
    }

    /// What is left: particles and constraints in no block.
    void list_loose() {
        blocks_.loose.clear();
        for (Row row = 0; row < particles_.size(); ++row) {
            if (blocks_.holds[row]) continue;
            if (blocks_.loose.empty() || blocks_.loose.back().last != row) blocks_.loose.push_back({row, row});
            blocks_.loose.back().last = row + 1;
        }
        blocks_.runs.clear();
        std::array<Row, std::size_t(Kinds<D>::size)> next{};
        for (const auto& run : world_.sweep)
            visit_table(world_, run.kind, [&](const auto& table) {
                auto& row = next[std::size_t(run.kind)];
                for (const Row last = row + run.count; row < last; ++row) {
                    const auto members = table.members[row];
                    if (std::any_of(members.begin(), members.end(), [&](Row m) { return blocks_.holds[m] != 0; }))
                        continue;
                    auto* end = blocks_.runs.empty() ? nullptr : &blocks_.runs.back();
                    if (!end || end->kind != run.kind || end->rows.last != row)
                        blocks_.runs.push_back({run.kind, {row, row}});
                    blocks_.runs.back().rows.last = row + 1;
                }
            });
    }
};

} // namespace

template <int D, class Real> void prepare(World<D, Real>& world) {
    auto& blocks = world.blocks;
    if (!blocks.stale) return;
    Finder(world).run();
    // Room for all that could be, not for what is: a thread that tears must not make a step allocate.
    const auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    constexpr std::size_t small = 100'000; // distances; of more, the room would be waste
    const bool may_tear = std::any_of(distances.breaking_strain.begin(), distances.breaking_strain.end(),
                                      [](Real strain) { return strain < limit::measure<Real>; });
    if (may_tear && distances.size() <= small)
        blocks.reserve(world.particles.size(), distances.size(),
                       std::get<kind_number<Angle, D>>(world.constraints).size());
}

#define SINEW_BLOCK_FIND(D, Real) template void prepare(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_BLOCK_FIND)

} // namespace sinew
