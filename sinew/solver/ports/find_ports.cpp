#include "sinew/assert/assert.h"
#include "sinew/math/sort.h"
#include "sinew/solver/direct/graph.h"
#include "sinew/solver/direct/look_up_rows.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/ports/load_tethers.h"
#include "sinew/world/constraint_graph.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace sinew {
namespace {

/// The first of a port's load tethers.
std::uint32_t first_tether(const Block& block, std::uint32_t port) {
    return block.first_link + block.links - block.load_tethers + port * std::uint32_t(max_tethers);
}

/// Length of the shortest link at a node.
template <int D> double shortest_link(const Blocks<D>& blocks, const Block& block, std::uint32_t node) {
    double shortest = double(limit::coordinate<double>);
    for (const auto& link : std::span(blocks.links).subspan(block.first_link, block.links - block.load_tethers))
        if (link.a == node || link.b == node) shortest = min(shortest, link.length);
    return shortest;
}

template <int D> void list_ports(Blocks<D>& blocks) {
    auto& ports = blocks.ports;
    ports.clear();
    std::uint32_t responses = 0;
    for (std::uint32_t b = 0; b < blocks.attached_trees.size(); ++b) {
        auto& block = blocks.attached_trees[b];
        block.first_port = std::uint32_t(ports.list.size());
        block.first_response = responses;
        responses += block.ports * block.ports;
        for (std::uint32_t p = 0; p < block.ports; ++p) {
            const auto node = blocks.links[first_tether(block, p)].a;
            ports.list.push_back(
                {.node = node, .block = b, .number = p, .radius = 0.5 * shortest_link(blocks, block, node)});
        }
    }
    ports.responses.resize(responses);
}

/// Components whose links have come to be at ports, or are no longer, are laid out again.
template <int D, class Real> void mark_ports(World<D, Real>& world, Solver<D, Real>& solver) {
    auto& blocks = solver.blocks;
    auto& ports = blocks.ports;
    const auto& handles = world.particles.handles;
    ports.at.assign(world.particles.size(), ports.none);
    for (std::uint32_t p = 0; p < ports.list.size(); ++p) ports.at[blocks.nodes[ports.list[p].node].row] = p;
    ports.is_port.resize(handles.indices(), 0);
    for (Row row = 0; row < world.particles.size(); ++row) {
        const char is_port = ports.at[row] != ports.none;
        char& was_port = ports.is_port[handles.index_of(row)];
        if (is_port != was_port) blocks.room.attached.push_back(row);
        was_port = is_port;
    }
}

/// Order by kind and row, independent of the history of the world. Distances come last, because their errors are
/// visible.
template <int D, class Real> void list_rows(World<D, Real>& world, Solver<D, Real>& solver) {
    auto& blocks = solver.blocks;
    auto& rows = blocks.ports.rows;
    rows.clear();
    for (const auto& port : blocks.ports.list)
        for_each_constraint(world, blocks.nodes[port.node].row, [&]<class Table>(const Table& table, Row row) {
            if (!blocks.holds(table, row)) rows.push_back({.kind = kind_of<World<D, Real>, Table>, .row = row});
        });
    sinew::sort(rows.begin(), rows.end(),
                [](const auto& a, const auto& b) { return std::pair(-a.kind, a.row) < std::pair(-b.kind, b.row); });
    const auto same = [](const auto& a, const auto& b) { return a.kind == b.kind && a.row == b.row; };
    rows.erase(std::unique(rows.begin(), rows.end(), same), rows.end());
}

template <int D, class Real> void mark_sheets(Solver<D, Real>& solver) {
    auto& ports = solver.blocks.ports;
    const auto& plan = solver.sweep_state.plan;
    ports.passes.assign(plan.components.size(), 0);
    for (const auto& port : ports.list)
        if (const auto* component =
                detail::sheet_at(plan, solver.sweep_state.slot_of[solver.blocks.nodes[port.node].row]))
            ports.passes[std::size_t(component - plan.components.data())] = 2;
}

/// More passes over held components without tethers. Tethers bring the pull of a pin to all of a mesh at once; without
/// them nothing but the ports holds the mesh, from link to link.
template <int D, class Real> void pass_more_often(Solver<D, Real>& solver) {
    constexpr char often = 6;
    auto& ports = solver.blocks.ports;
    const auto& plan = solver.sweep_state.plan;
    for (const auto& group : ports.groups) {
        if (group.anchors == 0) continue;
        for (const Row slot : std::span(ports.members).subspan(group.first, group.members)) {
            const auto* component = detail::sheet_at(plan, slot);
            if (!component || component->tethers > 0) continue;
            auto& passes = ports.passes[std::size_t(component - plan.components.data())];
            if (passes > 0) passes = often;
        }
    }
}

/// Connected components with ports, those of held jellies, and all others that hang on the same pins: an energy limit
/// holds for all of a figure. Immovable particles do not connect.
template <int D, class Real> class GroupFinder {
  public:
    GroupFinder(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), solver_(solver), ports_(solver.blocks.ports) {}

    void run() {
        ports_.clear_groups();
        ports_.reached.assign(world_.particles.size(), 0);
        for (const auto& port : ports_.list) add_group(solver_.blocks.nodes[port.node].row);
        for_each_table(world_, [&](const auto& table) { add_jellies(table); });
        for (std::uint32_t a = 0; a < ports_.anchors.size(); ++a)
            for_each_constraint(world_, solver_.sweep_state.row_of[ports_.anchors[a]],
                                [&](const auto& table, Row constraint) {
                                    for (const Row member : table.members[constraint]) add_group(member);
                                });
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    Ports<D>& ports_;

    template <class Column> static std::uint32_t size(const Column& column) { return std::uint32_t(column.size()); }

    /// Adds the components that a pin holds and an area or volume fills: the sweep alone gains energy there.
    template <class Table> void add_jellies(const Table& table) {
        using Kind = typename Table::Kind;
        if constexpr (std::is_same_v<Kind, Area<D>> || std::is_same_v<Kind, Volume<D>>)
            for (Row constraint = 0; constraint < table.size(); ++constraint) {
                if (detail::BlockGraph<D, Real>::is_fold(table, constraint)) continue;
                for (const Row member : table.members[constraint])
                    if (add_group(member) && ports_.groups.back().anchors == 0) forget_last_group();
            }
    }
    void forget_last_group() {
        const auto& group = ports_.groups.back();
        ports_.members.resize(group.first);
        ports_.springs.resize(group.first_spring);
        ports_.anchors.resize(group.first_anchor);
        ports_.groups.pop_back();
    }

    /// Adds the component of a swept particle. False if there is none, or if it is listed already.
    bool add_group(Row row) {
        if (ports_.reached[row] || !mobile(row) || solver_.sweep_state.slot_of[row] == Ports<D>::none) return false;
        ports_.groups.push_back({.first = size(ports_.members),
                                 .first_spring = size(ports_.springs),
                                 .first_anchor = size(ports_.anchors)});
        visit(row);
        spread();
        end_group();
        return true;
    }

    void visit(Row row) {
        if (std::exchange(ports_.reached[row], char(1))) return;
        SINEW_ASSERT(solver_.sweep_state.slot_of[row] != Ports<D>::none, "particles around a port have slots");
        (mobile(row) ? ports_.members : ports_.anchors).push_back(solver_.sweep_state.slot_of[row]);
    }
    void spread() {
        auto& group = ports_.groups.back();
        for (auto next = group.first; next < ports_.members.size(); ++next) {
            const Row row = solver_.sweep_state.row_of[ports_.members[next]];
            for_each_constraint(world_, row, [&]<class Table>(const Table& table, Row constraint) {
                constexpr int kind = kind_of<World<D, Real>, Table>;
                visit(group, kind, table, constraint, row);
                if (kind == kind_number<Distance, D>) measure(double(table.high(constraint)));
            });
        }
    }
    void measure(double length) {
        auto& longest = ports_.groups.back().length;
        if (length < double(limit::coordinate<Real>)) longest = max(longest, length);
    }
    /// Sorted: sums over a group must not depend on the order of the search, which depends on the past of the world.
    void end_group() {
        auto& group = ports_.groups.back();
        const auto by_row = [](const PortRow& a, const PortRow& b) {
            return std::tie(a.kind, a.row) < std::tie(b.kind, b.row);
        };
        sinew::sort(ports_.members.begin() + group.first, ports_.members.end());
        sinew::sort(ports_.anchors.begin() + group.first_anchor, ports_.anchors.end());
        sinew::sort(ports_.springs.begin() + group.first_spring, ports_.springs.end(), by_row);
        group.members = size(ports_.members) - group.first;
        group.springs = size(ports_.springs) - group.first_spring;
        group.anchors = size(ports_.anchors) - group.first_anchor;
        for (const Row slot : std::span(ports_.anchors).subspan(group.first_anchor))
            ports_.reached[solver_.sweep_state.row_of[slot]] = 0; // a pin may hold several groups
    }
    bool mobile(Row row) const { return world_.particles.mobility[row] > Real(0); }
    /// `from` is one of the mobile members; the first of them lists the constraint.
    template <class Table> void visit(PortGroup<D>& group, int kind, const Table& table, Row constraint, Row from) {
        const auto members = table.members[constraint];
        for (const Row member : members) visit(member);
        group.motorized = group.motorized || table.motorized[constraint] || table.gives(constraint);
        const bool first =
            std::none_of(members.begin(), members.end(), [&](Row row) { return row < from && mobile(row); });
        if (first && !table.is_rigid(constraint)) ports_.springs.push_back({.kind = kind, .row = constraint});
    }
};

} // namespace

template <int D, class Real> void find_ports(World<D, Real>& world, Solver<D, Real>& solver) {
    auto& blocks = solver.blocks;
    const bool had_any = !blocks.ports.list.empty();
    if (blocks.attached_trees.empty() && !had_any) return;
    for (auto& block : blocks.attached_trees) detail::look_up_rows(world, blocks, block);
    list_ports(blocks);
    mark_ports(world, solver);
}

template <int D, class Real> void tie_ports(World<D, Real>& world, Solver<D, Real>& solver) {
    auto& blocks = solver.blocks;
    if (!blocks.attached_trees.empty()) {
        list_rows(world, solver);
        mark_sheets(solver);
        const detail::LoadTethers<D, Real> tethers(world, solver);
        for (const auto& block : blocks.attached_trees)
            for (std::uint32_t p = 0; p < block.ports; ++p)
                tethers.set_anchors(std::span(blocks.links).subspan(first_tether(block, p), max_tethers));
    }
    GroupFinder<D, Real>(world, solver).run();
    if (blocks.ports.groups.empty()) return;
    world.particles.energy_debt.set_apart(); // a step allocates nothing
    if (!blocks.ports.list.empty()) pass_more_often(solver);
    blocks.ports.free_moves.resize(solver.sweep_state.size());
    blocks.ports.last_displacements.resize(solver.sweep_state.size());
    blocks.ports.mobilities.resize(solver.sweep_state.size());
}

#define SINEW_PORTS(D, Real)                                                                                           \
    template void find_ports(World<D, Real>&, Solver<D, Real>&);                                                       \
    template void tie_ports(World<D, Real>&, Solver<D, Real>&);
SINEW_INSTANTIATE(SINEW_PORTS)

} // namespace sinew
