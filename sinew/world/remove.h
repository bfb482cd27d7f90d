#pragma once

#include "sinew/assert/assert.h"
#include "sinew/world/changes.h"

#include <algorithm>

/// Removing rows of a world. Nothing here allocates: constraints tear in the middle of a step.
namespace sinew::detail {

/// Removes rows of kind number `kind` from the sweep: runs shrink, their order stays.
inline void erase_from_sweep(std::vector<Run>& sweep, int kind, std::span<const char> gone) {
    Row row = 0;
    for (auto& run : sweep) {
        if (run.kind != kind) continue;
        const Row end = row + run.count;
        for (auto i = next_flag(gone, row, 1); i < end; i = next_flag(gone, i + 1, 1)) --run.count;
        row = end;
    }
    SINEW_ASSERT(row == gone.size(), "the sweep lists every row of a table once");
    std::erase_if(sweep, [](const Run& run) { return run.count == 0; });
}

template <int D, class Real, class Table>
void erase_constraints(World<D, Real>& world, Table& table, int kind, std::span<const char> gone) {
    for (auto row = next_flag(gone, 0, 1); row < gone.size(); row = next_flag(gone, row + 1, 1))
        for (const Row member : table.members[Row(row)]) note_member_gone(world, table, kind, Row(row), member);
    note_rows(world);
    erase_from_sweep(world.sweep, kind, gone);
    table.members.erase(gone);
    table.handles.erase(gone);
    erase_rows(table, gone);
}

template <int D, class Real> void erase_pins(World<D, Real>& world, std::span<const char> gone) {
    note_rows(world);
    erase_rows(world.pins, gone);
    world.pin_handles.erase(gone);
    SINEW_ASSERT(world.pins.empty() || world.pin_handles.in_use(world.pin_handles.index_of(Row(world.pins.size() - 1))),
                 "every pin has an id");
}

/// Removes the names of removed constraints from the figures. The figures' lists of constraints stay: names by number
/// are indices into the lists.
template <int D, class Real> void forget_constraints(World<D, Real>& world) {
    const auto dead = [&](const ConstraintId& id) {
        bool found = false;
        visit_table(world, id.kind, [&](const auto& table) { found = table.handles.find(id.id).has_value(); });
        return !found;
    };
    for (auto& figure : world.figures) figure.constraint_names.erase_if(dead);
}

/// As forget_constraints, and for names of particles and for pieces, too.
template <int D, class Real> void forget_the_dead(World<D, Real>& world) {
    forget_constraints(world);
    const auto dead = [&](ParticleId id) { return !world.particles.handles.find(id); };
    for (auto& figure : world.figures) {
        figure.particle_names.erase_if(dead);
        std::erase_if(figure.pieces, [&](const Piece& piece) {
            return std::any_of(piece.particles.begin(), piece.particles.end(), dead);
        });
    }
}

} // namespace sinew::detail
