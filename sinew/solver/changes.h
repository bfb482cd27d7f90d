#pragma once

#include "sinew/solver/world.h"

/// What the blocks are told of changes between steps, so that they look again only at what hangs together with what has
/// changed (block_find.cpp). Nothing of this is kept of a world that has not moved yet: all of it is new to them.
namespace sinew::detail {

/// What joins each particle, where that is not known: in a large world nobody may have asked yet.
template <int D, class Real> void list_bonds(World<D, Real>& world) {
    auto& bonds = world.blocks.bonds;
    if (bonds.listed()) return;
    const auto& particles = world.particles.slots;
    bonds.reset(particles.slots());
    int kind = 0;
    for_each_table(world, [&](const auto& table) {
        for (Row row = 0; row < table.size(); ++row)
            for (const Row member : table.members[row])
                bonds.add(particles.slot_of(member), kind, table.slots.slot_of(row));
        ++kind;
    });
}

/// A particle was added, the last.
template <int D, class Real> void note_particle(World<D, Real>& world) {
    auto& blocks = world.blocks;
    blocks.changed = true;
    if (blocks.stale) return;
    const auto& slots = world.particles.slots;
    if (blocks.bonds.listed()) blocks.bonds.make_room(slots.slots());
    blocks.touch(slots.slot_of(Row(world.particles.size() - 1)), Touch::joined);
}

/// Whether it can move.
template <int D, class Real> void note_mobility(World<D, Real>& world, Row particle) {
    world.blocks.touch(world.particles.slots.slot_of(particle), Touch::mobility);
}

/// What it weighs, or that it is pinned hard: the plan of the sweep knows that.
template <int D, class Real> void note_weight(World<D, Real>& world, Row particle) {
    world.blocks.touch(world.particles.slots.slot_of(particle), Touch::weight);
}

/// A particle is part of a constraint from now on.
template <int D, class Real, class Table>
void note_member(World<D, Real>& world, const Table& table, int kind, Row row, Row member) {
    auto& blocks = world.blocks;
    blocks.changed = true;
    if (blocks.stale) return;
    const auto particle = world.particles.slots.slot_of(member);
    if (blocks.bonds.listed()) blocks.bonds.add(particle, kind, table.slots.slot_of(row));
    blocks.touch(particle, Touch::joined);
}

/// It is so no longer.
template <int D, class Real, class Table>
void note_member_gone(World<D, Real>& world, const Table& table, int kind, Row row, Row member) {
    auto& blocks = world.blocks;
    blocks.changed = true;
    if (blocks.stale) return;
    const auto particle = world.particles.slots.slot_of(member);
    blocks.stale = blocks.bonds.listed() && !blocks.bonds.remove(particle, kind, table.slots.slot_of(row));
    blocks.touch(particle, Touch::joined);
}

/// A constraint is solved in another way from now on.
template <int D, class Real, class Table> void note_feature(World<D, Real>& world, const Table& table, Row row) {
    for (const Row member : table.members[row])
        world.blocks.touch(world.particles.slots.slot_of(member), Touch::joined);
}

/// Rows have closed up, or pins have come or gone.
template <int D, class Real> void note_rows(World<D, Real>& world) {
    world.blocks.changed = true;
    ++world.blocks.row_moves;
}

} // namespace sinew::detail
