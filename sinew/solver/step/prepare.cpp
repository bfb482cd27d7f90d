#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/phases.h"
#include "sinew/world/stencil.h"

#include <algorithm>

namespace sinew {
namespace {

/// Reserves for every state within reach of tears: a tearing thread must not make a step allocate.
template <int D, class Real> void reserve_for_tears(World<D, Real>& world, Solver<D, Real>& solver) {
    const auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    bool any = false;
    std::size_t max = 0;
    for_each_table(world, [&](const auto& table) {
        any = any || table.may_tear();
        max = std::max(max, table.size());
    });
    if (any) solver.torn.reserve(max);
    constexpr std::size_t small = 100'000; // distances; of more, the room would be waste
    if (!distances.may_tear() || distances.size() > small) return;
    solver.blocks.reserve(world.particles.size(), distances.size(),
                          std::get<kind_number<Angle, D>>(world.constraints).size());
}

} // namespace

template <int D, class Real> void Solver<D, Real>::prepare(World<D, Real>& world) {
    auto& journal = world.journal;
    follow(world);
    if (!journal.changed && !journal.stale) return;
    detail::make_room_for_widest(world, scratch);
    if (world.settings.mode == Mode::classic) stays.reserve(world.particles.size());
    reserve_for_tears(world, *this);
    list_bodies(world, *this);
    find_wind_areas(world, *this);
    report(0);
    const bool anew = find_blocks(world, *this);
    find_ports(world, *this);
    report(0.2);
    make_plan(world, *this, anew);
    tie_ports(world, *this);
    find_free_bodies(world, *this);
    find_rollers(world, *this);
    make_energy_room(world, *this);
    if (contacts) contacts->is_stale = true;
    journal.read();
    report(1);
}

#define SINEW_PREPARE(D, Real) template void Solver<D, Real>::prepare(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_PREPARE)

} // namespace sinew
