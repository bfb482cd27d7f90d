#include "sinew/world/edit.h"

#include "sinew/assert/assert.h"
#include "sinew/world/mobility.h"
#include "sinew/world/remove.h"
#include "sinew/world/stencil.h"

#include <algorithm>
#include <iterator>

namespace sinew {
template <int D, class Real> std::size_t remove_particles(World<D, Real>& world, std::span<const ParticleId> ids) {
    auto& particles = world.particles;
    std::vector<char> gone(particles.size(), 0);
    for (const auto id : ids)
        if (const auto row = particles.handles.find(id)) gone[*row] = 1;
    const auto count = std::size_t(std::count(gone.begin(), gone.end(), char(1)));
    if (count == 0) return 0;

    std::vector<Row> moved(particles.size());
    Row kept = 0;
    for (Row row = 0; row < gone.size(); ++row) moved[row] = gone[row] ? kept : kept++;

    int kind = 0;
    for_each_table(world, [&](auto& table) {
        std::vector<char> broken(table.size(), 0);
        for (Row row = 0; row < table.size(); ++row) {
            const auto members = table.members[row];
            broken[row] = std::any_of(members.begin(), members.end(), [&](Row member) { return gone[member] != 0; });
        }
        detail::erase_constraints(world, table, kind++, broken);
        for (Row row = 0; row < table.size(); ++row)
            for (auto& member : table.members[row]) {
                SINEW_ASSERT(!gone[member], "a constraint goes with its particles");
                member = moved[member];
            }
    });

    detail::note_rows(world);
    erase_rows(particles, gone);
    particles.handles.erase(gone);
    SINEW_ASSERT(particles.size() == kept, "the particles that are kept remain");

    std::vector<char> loose(world.pins.size(), 0);
    for (std::size_t i = 0; i < loose.size(); ++i) loose[i] = !particles.handles.find(world.pins[i].particle);
    detail::erase_pins(world, loose);
    detail::forget_the_dead(world);
    return count;
}

template <int D, class Real> std::size_t remove_constraints(World<D, Real>& world, std::span<const ConstraintId> ids) {
    int kind = 0;
    std::size_t count = 0;
    for_each_table(world, [&](auto& table) {
        const auto before = table.size();
        std::vector<char> gone;
        for (const auto& id : ids)
            if (id.kind == kind)
                if (const auto row = table.handles.find(id.id)) gone.resize(before, 0), gone[*row] = 1;
        if (!gone.empty()) detail::erase_constraints(world, table, kind, gone);
        count += before - table.size();
        ++kind;
    });
    if (count > 0) detail::forget_constraints(world);
    return count;
}

namespace {

template <class Real> constexpr bool is_no_number(Real value) {
    return value != value;
}

} // namespace

namespace {

/// True if another rigid constraint of the table holds the same members, in this order or the reverse.
template <class Table> bool has_rigid_twin(const Table& table, Row row) {
    const auto members = table.members[row];
    for (Row other = 0; other < table.size(); ++other) {
        if (other == row || !table.is_rigid(other) || table.gives(other)) continue;
        const auto others = table.members[other];
        if (std::equal(members.begin(), members.end(), others.begin(), others.end()) ||
            std::equal(members.begin(), members.end(), std::make_reverse_iterator(others.end()),
                       std::make_reverse_iterator(others.begin())))
            return true;
    }
    return false;
}

} // namespace

template <int D, class Real> bool drive(World<D, Real>& world, const ConstraintId& id, Real rate) {
    if (is_no_number(rate)) return false;
    bool found = false;
    visit_table(world, id.kind, [&](auto& table) {
        const auto row = table.handles.find(id.id);
        if (!row) return;
        const bool is_absolute = table.is_rigid(*row) && !table.gives(*row);
        if (!table.motorized[*row] && is_absolute && has_rigid_twin(table, *row)) return;
        found = true;
        if (!table.motorized[*row]) detail::note_feature(world, table, *row);
        table.motorized.set(*row, 1);
        table.motor_speed.set(*row, clamp(rate, -limit::speed<Real>, limit::speed<Real>));
    });
    return found;
}

template <int D, class Real> bool set_max_force(World<D, Real>& world, const ConstraintId& id, Real max_force) {
    if (is_no_number(max_force)) return false;
    bool found = false;
    visit_table(world, id.kind, [&](auto& table) {
        const auto row = table.handles.find(id.id);
        if (!row) return;
        found = true;
        const bool gave = table.gives(*row);
        table.max_force.set(*row, clamp(max_force, Real(0), limit::measure<Real>));
        if (table.gives(*row) != gave) detail::note_feature(world, table, *row);
    });
    return found;
}

namespace {

/// Calls change(table, row) for a constraint, whose method of solution may be another one afterwards.
template <int D, class Real, class Change>
bool change_constraint(World<D, Real>& world, const ConstraintId& id, Change&& change) {
    bool found = false;
    visit_table(world, id.kind, [&](auto& table) {
        const auto row = table.handles.find(id.id);
        if (!row) return;
        found = change(table, *row);
        if (found) detail::note_feature(world, table, *row);
    });
    return found;
}

/// Sets a bound beyond which a constraint tears, in the column column(table).
template <int D, class Real, class ColumnOf>
bool set_strength(World<D, Real>& world, const ConstraintId& id, Real bound, ColumnOf&& column) {
    if (is_no_number(bound)) return false;
    const bool found = change_constraint(world, id, [&](auto& table, Row row) {
        column(table).set(row, clamp(bound, Real(0), limit::measure<Real>));
        return true;
    });
    if (found && bound < limit::measure<Real>) for_each_table(world, [](auto& table) { table.expect_tears(); });
    return found;
}

} // namespace

template <int D, class Real>
bool set_limits(World<D, Real>& world, const ConstraintId& id, const Interval<Real>& limits) {
    if (is_no_number(limits.low) || is_no_number(limits.high)) return false;
    constexpr auto max = limit::measure<Real>;
    return change_constraint(world, id, [&](auto& table, Row row) {
        if (!detail::are_possible<typename std::decay_t<decltype(table)>::Kind>(limits.low, limits.high)) return false;
        const Real low = clamp(limits.low, -max, max);
        table.limits.set(row, low, clamp(limits.high, low, max));
        table.multiplier[row] = 0; // of the old limits
        return true;
    });
}

template <int D, class Real> bool set_compliance(World<D, Real>& world, const ConstraintId& id, Real compliance) {
    if (is_no_number(compliance)) return false;
    return change_constraint(world, id, [&](auto& table, Row row) {
        table.compliance.set(row, clamp(compliance, Real(0), limit::measure<Real>));
        return true;
    });
}

template <int D, class Real> bool set_breaking_strain(World<D, Real>& world, const ConstraintId& id, Real strain) {
    return set_strength(
        world, id, strain, [](auto& table) -> auto& { return table.breaking_strain; });
}

template <int D, class Real> bool set_break_force(World<D, Real>& world, const ConstraintId& id, Real force) {
    return set_strength(
        world, id, force, [](auto& table) -> auto& { return table.break_force; });
}

template <int D, class Real> std::optional<Vec<D, Real>> position_of(const World<D, Real>& world, ParticleId id) {
    const auto row = world.particles.handles.find(id);
    return row ? std::optional(world.particles.position[*row]) : std::nullopt;
}

template <int D, class Real> std::optional<Vec<D, Real>> velocity_of(const World<D, Real>& world, ParticleId id) {
    const auto row = world.particles.handles.find(id);
    return row ? std::optional(world.particles.velocity[*row]) : std::nullopt;
}

template <int D, class Real> bool set_position(World<D, Real>& world, ParticleId id, const Vec<D, Real>& position) {
    const auto row = world.particles.handles.find(id);
    if (!row) return false;
    auto& p = world.particles;
    constexpr auto furthest = limit::coordinate<Real>;
    const auto clamped = clamp_finite(position, furthest);
    const auto previous = clamped + (p.previous[*row] - p.position[*row]); // keeps the velocity of classic mode
    p.previous[*row] = clamp_finite(previous, furthest);
    p.position[*row] = clamped;
    p.residual[*row] = {};
    return true;
}

template <int D, class Real> bool set_velocity(World<D, Real>& world, ParticleId id, const Vec<D, Real>& velocity) {
    const auto row = world.particles.handles.find(id);
    if (!row) return false;
    auto& p = world.particles;
    p.velocity[*row] = clamp_finite(velocity, limit::speed<Real>);
    p.previous[*row] =
        clamp_finite(p.position[*row] - p.velocity[*row] * verlet_interval(world), limit::coordinate<Real>);
    return true;
}

template <int D, class Real> bool set_spin(World<D, Real>& world, ParticleId id, const Vec<spins<D>, Real>& spin) {
    const auto row = world.particles.handles.find(id);
    if (!row || !is_finite(spin)) return false;
    world.particles.spin.set(*row, clamp_components(spin, limit::speed<Real>));
    return true;
}

template <int D, class Real> bool set_mass(World<D, Real>& world, ParticleId id, Real mass) {
    const auto row = world.particles.handles.find(id);
    if (!row) return false;
    world.particles.inverse_mass[*row] = inverse_of_mass(mass);
    detail::refresh_mobility(world, *row);
    detail::note_weight(world, *row);
    return true;
}

template <int D, class Real> bool set_radius(World<D, Real>& world, ParticleId id, Real radius) {
    const auto row = world.particles.handles.find(id);
    if (!row || is_no_number(radius)) return false;
    world.particles.radius[*row] = clamp(radius, Real(0), limit::coordinate<Real>);
    world.journal.touch(world.particles.handles.index_of(*row), Touch::joined);
    return true;
}

template <int D, class Real> bool apply_force(World<D, Real>& world, ParticleId id, const Vec<D, Real>& force) {
    const auto row = world.particles.handles.find(id);
    if (!row) return false;
    constexpr auto max = limit::force<Real>;
    auto& sum = world.particles.force[*row];
    sum = clamp_finite(sum + clamp_finite(force, max), max);
    return world.particles.any_force = true;
}

template <int D, class Real> bool apply_impulse(World<D, Real>& world, ParticleId id, const Vec<D, Real>& impulse) {
    const auto row = world.particles.handles.find(id);
    if (!row) return false;
    const auto& p = world.particles;
    const Real per_mass = p.mobility[*row] > Real(0) ? p.inverse_mass[*row] : Real(0);
    const Real max = Real(2) * limit::speed<Real> * inverse_or_zero(per_mass); // reverses the largest speed
    return set_velocity(world, id, p.velocity[*row] + clamp_finite(impulse, max) * per_mass);
}

namespace {

/// Removes the rigid pin of a particle, which a new pin takes over.
template <int D, class Real> void remove_rigid_pin(World<D, Real>& world, ParticleId particle, Row row) {
    if (world.particles.mobility[row] > Real(0)) return;
    std::vector<char> gone(world.pins.size(), 0);
    for (std::size_t i = 0; i < gone.size(); ++i) gone[i] = world.pins[i].particle == particle && world.pins[i].hard();
    if (std::ranges::find(gone, char(1)) == gone.end()) return;
    detail::erase_pins(world, gone);
    detail::refresh_mobility(world, row);
}

} // namespace

template <int D, class Real>
std::optional<PinId> pin(World<D, Real>& world, ParticleId particle, const PinSpec<D, Real>& spec) {
    const auto row = world.particles.handles.find(particle);
    if (!row) return std::nullopt;
    remove_rigid_pin(world, particle, *row);
    const auto position = world.particles.position[*row];
    constexpr auto max = limit::measure<Real>;
    world.pins.push_back({.particle = particle,
                          .from = position,
                          .target = clamp_finite(spec.target.value_or(position), limit::coordinate<Real>),
                          .compliance = clamp(spec.compliance, Real(0), max),
                          .damping = clamp(spec.damping, Real(0), max),
                          .max_force = clamp(spec.max_force, Real(0), max),
                          .hold = spec.hold,
                          .steer = clamp_components(spec.steer, max),
                          .steer_damping = clamp(spec.steer_damping, Real(0), max)});
    if (world.pins.back().hard() && world.particles.mobility[*row] > Real(0)) {
        world.particles.mobility[*row] = Real(0);
        detail::note_mobility(world, *row);
    }
    detail::note_rows(world);
    return world.pin_handles.append();
}

template <int D, class Real> bool move_pin(World<D, Real>& world, PinId pin, const Vec<D, Real>& target) {
    const auto row = world.pin_handles.find(pin);
    if (!row) return false;
    world.pins[*row].target = clamp_finite(target, limit::coordinate<Real>);
    return true;
}

template <int D, class Real> bool unpin(World<D, Real>& world, PinId pin) {
    const auto row = world.pin_handles.find(pin);
    if (!row) return false;
    const auto particle = world.pins[*row].particle;
    std::vector<char> gone(world.pins.size(), 0);
    gone[*row] = 1;
    detail::erase_pins(world, gone);
    if (const auto held = world.particles.handles.find(particle)) detail::refresh_mobility(world, *held);
    return true;
}

template <int D, class Real> std::size_t unpin_all(World<D, Real>& world, ParticleId particle) {
    const auto before = world.pins.size();
    std::vector<char> gone(before, 0);
    for (std::size_t i = 0; i < gone.size(); ++i) gone[i] = world.pins[i].particle == particle;
    detail::erase_pins(world, gone);
    if (const auto row = world.particles.handles.find(particle)) detail::refresh_mobility(world, *row);
    return before - world.pins.size();
}

#define SINEW_EDIT(D, Real)                                                                                            \
    template std::size_t remove_particles(World<D, Real>&, std::span<const ParticleId>);                               \
    template std::size_t remove_constraints(World<D, Real>&, std::span<const ConstraintId>);                           \
    template bool drive(World<D, Real>&, const ConstraintId&, Real);                                                   \
    template bool set_max_force(World<D, Real>&, const ConstraintId&, Real);                                           \
    template bool set_limits(World<D, Real>&, const ConstraintId&, const Interval<Real>&);                             \
    template bool set_compliance(World<D, Real>&, const ConstraintId&, Real);                                          \
    template bool set_breaking_strain(World<D, Real>&, const ConstraintId&, Real);                                     \
    template bool set_break_force(World<D, Real>&, const ConstraintId&, Real);                                         \
    template bool set_radius(World<D, Real>&, ParticleId, Real);                                                       \
    template std::optional<Vec<D, Real>> position_of(const World<D, Real>&, ParticleId);                               \
    template std::optional<Vec<D, Real>> velocity_of(const World<D, Real>&, ParticleId);                               \
    template bool set_position(World<D, Real>&, ParticleId, const Vec<D, Real>&);                                      \
    template bool set_velocity(World<D, Real>&, ParticleId, const Vec<D, Real>&);                                      \
    template bool set_spin(World<D, Real>&, ParticleId, const Vec<spins<D>, Real>&);                                   \
    template bool set_mass(World<D, Real>&, ParticleId, Real);                                                         \
    template bool apply_force(World<D, Real>&, ParticleId, const Vec<D, Real>&);                                       \
    template bool apply_impulse(World<D, Real>&, ParticleId, const Vec<D, Real>&);                                     \
    template std::optional<PinId> pin(World<D, Real>&, ParticleId, const PinSpec<D, Real>&);                           \
    template bool move_pin(World<D, Real>&, PinId, const Vec<D, Real>&);                                               \
    template std::size_t unpin_all(World<D, Real>&, ParticleId);                                                       \
    template bool unpin(World<D, Real>&, PinId);

SINEW_INSTANTIATE(SINEW_EDIT)

} // namespace sinew
