#include "sinew/solver/phases.h"
#include "sinew/solver/turn.h"
#include "sinew/solver/world.h"

#include <algorithm>

namespace sinew {

namespace {

/// Whether a force acts on one of the particles of the sweep.
template <int D, class Real> bool any_force(const World<D, Real>& world) {
    const auto& p = world.particles;
    return p.any_force && std::any_of(world.swept.row_of.begin(), world.swept.row_of.end(),
                                      [&](Row row) { return p.force[row] != Vec<D, Real>{}; });
}

/// Copies lie one after the other, but are taken up across all of them, which no processor foresees: what is in memory
/// comes sooner when it is read as it lies, a number of each cache line.
template <int D, class Real, class... T>
void read_through(const Swept<D, Real>& swept, Row first, Row last, const std::vector<T>&... columns) {
    constexpr Row near = 4;
    constexpr std::size_t line = 64;
    if (last - first < 2 || swept.row_of[first + 1] <= swept.row_of[first] + near) return;
    const Row begin = swept.row_of[first], end = swept.row_of[last - 1] + 1;
    if (end - begin != last - first) return;
    const auto read = [&](const auto& column) {
        const volatile char* const bytes = reinterpret_cast<const char*>(column.data() + begin);
        for (std::size_t at = 0; at < (end - begin) * sizeof column[0]; at += line) (void)bytes[at];
    };
    (read(columns), ...);
}

} // namespace

template <int D, class Real> void begin_sweep(World<D, Real>& world, Real h) {
    auto& swept = world.swept;
    swept.per_h = Real(1) / h;
    swept.gravity = {};
    swept.everyone_alike = true;
    for (const auto& force : world.forces)
        if (const auto* gravity = std::get_if<Gravity<D, Real>>(&force))
            swept.gravity += clamp_components(gravity->acceleration, largest_acceleration<Real>);
        else if (!std::holds_alternative<RandomPush<D, Real>>(force))
            swept.everyone_alike = false;
    swept.gravity = clamp_components(swept.gravity, largest_acceleration<Real>);
    swept.any_force = any_force(world);
    swept.everyone_alike = swept.everyone_alike && !swept.any_force;
    swept.any_pin_moves = swept.any_pin_soft = false;
    for (const auto& pin : world.pins) {
        swept.any_pin_moves = swept.any_pin_moves || pin.from != pin.target;
        swept.any_pin_soft = swept.any_pin_soft || !pin.hard();
    }
    swept.largest_radius = 0;
    if (world.bounds.empty()) return;
    for (const Row row : swept.row_of)
        swept.largest_radius = maximum(swept.largest_radius, world.particles.radius[row]);
}

template <int D, class Real> void take_up(World<D, Real>& world, Real h, Row first, Row last) {
    const auto& p = world.particles;
    auto& swept = world.swept;
    if (first == last) return;
    const SlotRows slots{swept.row_of.data(), swept.slot_of.back()};
    const auto as_it_is = [](const auto& numbers) { return numbers; };
    const Real furthest = furthest_move(h);
    read_through(swept, first, last, p.position, p.residual, p.velocity, p.mobility, p.inverse_mass);
    to_columns<D, Real>(p.position, slots, first, last, swept.place, as_it_is);
    to_columns<D, Real>(p.residual, slots, first, last, swept.residual, as_it_is);
    to_columns<D, Real>(p.velocity, slots, first, last, swept.move, [&]<class V>(const V& velocity) {
        return lane::within(V(velocity * h), lane::spread<V>(furthest));
    });
    for (Row slot = first; slot < last; ++slot) {
        const Row row = swept.row_of[slot];
        swept.mobility[slot] = p.mobility[row] > Real(0) ? p.inverse_mass[row] : Real(0);
    }
}

template <int D, class Real> void put_back(World<D, Real>& world, Row first, Row last) {
    auto& p = world.particles;
    const auto& swept = world.swept;
    const Row* const row_of = swept.row_of.data();
    const auto as_it_is = [](const auto& numbers) { return numbers; };
    const auto per_h = swept.per_h;
    to_rows<D, Real>(swept.place, row_of, first, last, p.position, as_it_is);
    to_rows<D, Real>(swept.residual, row_of, first, last, p.residual, as_it_is);
    to_rows<D, Real>(swept.move, row_of, first, last, p.velocity,
                     [&]<class V>(const V& move) -> V { return move * per_h; });
    for (Row slot = first; slot < last; ++slot)
        if (Real& mobility = p.mobility[row_of[slot]]; mobility != swept.mobility[slot])
            mobility = swept.mobility[slot];
}

template <int D, class Real> void note_places(World<D, Real>& world, Row first, Row last) {
    read_through(world.swept, first, last, world.particles.previous);
    to_rows<D, Real>(world.swept.place, world.swept.row_of.data(), first, last, world.particles.previous,
                     [](const auto& numbers) { return numbers; });
}

#define SINEW_SWEPT(D, Real)                                                                                           \
    template void begin_sweep(World<D, Real>&, Real);                                                                  \
    template void take_up(World<D, Real>&, Real, Row, Row);                                                            \
    template void put_back(World<D, Real>&, Row, Row);                                                                 \
    template void note_places(World<D, Real>&, Row, Row);
SINEW_INSTANTIATE(SINEW_SWEPT)

} // namespace sinew
