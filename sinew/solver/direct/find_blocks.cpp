#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/direct/build.h"
#include "sinew/solver/direct/eligibility_scan.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/progress_report.h"
#include "sinew/solver/project.h"
#include "sinew/world/changes.h"

#include <algorithm>

/// Finding the blocks: connected components of the world whose equations stay sparse. Components without a change stay
/// as found; the others are searched as if nothing else existed, so that blocks do not depend on the history of the
/// world.
namespace sinew {
namespace {

template <int D, class Real> class BlockFinder {
  public:
    BlockFinder(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), particles_(world.particles), graph_(world), worth_(graph_), builder_(world, solver, graph_),
          blocks_(solver.blocks), room_(solver.blocks.room) {}

    /// Finds the blocks. True if the whole world was searched.
    bool run() {
        if (!world_.journal.stale) find_again();
        const bool all = world_.journal.stale;
        if (all) find_all();
        list_runs();
        return all;
    }

  private:
    using Part = BlockRoom::Part;

    World<D, Real>& world_;
    Particles<D, Real>& particles_;
    detail::BlockGraph<D, Real> graph_;
    detail::BlockEligibility<D, Real> worth_;
    detail::BlockBuilder<D, Real> builder_;
    Blocks<D>& blocks_;
    BlockRoom& room_;

    static constexpr char met = 2; ///< value of in_block while a search has reached the constraint

    bool mobile(Row particle) const { return graph_.mobile(particle); }

    void make_room() {
        detail::list_bonds(world_);
        const auto count = particles_.size();
        for (auto* column : {&room_.part_of, &room_.node_of, &room_.adjacency, &room_.parent}) column->resize(count);
        room_.direct.resize(count);
        room_.met.resize(count, 0);
        blocks_.pin_of.resize(count);
        blocks_.next_pin.resize(world_.pins.size());
        blocks_.elimination.make_room(count);
    }
    void begin_look() {
        ++blocks_.looks;
        room_.parts.clear();
        room_.members.clear();
        room_.constraints.clear();
        room_.hung.clear();
    }

    void find_all() {
        begin_look();
        blocks_.clear();
        std::fill(particles_.in_block.begin(), particles_.in_block.end(), char(0));
        world_.journal.adjacency.forget();
        std::size_t constraints = 0;
        bool may_tear = false; // tears need the adjacency of all constraints
        for_each_table(world_, [&](auto& table) {
            table.in_block.fill(0);
            constraints += table.size();
            may_tear = may_tear || table.may_tear();
        });
        constexpr std::size_t small = 100'000;
        const bool large = constraints > small;
        if (!large || may_tear || !detail::BlockEligibilityScan(world_, graph_).sees_no_blocks()) spread();
        build_parts();
        if (large) room_.constraints = decltype(room_.constraints)(); // released, and allocated again on demand
        blocks_.leave_room();
        constexpr std::size_t little = 1024;
        world_.journal.touched.reserve(little + blocks_.nodes.size() / 8);
    }
    void spread() {
        make_room();
        for (Row row = 0; row < particles_.size(); ++row) spread(row);
    }

    /// Searches the components of all changed particles. Where there is no room for more, everything becomes stale.
    void find_again() {
        begin_look();
        make_room();
        const auto& slots = particles_.slots;
        for (const auto& touched : world_.journal.touched) {
            if (!slots.in_use(touched.particle)) continue;
            if (touched.what == Touch::weight) continue;
            const Row row = slots.row_at(touched.particle);
            if (!mobile(row)) particles_.in_block[row] = 0;
            if (mobile(row))
                spread(row);
            else if (touched.what == Touch::mobility)
                world_.journal.adjacency.each(touched.particle,
                                              [&](int kind, std::uint32_t slot) { spread_over(kind, slot); });
        }
        const auto gone = [&](const Block& block) {
            if (!slots.in_use(block.particle)) return true;
            const Row row = slots.row_at(block.particle);
            return !mobile(row) || room_.met[row] == blocks_.looks;
        };
        std::erase_if(blocks_.list, gone);
        std::erase_if(blocks_.attached_trees, gone);
        blocks_.first_entry.pop_back();
        build_parts();
    }

    // --- connected components ----------------------------------------------------------------------------------------

    /// Collects the component of a particle. Components are connected through constraints; immovable particles do not
    /// connect.
    void spread(Row from) {
        if (!mobile(from) || !meet(from)) return;
        auto first = room_.members.size() - 1;
        room_.parts.push_back({.first = std::uint32_t(first)});
        for (auto next = first; next < room_.members.size(); ++next) {
            const Row row = room_.members[next];
            worth_.take_stock(room_.parts.back(), row);
            world_.journal.adjacency.each(particles_.slots.slot_of(row), [&](int kind, std::uint32_t slot) {
                visit_table(world_, kind, [&](auto& table) { reach(table, kind, table.slots.row_at(slot)); });
            });
        }
        const auto part = room_.members.begin() + std::ptrdiff_t(first);
        std::sort(part, room_.members.end());
    }
    bool meet(Row particle) {
        if (room_.met[particle] == blocks_.looks) return false;
        room_.met[particle] = blocks_.looks;
        room_.members.push_back(particle);
        return true;
    }
    template <class Table> void reach(Table& table, int kind, Row row) {
        if (table.in_block[row] == met) return;
        table.in_block.set(row, met);
        room_.constraints.push_back({kind, row});
        std::uint32_t moving = 0;
        for (const Row member : std::as_const(table).members[row])
            if (mobile(member)) meet(member), ++moving;
        worth_.take_stock(room_.parts.back(), table, row, moving);
    }

    /// Collects the components of all members of a constraint, for an immovable particle among the members.
    void spread_over(int kind, std::uint32_t slot) {
        visit_table(world_, kind, [&](auto& table) {
            const Row row = table.slots.row_at(slot);
            room_.constraints.push_back({kind, row});
            for (const Row member : std::as_const(table).members[row]) spread(member);
        });
    }

    // --- blocks -----------------------------------------------------------------------------------------------------

    std::span<const Row> members_of(const Part& part) const {
        return std::span(std::as_const(room_.members)).subspan(part.first, part.particles);
    }

    void build_parts() {
        for (const auto& seen : room_.constraints)
            visit_table(world_, seen.kind, [&](auto& table) { table.in_block.set(seen.row, 0); });
        for (const auto& part : room_.parts) {
            const auto members = members_of(part);
            const bool built = worth_.worthwhile(part) && build(members, members.front(), blocks_.list, false);
            for (const Row row : members) particles_.in_block[row] = built;
            if (!built) hang_pieces(part);
        }
        blocks_.first_entry.push_back(std::uint32_t(blocks_.entries.size()));
    }
    bool build(std::span<const Row> members, Row part, std::vector<Block>& list, bool attached) {
        for (const Row row : members) room_.part_of[row] = part;
        return builder_.build(members, part, list, attached);
    }

    // --- trees and figures attached to a component with too many loops: ropes on a cloth, a ragdoll in a hammock ---

    /// Turns trees, and figures eligible for a block, into blocks with ports (ports/ports.h). SweepState particles at
    /// the other end of a link become nodes, too: all pieces attached to one particle form one block.
    void hang_pieces(const Part& part) {
        const auto members = members_of(part);
        peel(members);
        auto& direct = room_.direct;
        for (const Row row : members) direct[row] = 0;
        for (const Row row : room_.peeled) direct[row] = 1;
        find_skeletons(members);
        for (const Row row : members) room_.parent[row] = row, room_.part_of[row] = no_row;
        for (const Row row : members) unite_with_neighbours(row);
        auto& pieces = room_.trees;
        pieces.clear();
        for (const Row row : members)
            if (room_.part_of[row] != no_row) pieces.push_back({first_of(row), row});
        std::sort(pieces.begin(), pieces.end());
        for (const auto& [first, row] : pieces) room_.part_of[row] = no_row;
        for (std::size_t first = 0, end = 0; first < pieces.size(); first = end) {
            room_.tree.clear();
            const Row root = pieces[first].first;
            for (; end < pieces.size() && pieces[end].first == root; ++end) room_.tree.push_back(pieces[end].second);
            if (room_.tree.size() < members.size()) build_piece(root); // the whole component has been judged already
        }
    }

    /// Pieces with many joints, as a rope sewn to a mesh along its length, are left to the sweep.
    void build_piece(Row root) {
        constexpr std::size_t most_joints = 16;
        const auto& all = room_.tree;
        const auto joints =
            std::size_t(std::count_if(all.begin(), all.end(), [&](Row row) { return !room_.direct[row]; }));
        if (all.size() < 2 || joints > most_joints || !build(all, root, blocks_.attached_trees, true)) return;
        for (const Row row : all)
            if (room_.direct[row]) room_.hung.push_back(row);
    }

    Row first_of(Row row) {
        auto& parent = room_.parent;
        while (parent[row] != row) row = parent[row] = parent[parent[row]];
        return row;
    }
    /// Unites a particle with neighbours over links with a direct end, and over links between different figures.
    void unite_with_neighbours(Row row) {
        if (room_.direct[row]) room_.part_of[row] = row;
        graph_.each(graph_.distances(), row, [&](Row link) {
            const Row other = graph_.other_end(link, row);
            const bool joins = particles_.figure[row] != particles_.figure[other];
            if (!mobile(other) || !graph_.may_hang(link) || !(room_.direct[row] || joins)) return;
            room_.part_of[row] = row;
            room_.part_of[other] = other;
            const Row a = first_of(row), b = first_of(other);
            room_.parent[std::max(a, b)] = std::min(a, b);
        });
    }

    /// Marks figures joined to others, but eligible for a block alone.
    void find_skeletons(std::span<const Row> members) {
        auto& figures = room_.figures;
        figures.clear();
        for (const Row row : members)
            if (particles_.figure[row] < world_.figures.size()) figures.push_back({particles_.figure[row], row});
        std::sort(figures.begin(), figures.end());
        for (std::size_t first = 0, end = 0; first < figures.size(); first = end) {
            while (end < figures.size() && figures[end].first == figures[first].first) ++end;
            const auto own = std::span(figures).subspan(first, end - first);
            if (own.size() == members.size() || !is_skeleton(own)) continue;
            for (const auto& [figure, row] : own) room_.direct[row] = 1;
        }
    }
    /// Judges a figure by the constraints among its particles. A small mesh is left to the sweep: several joined have
    /// too many loops.
    bool is_skeleton(std::span<const std::pair<FigureIndex, Row>> own) const {
        Part part;
        for (const auto& [figure, row] : own) {
            worth_.take_stock(part, row);
            world_.journal.adjacency.each(particles_.slots.slot_of(row), [&](int kind, std::uint32_t slot) {
                visit_table(world_, kind, [&](const auto& table) { take_stock(part, table, slot, row); });
            });
        }
        return part.suits && worth_.worthwhile(part) && part.inner_links <= 2 * part.particles;
    }
    /// Constraints count at their first movable particle.
    template <class Table> void take_stock(Part& part, const Table& table, std::uint32_t slot, Row row) const {
        const Row constraint = table.slots.row_at(slot);
        std::uint32_t moving = 0;
        for (const Row member : table.members[constraint]) {
            if (!mobile(member)) continue;
            if (particles_.figure[member] != particles_.figure[row] || (moving == 0 && member != row)) return;
            ++moving;
        }
        worth_.take_stock(part, table, constraint, moving);
        part.suits = part.suits && graph_.is_rigid(table, constraint);
    }

    /// True if a constraint other than a distance acts on a particle that blocks with ports cannot hold.
    bool is_soft(Row row) const {
        bool found = false;
        world_.journal.adjacency.each(particles_.slots.slot_of(row), [&](int kind, std::uint32_t slot) {
            if (kind == kind_number<Distance, D>) return;
            visit_table(world_, kind,
                        [&](const auto& table) { found = found || !graph_.is_rigid(table, table.slots.row_at(slot)); });
        });
        return found;
    }

    /// Removes leaves until none is left; all removed particles form trees.
    void peel(std::span<const Row> members) {
        auto& adjacency = room_.adjacency; // number of links to movable neighbours not yet removed
        auto& peeled = room_.peeled;
        peeled.clear();
        constexpr Row never = 1 << 20; // more than a particle has links
        for (const Row row : members) {
            room_.parent[row] = no_row;
            adjacency[row] = 0;
            graph_.each(graph_.distances(), row, [&](Row link) {
                const Row other = graph_.other_end(link, row);
                if (mobile(other)) adjacency[row] += graph_.may_hang(link) ? 1 : never;
            });
            if (is_soft(row)) adjacency[row] += never;
            if (adjacency[row] == 1) peeled.push_back(row);
        }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < peeled.size(); ++i) { // grows on the way
            const Row row = peeled[i];
            if (adjacency[row] != 1) continue; // the last of a tree
            const Row parent = neighbour_left(row);
            room_.parent[row] = parent;
            adjacency[row] = 0;
            if (--adjacency[parent] == 1) peeled.push_back(parent);
            peeled[kept++] = row;
        }
        peeled.resize(kept);
    }

