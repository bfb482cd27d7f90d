#include "sinew/solver/edit.h"

#include "sinew/solver/remove.h"

#include <algorithm>

namespace sinew {
namespace {

template <class Real> Real inverse_of_mass(Real mass) {
    if (mass == std::numeric_limits<Real>::infinity() || mass <= Real(0)) return Real(0);
    if (!is_finite(mass)) return mass; // not a number: the next step puts its figure in quarantine
    return Real(1) / clamp(mass, Real(1) / limit::mass<Real>, limit::mass<Real>);
}

/// The time between `previous` and `position`: the last substep, a frame before there was one.
template <int D, class Real> Real verlet_interval(const World<D, Real>& world) {
    return world.last_substep > Real(0) ? world.last_substep : world.settings.frame;
}

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

template <class Table, class Real>
void append_row(Table& table, const ConstraintSpec<Real>& spec, Interval<Real> limits) {
    constexpr auto most = limit::measure<Real>;
    table.low.push_back(clamp(limits.low, -most, most));
    table.high.push_back(clamp(limits.high, table.low.back(), most));
    table.multiplier.push_back(Real(0));
    table.compliance.push_back(clamp(spec.compliance, Real(0), most));
    table.relaxation.push_back(clamp(spec.relaxation, Real(0), Real(1)));
    table.split.push_back(clamp(spec.split, Real(0), Real(1)));
    table.max_force.push_back(clamp(spec.max_force, Real(0), most));
    table.lead.push_back(clamp(spec.lead, Real(0), limit::step<Real>));
    table.rate.push_back(Real(0));
    table.driven.push_back(0);
    table.breaking_strain.push_back(clamp(spec.breaking_strain, Real(0), most));
    table.toughness.push_back(clamp(spec.toughness, Real(0), most));
    table.fatigue.push_back(Real(0));
    table.figure.push_back(spec.figure);
    table.in_block.push_back(0);
    table.torn.push_back(0);
}

bool any_twice(std::span<const Row> rows) {
    constexpr std::size_t few = 8; // so few are compared faster than sorted
    if (rows.size() <= few) {
        for (auto row = rows.begin(); row != rows.end(); ++row)
            if (std::find(rows.begin(), row, *row) != row) return true;
        return false;
    }
    std::vector<Row> sorted(rows.begin(), rows.end());
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

} // namespace

template <int D, class Real> void reserve(World<D, Real>& world, Sizes sizes) {
    reserve_rows(world.particles, world.particles.size() + sizes.particles);
    world.particles.slots.reserve(world.particles.size() + sizes.particles);
    auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    reserve_rows(distances, distances.size() + sizes.constraints);
    distances.members.rows.reserve(distances.size() + sizes.constraints);
    distances.slots.reserve(distances.size() + sizes.constraints);
}

template <int D, class Real> ParticleId add_particle(World<D, Real>& world, const ParticleSpec<D, Real>& spec) {
    auto& p = world.particles;
    const Real h = verlet_interval(world);
    p.position.push_back(spec.position);
    p.previous.push_back(spec.previous.value_or(spec.position - spec.velocity * h));
    p.velocity.push_back(spec.previous ? (spec.position - *spec.previous) * inverse_or_zero(world.settings.frame)
                                       : spec.velocity);
    p.residual.push_back({});
    p.force.push_back({});
    p.rebound.push_back({});
    p.inverse_mass.push_back(inverse_of_mass(spec.mass));
    p.mobility.push_back(p.inverse_mass.back());
    p.radius.push_back(spec.radius);
    p.figure.push_back(spec.figure);
    p.quarantined.push_back(0);
    p.in_block.push_back(0);
    world.events.reserve(events_per_step);
    const auto id = p.slots.append();
    detail::note_particle(world);
    return id;
}

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

template <int D, class Real>
std::optional<ConstraintId> add_constraint(World<D, Real>& world, int kind, std::span<const ParticleId> members,
                                           const ConstraintSpec<Real>& spec) {
    std::vector<Row> rows;
    rows.reserve(members.size());
    for (const auto id : members) {
        const auto row = world.particles.slots.find(id);
        if (!row) return std::nullopt;
        rows.push_back(*row);
    }
    if (any_twice(rows)) return std::nullopt;

    std::optional<ConstraintId> added;
    visit_table(world, kind, [&](auto& table) {
        using Kind = typename std::decay_t<decltype(table)>::Kind;
        if constexpr (Kind::arity == any_arity) {
            if (int(rows.size()) < Kind::least_arity) return;
            // the widest constraint's points, gradients and directions
            world.scratch.resize(std::max(world.scratch.size(), 3 * rows.size()));
        } else if (rows.size() != std::size_t(Kind::arity)) {
            return;
        }
        table.members.append(rows);
        append_row(table, spec, spec.limits.value_or(Interval<Real>{0, 0}));
        if (table.breaking_strain.back() < limit::measure<Real>) // and what hangs on it goes with it, in a step
            for_each_table(world, [](auto& any) { any.expect_tears(); });
        added = ConstraintId{kind, table.slots.append()};
        for (const Row member : rows) detail::note_member(world, table, kind, Row(table.size() - 1), member);
        if (!spec.limits) {
            constexpr double most = limit::measure<double>;
            const Real rest = Real(clamp(constraint_state(world, *added)->measure, -most, most));
            table.low.back() = table.high.back() = rest;
        }
        if (world.sweep.empty() || world.sweep.back().kind != kind) world.sweep.push_back({kind, 0});
        ++world.sweep.back().count;
    });
    return added;
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
                          .max_force = clamp(spec.max_force, Real(0), most)});
    if (world.pins.back().hard() && world.particles.mobility[*row] > Real(0)) {
        world.particles.mobility[*row] = Real(0);
        detail::note_mobility(world, *row);
    }
    detail::note_rows(world);
    return world.pin_slots.append();
}

template <int D, class Real> bool move_pin(World<D, Real>& world, PinId pin, const Vec<D, Real>& target) {
    const auto row = world.pin_slots.find(pin);
    if (row) world.pins[*row].target = target, world.pins[*row].moves = true;
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
    world.budgets.figures.resize(world.figures.size());
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
    template void reserve(World<D, Real>&, Sizes);                                                                     \
    template ParticleId add_particle(World<D, Real>&, const ParticleSpec<D, Real>&);                                   \
    template void remove_particles(World<D, Real>&, std::span<const ParticleId>);                                      \
    template std::optional<ConstraintId> add_constraint(World<D, Real>&, int, std::span<const ParticleId>,             \
                                                        const ConstraintSpec<Real>&);                                  \
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
