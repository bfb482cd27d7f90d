#include "sinew/solver/edit.h"

#include "sinew/solver/remove.h"

#include <algorithm>

namespace sinew {
namespace {

/// Pinned hard and quarantined particles are immovable to the solver; the others weigh what they weigh.
template <int D, class Real> void refresh_mobility(World<D, Real>& world, Row row) {
    auto& particles = world.particles;
    const auto id = particles.slots.id_of(row);
    const bool pinned = std::any_of(world.pins.begin(), world.pins.end(),
                                    [&](const auto& pin) { return pin.particle == id && pin.hard(); });
    const Real mobility = pinned || particles.quarantined[row] ? Real(0) : particles.inverse_mass[row];
    if ((mobility > Real(0)) != (particles.mobility[row] > Real(0))) detail::note_mobility(world, row);
    particles.mobility[row] = mobility;
}

} // namespace

template <int D, class Real> void remove_particles(World<D, Real>& world, std::span<const ParticleId> ids) {
    auto& particles = world.particles;
    std::vector<char> gone(particles.size(), 0);
    for (const auto id : ids)
        if (const auto row = particles.slots.find(id)) gone[*row] = 1;

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
            for (auto& member : table.members[row]) member = moved[member];
    });

    detail::note_rows(world);
    erase_rows(particles, gone);
    particles.slots.erase(gone);

    std::vector<char> loose(world.pins.size(), 0);
    for (std::size_t i = 0; i < loose.size(); ++i) loose[i] = !particles.slots.find(world.pins[i].particle);
    detail::erase_pins(world, loose);
    detail::forget_the_dead(world);
}

template <int D, class Real> void remove_constraints(World<D, Real>& world, std::span<const ConstraintId> ids) {
    int kind = 0;
    for_each_table(world, [&](auto& table) {
        bool any = false;
        for (const auto& id : ids)
            if (id.kind == kind)
                if (const auto row = table.slots.find(id.id)) table.torn.set(*row, 1), any = true;
        if (any) detail::erase_constraints(world, table, kind, table.torn.each());
        ++kind;
    });
    detail::forget_constraints(world);
}

template <int D, class Real> bool drive(World<D, Real>& world, const ConstraintId& id, Real rate) {
    bool found = false;
    visit_table(world, id.kind, [&](auto& table) {
        const auto row = table.slots.find(id.id);
        if (!row) return;
        found = true;
        if (!table.driven[*row]) detail::note_feature(world, table, *row);
        table.driven.set(*row, 1);
        table.rate.set(*row, clamp(rate, -limit::speed<Real>, limit::speed<Real>));
    });
    return found;
}

template <int D, class Real> bool set_max_force(World<D, Real>& world, const ConstraintId& id, Real max_force) {
    bool found = false;
    visit_table(world, id.kind, [&](auto& table) {
        const auto row = table.slots.find(id.id);
        if (!row) return;
        found = true;
        if (!table.gives(*row)) detail::note_feature(world, table, *row);
        table.max_force.set(*row, clamp(max_force, Real(0), limit::measure<Real>));
    });
    return found;
}

template <int D, class Real> std::optional<Vec<D, Real>> position_of(const World<D, Real>& world, ParticleId id) {
    const auto row = world.particles.slots.find(id);
    return row ? std::optional(world.particles.position[*row]) : std::nullopt;
}

template <int D, class Real> std::optional<Vec<D, Real>> velocity_of(const World<D, Real>& world, ParticleId id) {
    const auto row = world.particles.slots.find(id);
    return row ? std::optional(world.particles.velocity[*row]) : std::nullopt;
}

template <int D, class Real> bool set_position(World<D, Real>& world, ParticleId id, const Vec<D, Real>& position) {
    const auto row = world.particles.slots.find(id);
    if (!row) return false;
    auto& p = world.particles;
    p.previous[*row] = position + (p.previous[*row] - p.position[*row]); // classic mode's velocity stays what it was
    p.position[*row] = position;
    p.residual[*row] = {};
    return true;
}

template <int D, class Real> bool set_velocity(World<D, Real>& world, ParticleId id, const Vec<D, Real>& velocity) {
    const auto row = world.particles.slots.find(id);
    if (!row) return false;
    auto& p = world.particles;
    p.velocity[*row] = velocity;
    p.previous[*row] = p.position[*row] - velocity * verlet_interval(world);
    return true;
}

template <int D, class Real> bool set_mass(World<D, Real>& world, ParticleId id, Real mass) {
    const auto row = world.particles.slots.find(id);
    if (!row) return false;
    world.particles.inverse_mass[*row] = inverse_of_mass(mass);
    refresh_mobility(world, *row);
    detail::note_weight(world, *row);
    return true;
}

template <int D, class Real> bool apply_force(World<D, Real>& world, ParticleId id, const Vec<D, Real>& force) {
    const auto row = world.particles.slots.find(id);
    if (!row) return false;
    world.particles.force[*row] += force;
    return world.particles.any_force = true;
}

template <int D, class Real> bool apply_impulse(World<D, Real>& world, ParticleId id, const Vec<D, Real>& impulse) {
    const auto row = world.particles.slots.find(id);
    if (!row) return false;
    const auto& p = world.particles;
    return set_velocity(world, id,
                        p.velocity[*row] + impulse * (p.mobility[*row] > Real(0) ? p.inverse_mass[*row] : Real(0)));
}

