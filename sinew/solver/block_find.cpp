#include "sinew/solver/block_build.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/step.h"

#include <algorithm>

/// Finding the blocks: which parts of the world hang together, and whether their equations stay sparse.
namespace sinew {
namespace {

template <int D, class Real> class Finder {
  public:
    explicit Finder(World<D, Real>& world)
        : world_(world), particles_(world.particles), graph_(world), builder_(world, graph_), blocks_(world.blocks),
          islands_(world.blocks.islands), room_(world.blocks.room) {}

    void run() {
        blocks_.clear();
        blocks_.holds.assign(particles_.size(), 0);
        blocks_.pin_of.resize(particles_.size());
        blocks_.next_pin.resize(world_.pins.size());
        room_.node_of.assign(particles_.size(), no_row);
        room_.part_of.assign(particles_.size(), no_row);
        room_.taken.resize(std::size_t(Kinds<D>::size));
        for_each_table(world_, [&](const auto& table) { taken(table).assign(table.size(), 0); });
        blocks_.elimination.reset(particles_.size());
        join_islands();
        take_stock();
        graph_.list();
        for (Row row = 0; row < particles_.size(); ++row)
            if (mobile(row) && islands_.of(row) == row && worthwhile(room_.about[row])) build(row);
        hang_trees();
        blocks_.first_entry.push_back(std::uint32_t(blocks_.entries.size()));
        list_loose();
        blocks_.stale = false;
    }

  private:
    using About = BlockRoom::About;
    using Graph = detail::BlockGraph<D, Real>;

    World<D, Real>& world_;
    Particles<D, Real>& particles_;
    detail::BlockGraph<D, Real> graph_;
    detail::BlockBuilder<D, Real> builder_;
    Blocks<D>& blocks_;
    Islands& islands_;
    BlockRoom& room_;

    bool mobile(Row particle) const { return graph_.mobile(particle); }
    template <class Table> std::vector<char>& taken(const Table&) {
        return room_.taken[std::size_t(Kinds<D>::template index_of<typename Table::Kind>)];
    }

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

    void take_stock() {
        room_.about.assign(particles_.size(), {});
        for (Row row = 0; row < particles_.size(); ++row)
            if (mobile(row)) {
                auto& about = room_.about[islands_.of(row)];
                ++about.particles;
                const auto direct = graph_.direct_of(row);
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
                    about.suits = about.suits && Graph::natural(table, row) && graph_.has_length(row);
                } else if constexpr (std::is_same_v<Kind, Pulley<D>>) {
                    about.links += 2;
                    about.inner_links += moving - 1;
                    about.suits = about.suits && Graph::natural(table, row);
                } else if constexpr (std::is_same_v<Kind, Angle<D>>) {
                    about.suits = about.suits && Graph::natural(table, row) && !Graph::opens(table, row);
                } else {
                    about.suits = false;
                }
            }
        });
        for (Row row = 0; row < particles_.size(); ++row)
            if (mobile(row)) room_.part_of[row] = islands_.of(row);
        sort_into_parts();
    }

    /// Particles by the part they are in.
    void sort_into_parts() {
        room_.first_member.assign(particles_.size() + 1, 0);
        for (Row row = 0; row < particles_.size(); ++row)
            if (room_.part_of[row] != no_row) ++room_.first_member[room_.part_of[row] + 1];
        for (std::size_t i = 1; i < room_.first_member.size(); ++i) room_.first_member[i] += room_.first_member[i - 1];
        room_.members.resize(room_.first_member.back());
        auto& next = room_.cursor;
        next = room_.first_member;
        for (Row row = 0; row < particles_.size(); ++row)
            if (room_.part_of[row] != no_row) room_.members[next[room_.part_of[row]]++] = row;
    }
    std::span<const Row> members_of(Row part) const {
        const auto first = room_.first_member[part];
        return std::span(std::as_const(room_.members)).subspan(first, room_.first_member[part + 1] - first);
    }

    void build(Row island) {
        if (!builder_.build(members_of(island), island, blocks_.list, false)) return;
        for (const Row row : members_of(island)) blocks_.holds[row] = 1;
    }

    // --- trees that hang on what has too many loops: ropes on a cloth -----------------------------------------------

    /// Leaves are taken away until none is left. What went, and what it went from, is a tree.
    void hang_trees() {
        peel();
        room_.part_of.assign(particles_.size(), no_row);
        for (std::size_t i = room_.peeled.size(); i-- > 0;) {
            const Row row = room_.peeled[i], parent = room_.parent[row];
            const Row root = room_.parent[parent] == no_row ? parent : room_.part_of[parent];
            room_.part_of[row] = room_.part_of[root] = root;
        }
        sort_into_parts();
        for (Row row = 0; row < particles_.size(); ++row)
            if (room_.part_of[row] == row && members_of(row).size() > 2)
                builder_.build(members_of(row), row, blocks_.hanging, true);
    }

    void peel() {
        auto& bonds = room_.cursor; // to others that move and have not gone
        auto& peeled = room_.peeled;
        bonds.assign(particles_.size(), 0);
        room_.parent.assign(particles_.size(), no_row);
        peeled.clear();
        constexpr Row never = 1 << 20; // more than any will lose
        const auto& distances = graph_.distances();
        for (Row link = 0; link < distances.size(); ++link) {
            const Row a = graph_.end(link, 0), b = graph_.end(link, 1);
            if (taken(distances)[link] || !mobile(a) || !mobile(b)) continue;
            const bool binds = !graph_.is_stick(link) || is_off(a) || is_off(b);
            bonds[a] += binds ? never : 1, bonds[b] += binds ? never : 1;
        }
        for (Row row = 0; row < particles_.size(); ++row)
            if (bonds[row] == 1) peeled.push_back(row);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < peeled.size(); ++i) { // grows on the way
            const Row row = peeled[i];
            if (bonds[row] != 1) continue; // the last of a tree
            const Row parent = neighbour_left(row);
            room_.parent[row] = parent;
            bonds[row] = 0;
            if (--bonds[parent] == 1) peeled.push_back(parent);
            peeled[kept++] = row;
        }
        peeled.resize(kept);
    }

    bool is_off(Row particle) const { return graph_.direct_of(particle) == Direct::off; }

    Row neighbour_left(Row row) const {
        for (const Row link : graph_.links_of(row))
            if (const Row other = graph_.other_end(link, row); mobile(other) && room_.parent[other] == no_row)
                return other;
        return no_row;
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
                    if (taken(table)[row]) continue;
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
    make_plan(world);
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
