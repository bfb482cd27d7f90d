#pragma once

#include "sinew/world/world.h"

/// The graph of a world: particles by constraint are a table's `members`; constraints by particle are listed once
/// (journal.h), kept by every change, and read here.
namespace sinew {

/// Index of a table's kind in the list of kinds.
template <class WorldT, class Table>
inline constexpr int kind_of = Kinds<WorldT::dimension>::template index_of<typename Table::Kind>;

/// Calls visit(table, row) for each constraint of a particle, in the order of addition.
template <class WorldT, class Visit> void for_each_constraint(WorldT& world, Row particle, Visit&& visit) {
    world.journal.adjacency.each(world.particles.handles.index_of(particle), [&](int kind, std::uint32_t slot) {
        visit_table(world, kind, [&](auto& table) { visit(table, table.handles.row_at(slot)); });
    });
}

/// Calls visit(row) for each constraint of a particle of the kind of `table`, in the order of addition.
template <class WorldT, class Table, class Visit>
void for_each_row(const WorldT& world, const Table& table, Row particle, Visit&& visit) {
    world.journal.adjacency.each(world.particles.handles.index_of(particle), [&](int kind, std::uint32_t slot) {
        if (kind == kind_of<WorldT, Table>) visit(table.handles.row_at(slot));
    });
}

/// Calls visit(link, other end) for each distance of a particle, in the order of addition.
template <int D, class Real, class Visit> void for_each_link(const World<D, Real>& world, Row particle, Visit&& visit) {
    const auto& links = std::get<kind_number<Distance, D>>(world.constraints);
    for_each_row(world, links, particle, [&](Row link) {
        const auto& ends = links.members.rows[link];
        visit(link, ends[0] == particle ? ends[1] : ends[0]);
    });
}

} // namespace sinew