    Row neighbour_left(Row row) const {
        Row left = no_row;
        graph_.each(graph_.distances(), row, [&](Row link) {
            const Row other = graph_.other_end(link, row);
            if (left == no_row && mobile(other) && room_.parent[other] == no_row) left = other;
        });
        return left;
    }

    /// Lists the constraints left to the sweep.
    void list_runs() {
        blocks_.runs.clear();
        std::array<Row, std::size_t(Kinds<D>::size)> next{};
        for (const auto& run : world_.sweep)
            visit_table(world_, run.kind, [&](const auto& table) {
                auto& row = next[std::size_t(run.kind)];
                for (const Row last = row + run.count; row < last;) {
                    const Row first = std::min(last, Row(next_flag(table.in_block, row, 0)));
                    row = std::min(last, Row(next_flag(table.in_block, first, 1)));
                    if (first == row) continue;
                    auto* end = blocks_.runs.empty() ? nullptr : &blocks_.runs.back();
                    if (end && end->kind == run.kind && end->rows.last == first)
                        end->rows.last = row;
                    else
                        blocks_.runs.push_back({run.kind, {first, row}});
                }
            });
    }
};

/// Reserves for every state within reach of tears: a tearing thread must not make a step allocate.
template <int D, class Real> void reserve_for_tears(World<D, Real>& world, Solver<D, Real>& solver) {
    const auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    constexpr std::size_t small = 100'000; // distances; of more, the room would be waste
    if (!distances.may_tear() || distances.size() > small) return;
    solver.blocks.reserve(world.particles.size(), distances.size(),
                          std::get<kind_number<Angle, D>>(world.constraints).size());
}

} // namespace

template <int D, class Real> void Solver<D, Real>::prepare(World<D, Real>& world) {
    auto& journal = world.journal;
    if (!identity) identity = std::make_shared<const char>();
    if (std::exchange(journal.reader, identity) != identity) journal.stale = true;
    if (!journal.changed && !journal.stale) return;
    detail::make_room_for_widest(world, scratch);
    reserve_for_tears(world, *this);
    make_room_for_budgets(world, *this);
    Waiting::tell(0);
    const bool anew = BlockFinder(world, *this).run();
    find_ports(world, *this);
    Waiting::tell(0.2);
    make_plan(world, *this, anew);
    tie_ports(world, *this);
    find_free_bodies(world, *this);
    if (contacts) contacts->is_stale = true;
    journal.read();
    Waiting::tell(1);
}

#define SINEW_BLOCK_FIND(D, Real) template void Solver<D, Real>::prepare(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_BLOCK_FIND)

} // namespace sinew
