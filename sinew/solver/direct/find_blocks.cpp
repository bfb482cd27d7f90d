#include "sinew/math/sort.h"
#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/direct/attached_pieces.h"
#include "sinew/solver/direct/build.h"
#include "sinew/solver/direct/eligibility_scan.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/project.h"
#include "sinew/world/asleep.h"
#include "sinew/world/changes.h"
#include "sinew/world/constraint_graph.h"

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
        for (Row row = 0; row < particles_.size(); ++row)
            particles_.at_end[row] = blocks_.particles.has(particles_.handles.index_of(row));
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

    bool mobile(Row particle) const { return graph_.mobile(particle); }

    void make_room() {
        detail::list_constraints(world_);
        const auto count = particles_.size();
        for (auto* column : {&room_.part_of, &room_.node_of, &room_.adjacency, &room_.parent}) column->resize(count);
        room_.pieces.make_room(count);
        room_.direct.resize(count);
        room_.met.resize(count, 0);
        blocks_.pin_of.resize(count);
        blocks_.next_pin.resize(world_.pins.size());
        blocks_.elimination.make_room(count);
    }
    void begin_search() {
        ++blocks_.searches;
        room_.parts.clear();
        room_.members.clear();
        room_.attached.clear();
    }

    void find_all() {
        begin_search();
        blocks_.clear();
        world_.journal.adjacency.forget();
        std::size_t constraints = 0;
        bool may_tear = false; // tears need the adjacency of all constraints
        for_each_table(world_, [&](const auto& table) {
            constraints += table.size();
            may_tear = may_tear || table.may_tear();
        });
        constexpr std::size_t small = 100'000;
        const bool large = constraints > small;
        if (!large || may_tear || any_asleep(particles_) ||
            !detail::BlockEligibilityScan(world_, graph_).sees_no_blocks())
            spread();
        build_parts();
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
        begin_search();
        make_room();
        const auto& handles = particles_.handles;
        bool any_folds = false; // their skeletons are blocks or not by their masses
        graph_.with_volumes([&](const auto& table) { any_folds = table.size() > 0; });
        for (const auto& touched : world_.journal.touched) {
            if (!handles.in_use(touched.particle)) continue;
            const Row row = handles.row_at(touched.particle);
            if (touched.what == Touch::weight && !(any_folds && mobile(row))) continue;
            if (mobile(row)) {
                spread(row);
                continue;
            }
            blocks_.particles.set(touched.particle, false);
            for_each_constraint(world_, row, [&](const auto& table, Row constraint) {
                if (touched.what == Touch::mobility || !moves_any(table, constraint)) spread_over(table, constraint);
            });
        }
        const auto gone = [&](const Block& block) {
            if (!handles.in_use(block.particle)) return true;
            const Row row = handles.row_at(block.particle);
            return !mobile(row) || room_.met[row] == blocks_.searches;
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
            for_each_constraint(world_, row, [&](const auto& table, Row constraint) { visit(table, constraint, row); });
        }
        const auto part = room_.members.begin() + std::ptrdiff_t(first);
        sinew::sort(part, room_.members.end());
    }
    bool meet(Row particle) {
        if (room_.met[particle] == blocks_.searches) return false;
        room_.met[particle] = blocks_.searches;
        room_.members.push_back(particle);
        return true;
    }
    /// Meets the members of a constraint, which counts at its first movable particle.
    template <class Table> void visit(const Table& table, Row row, Row from) {
        std::uint32_t moving = 0;
        bool is_first = false;
        for (const Row member : table.members[row]) {
            if (!mobile(member)) continue;
            is_first = is_first || (moving == 0 && member == from);
            meet(member);
            ++moving;
        }
        if (!is_first) return;
        blocks_.constraints_of(table).set(table.handles.index_of(row), false);
        worth_.take_stock(room_.parts.back(), table, row, moving);
    }

    template <class Table> bool moves_any(const Table& table, Row row) const {
        const auto members = table.members[row];
        return std::any_of(members.begin(), members.end(), [&](Row member) { return mobile(member); });
    }

    /// Collects the components of all members of a constraint, for an immovable particle among the members.
    template <class Table> void spread_over(const Table& table, Row row) {
        blocks_.constraints_of(table).set(table.handles.index_of(row), false);
        for (const Row member : table.members[row]) spread(member);
    }

    // --- blocks -----------------------------------------------------------------------------------------------------

    std::span<const Row> members_of(const Part& part) const {
        return std::span(std::as_const(room_.members)).subspan(part.first, part.particles);
    }

    void build_parts() {
        for (const auto& part : room_.parts) {
            const auto members = members_of(part);
            if (particles_.asleep[members.front()]) {
                leave_out(members);
                continue;
            }
            const bool built = worth_.worthwhile(part) && build(members, members.front(), blocks_.list, false);
            for (const Row row : members) blocks_.particles.set(particles_.handles.index_of(row), built);
            if (built) continue;
            detail::AttachedPieces<D, Real>(world_, graph_, worth_, room_)
                .find(members, [&](std::span<const Row> piece, Row root) {
                    return build(piece, root, blocks_.attached_trees, true);
                });
        }
        blocks_.first_entry.push_back(std::uint32_t(blocks_.entries.size()));
    }
    /// A body asleep is neither a block nor swept.
    void leave_out(std::span<const Row> members) {
        for (const Row row : members) {
            blocks_.particles.set(particles_.handles.index_of(row), true);
            for_each_constraint(world_, row, [&](const auto& table, Row constraint) {
                blocks_.constraints_of(table).set(table.handles.index_of(constraint), true);
            });
        }
    }
    bool build(std::span<const Row> members, Row part, std::vector<Block>& list, bool attached) {
        for (const Row row : members) room_.part_of[row] = part;
        return builder_.build(members, part, list, attached);
    }

    void append_run(int kind, const Rows& rows) {
        auto* end = blocks_.runs.empty() ? nullptr : &blocks_.runs.back();
        if (end && end->kind == kind && end->rows.last == rows.first)
            end->rows.last = rows.last;
        else
            blocks_.runs.push_back({kind, rows});
    }
    /// Lists the constraints left to the sweep.
    void list_runs() {
        blocks_.runs.clear();
        std::array<Row, std::size_t(Kinds<D>::size)> next{};
        for (const auto& run : world_.sweep)
            visit_table(world_, run.kind, [&](const auto& table) {
                auto& row = next[std::size_t(run.kind)];
                const Row first = row, last = first + run.count;
                row = last;
                const auto& held = blocks_.constraints_of(table);
                if (held.empty()) return append_run(run.kind, {first, last});
                for (Row i = first; i < last; ++i)
                    if (!held.has(table.handles.index_of(i))) append_run(run.kind, {i, i + 1});
            });
    }
};

} // namespace

template <int D, class Real> bool find_blocks(World<D, Real>& world, Solver<D, Real>& solver) {
    const bool anew = BlockFinder(world, solver).run();
    const auto parts = std::size_t(detail::parts_in_lanes(solver.options.threads));
    detail::order_chains(solver.blocks, parts);
    detail::order_programs(solver.blocks, parts);
    return anew;
}

#define SINEW_BLOCK_FIND(D, Real) template bool find_blocks(World<D, Real>&, Solver<D, Real>&);
SINEW_INSTANTIATE(SINEW_BLOCK_FIND)

} // namespace sinew
