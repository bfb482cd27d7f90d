#pragma once

#include "sinew/solver/world.h"

/// What the blocks are told of changes between steps, so that they look again only at what hangs together with what has
/// changed (block_find.cpp). Nothing of this is kept of a world that has not moved yet: all of it is new to them.
namespace sinew::detail {

/// A particle was added, the last.
template <int D, class Real> void note_particle(World<D, Real>& world) {
    auto& blocks = world.blocks;
    blocks.changed = true;
    if (blocks.stale) return;
    const auto& slots = world.particles.slots;
    blocks.bonds.make_room(slots.slots());
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
    blocks.bonds.add(particle, kind, table.slots.slot_of(row));
    blocks.touch(particle, Touch::joined);
}

/// It is so no longer.
template <int D, class Real, class Table>
void note_member_gone(World<D, Real>& world, const Table& table, int kind, Row row, Row member) {
    auto& blocks = world.blocks;
    blocks.changed = true;
    if (blocks.stale) return;
    const auto particle = world.particles.slots.slot_of(member);
    blocks.stale = !blocks.bonds.remove(particle, kind, table.slots.slot_of(row));
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