template <int D, class Real>
std::optional<PinId> pin(World<D, Real>& world, ParticleId particle, const PinSpec<D, Real>& spec) {
    const auto row = world.particles.slots.find(particle);
    if (!row) return std::nullopt;
    const auto position = world.particles.position[*row];
    constexpr auto most = limit::measure<Real>;
    world.pins.push_back({.particle = particle,
                          .from = position,
                          .target = spec.target.value_or(position),
                          .compliance = clamp(spec.compliance, Real(0), most),
                          .damping = clamp(spec.damping, Real(0), most),
                          .max_force = clamp(spec.max_force, Real(0), most),
                          .hold = spec.hold,
                          .steer = clamp_components(spec.steer, most),
                          .steer_damping = clamp(spec.steer_damping, Real(0), most)});
    if (world.pins.back().hard() && world.particles.mobility[*row] > Real(0)) {
        world.particles.mobility[*row] = Real(0);
        detail::note_mobility(world, *row);
    }
    detail::note_rows(world);
    return world.pin_slots.append();
}

template <int D, class Real> bool move_pin(World<D, Real>& world, PinId pin, const Vec<D, Real>& target) {
    const auto row = world.pin_slots.find(pin);
    if (row) world.pins[*row].target = target;
    return row.has_value();
}

template <int D, class Real> bool unpin(World<D, Real>& world, PinId pin) {
    const auto row = world.pin_slots.find(pin);
    if (!row) return false;
    const auto particle = world.pins[*row].particle;
    std::vector<char> gone(world.pins.size(), 0);
    gone[*row] = 1;
    detail::erase_pins(world, gone);
    if (const auto held = world.particles.slots.find(particle)) refresh_mobility(world, *held);
    return true;
}

template <int D, class Real> void unpin_all(World<D, Real>& world, ParticleId particle) {
    std::vector<char> gone(world.pins.size(), 0);
    for (std::size_t i = 0; i < gone.size(); ++i) gone[i] = world.pins[i].particle == particle;
    detail::erase_pins(world, gone);
    if (const auto row = world.particles.slots.find(particle)) refresh_mobility(world, *row);
}

template <int D, class Real>
FigureIndex add_figure(World<D, Real>& world, std::string_view name, std::string_view prefab) {
    const auto figure = FigureIndex(world.figures.size());
    world.figures.push_back({.name = std::string(name), .prefab = std::string(prefab)});
    world.figure_names.emplace_back(name, figure);
    return figure;
}

template <int D, class Real>
void teleport(World<D, Real>& world, FigureIndex figure, const Vec<D, Real>& offset, Momentum momentum) {
    if (figure >= world.figures.size()) return;
    auto& p = world.particles;
    for (const auto id : world.figures[figure].particles) {
        const auto row = p.slots.find(id);
        if (!row) continue;
        p.position[*row] += offset;
        p.previous[*row] += offset;
        if (momentum == Momentum::reset) {
            p.previous[*row] = p.position[*row];
            p.velocity[*row] = {};
        }
    }
    for (auto& pin : world.pins) {
        const auto row = p.slots.find(pin.particle);
        if (!row || p.figure[*row] != figure) continue;
        pin.from += offset;
        pin.target += offset;
    }
}

template <int D, class Real> void release_quarantine(World<D, Real>& world, FigureIndex figure) {
    if (figure >= world.figures.size()) return;
    world.figures[figure].quarantined = false;
    for (const auto id : world.figures[figure].particles) {
        const auto row = world.particles.slots.find(id);
        if (!row) continue;
        world.particles.quarantined[*row] = 0;
        refresh_mobility(world, *row);
    }
}

#define SINEW_EDIT(D, Real)                                                                                            \
    template void remove_particles(World<D, Real>&, std::span<const ParticleId>);                                      \
    template void remove_constraints(World<D, Real>&, std::span<const ConstraintId>);                                  \
    template bool drive(World<D, Real>&, const ConstraintId&, Real);                                                   \
    template bool set_max_force(World<D, Real>&, const ConstraintId&, Real);                                           \
    template std::optional<Vec<D, Real>> position_of(const World<D, Real>&, ParticleId);                               \
    template std::optional<Vec<D, Real>> velocity_of(const World<D, Real>&, ParticleId);                               \
    template bool set_position(World<D, Real>&, ParticleId, const Vec<D, Real>&);                                      \
    template bool set_velocity(World<D, Real>&, ParticleId, const Vec<D, Real>&);                                      \
    template bool set_mass(World<D, Real>&, ParticleId, Real);                                                         \
    template bool apply_force(World<D, Real>&, ParticleId, const Vec<D, Real>&);                                       \
    template bool apply_impulse(World<D, Real>&, ParticleId, const Vec<D, Real>&);                                     \
    template std::optional<PinId> pin(World<D, Real>&, ParticleId, const PinSpec<D, Real>&);                           \
    template bool move_pin(World<D, Real>&, PinId, const Vec<D, Real>&);                                               \
    template void unpin_all(World<D, Real>&, ParticleId);                                                              \
    template bool unpin(World<D, Real>&, PinId);                                                                       \
    template FigureIndex add_figure(World<D, Real>&, std::string_view, std::string_view);                              \
    template void teleport(World<D, Real>&, FigureIndex, const Vec<D, Real>&, Momentum);                               \
    template void release_quarantine(World<D, Real>&, FigureIndex);

SINEW_INSTANTIATE(SINEW_EDIT)

} // namespace sinew
