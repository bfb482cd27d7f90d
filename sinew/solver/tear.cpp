#include "sinew/solver/edit.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/remove.h"

namespace sinew {

template <int D, class Real> void tear(World<D, Real>& world) {
    bool any = false;
    int kind = 0;
    for_each_table(world, [&](auto& table) {
        bool torn = false;
        for (Row row = 0; row < table.size(); ++row) {
            if (table.breaking_strain[row] >= limit::measure<Real> || world.events.size() >= events_per_step) continue;
            const ConstraintId id{kind, table.slots.id_of(row)};
            const auto state = constraint_state(world, id);
            if (absolute(state->strain) <= double(table.breaking_strain[row])) continue;
            table.torn[row] = 1;
            torn = true;
            world.events.push_back({.type = EventType::torn, .figure = table.figure[row], .constraint = id});
        }
        if (torn) detail::erase_constraints(world, table, kind, table.torn);
        any = any || torn;
        ++kind;
    });
    if (any) detail::forget_the_dead(world);
}

#define SINEW_TEAR(D, Real) template void tear(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_TEAR)

} // namespace sinew
