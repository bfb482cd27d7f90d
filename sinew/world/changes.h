#pragma once

#include "sinew/assert/assert.h"
#include "sinew/world/world.h"

#include <optional>

/// Journal of changes between steps: the next step examines only the components of changed particles again
/// (direct/find_blocks.cpp). Particles are not recorded while Journal::stale, as in a new world or a copy: then
/// everything is examined.
namespace sinew::detail {

/// Lists the constraints of each particle, if not listed yet. On demand, since a large world may never need the list.
template <int D, class Real> void list_constraints(World<D, Real>& world) {
    auto& adjacency = world.journal.adjacency;
    if (adjacency.listed()) return;
    static_assert(Kinds<D>::size <= 1 << (32 - limit::row_bits), "a kind and a row are packed into 32 bits");
    const auto& particles = world.particles.handles;
    adjacency.reset(particles.indices());
    int kind = 0;
    for_each_table(world, [&](const auto& table) {
        for (Row row = 0; row < table.size(); ++row)
            for (const Row member : table.members[row])
                adjacency.add(particles.index_of(member), kind, table.handles.index_of(row));
        ++kind;
    });
}

/// Records the addition of the last particle.
template <int D, class Real> void note_particle(World<D, Real>& world) {
    auto& journal = world.journal;
    journal.change();
    const auto& handles = world.particles.handles;
    SINEW_ASSERT(world.particles.size() > 0, "a particle has been added");
    if (journal.adjacency.listed()) journal.adjacency.make_room(handles.indices());
    journal.touch(handles.index_of(Row(world.particles.size() - 1)), Touch::joined);
}

/// Records a particle becoming movable or immovable.
template <int D, class Real> void note_mobility(World<D, Real>& world, Row particle) {
    world.journal.touch(world.particles.handles.index_of(particle), Touch::mobility);
}

/// Records a change of mass, on which the plan of the sweep depends.
template <int D, class Real> void note_weight(World<D, Real>& world, Row particle) {
    world.journal.touch(world.particles.handles.index_of(particle), Touch::weight);
}

/// Records a change of a particle's constraints; calls update(adjacency, particle) where the list has to follow.
template <int D, class Real, class Update> void note_member_change(World<D, Real>& world, Row member, Update&& update) {
    auto& journal = world.journal;
    journal.change();
    if (journal.stale && !journal.adjacency.listed()) return;
    const auto particle = world.particles.handles.index_of(member);
    if (journal.adjacency.listed()) update(journal.adjacency, particle);
    journal.touch(particle, Touch::joined);
}

/// Records a particle as a new member of a constraint.
template <int D, class Real, class Table>
void note_member(World<D, Real>& world, const Table& table, int kind, Row row, Row member) {
    note_member_change(world, member, [&](auto& adjacency, std::uint32_t particle) {
        adjacency.add(particle, kind, table.handles.index_of(row));
    });
}

/// Records a particle as a member no longer.
template <int D, class Real, class Table>
void note_member_gone(World<D, Real>& world, const Table& table, int kind, Row row, Row member) {
    note_member_change(world, member, [&](auto& adjacency, std::uint32_t particle) {
        if (adjacency.remove(particle, kind, table.handles.index_of(row))) return;
        adjacency.forget();
        world.journal.stale = true;
    });
}

/// Records a constraint with a new method of solution.
template <int D, class Real, class Table> void note_feature(World<D, Real>& world, const Table& table, Row row) {
    for (const Row member : table.members[row])
        world.journal.touch(world.particles.handles.index_of(member), Touch::joined);
}

/// Records the compaction of rows, or added or removed pins.
template <int D, class Real> void note_rows(World<D, Real>& world) {
    world.journal.change();
    ++world.journal.row_moves;
}

} // namespace sinew::detail
