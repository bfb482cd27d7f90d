#include "sinew/math/hash.h"
#include "sinew/world/asleep.h"
#include "sinew/world/measure.h"
#include "sinew/world/parameter_hash.h"

namespace sinew {
namespace {

/// Hash of the state. Structs are taken apart by structured bindings: a new field does not compile until hashed.
class Digest {
  public:
    template <class... T> void add(const T&... values) { (add_one(values), ...); }
    std::uint64_t value() const { return hash_.value(); }

    template <int D, class Real> void add_but_target(const collide::Collider<D, Real>& collider) {
        const auto& [shape, from, target, restitution, friction, filter, one_way, is_sensor, belt, name, tag] =
            collider;
        add(shape.index(), from, restitution, friction, filter.layers, filter.mask, one_way, is_sensor);
        if (belt != Vec<D, Real>{}) add(belt);
        std::visit([&](const auto& held) { add_shape(held); }, shape);
    }

  private:
    Hash hash_;

    template <class T> void add_bytes(const T& value) { hash_.add(std::as_bytes(std::span(&value, 1))); }

    /// Sizes have 64 bits in the hash, whatever the machine's.
    template <class T>
    requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void add_one(T value) {
        if constexpr (std::is_same_v<T, std::size_t>)
            add_bytes(std::uint64_t(value));
        else
            add_bytes(value);
    }
    template <int D, class Real> void add_one(const Vec<D, Real>& vector) { add_bytes(vector.component); }
    template <class T> void add_one(const std::vector<T>& column) { // numbers have no padding
        hash_.add(column.size());
        hash_.add(column);
    }
    template <class T> void add_one(std::span<const T> rows) { hash_.add(std::as_bytes(rows)); }
    template <class T> void add_one(const Column<T>& column) { add_one(column.rows()); }

    template <class Real> void add_one(const Settings<Real>& settings) {
        const auto& [mode, substeps, iterations, damping, frame, classic, sleep] = settings;
        add(mode, substeps, iterations, damping, frame, classic);
        const auto& [speed, delay] = sleep;
        if (speed != 0) add(speed, delay);
    }
    template <class Real> void add_one(const ClassicRules<Real>& rules) {
        const auto& [passes, order, moves_each_pass, integrator, keep, damp_after_force, root_free, bounce, floor_keep,
                     time_scale, longest_step, outward_bounce, points_only_passes, unscaled_inertia,
                     halved_acceleration, dropped_leftover] = rules;
        add(passes, order, keep, damp_after_force, root_free, bounce, floor_keep, time_scale, longest_step,
            outward_bounce, points_only_passes, unscaled_inertia, halved_acceleration);
        if (dropped_leftover || moves_each_pass) add(dropped_leftover, moves_each_pass);
        if (integrator != Integrator::verlet) add(integrator);
    }

    template <int D, class Real> void add_one(const Force<D, Real>& force) {
        add(force.index());
        std::visit([&](const auto& field) { add_field(field); }, force);
    }
    template <int D, class Real> void add_field(const Gravity<D, Real>& gravity) { add(gravity.acceleration); }
    template <int D, class Real> void add_field(const Drag<D, Real>& drag) { add(drag.strength); }
    template <int D, class Real> void add_field(const Wind<D, Real>& wind) {
        const auto& [velocity, strength, gust, gust_period, gust_size, seed, density, coefficient, metre] = wind;
        add(velocity, strength, gust, gust_period, gust_size, seed);
        if (density > Real(0)) add(density, coefficient, metre);
    }
    template <int D, class Real> void add_field(const Attractor<D, Real>& attractor) {
        const auto& [center, strength, softness, figure] = attractor;
        add(center, strength, softness);
        if (figure != no_figure) add(figure);
    }
    template <int D, class Real> void add_field(const RandomPush<D, Real>& push) {
        const auto& [low, high, seed] = push;
        add(low, high, seed);
    }

    template <int D, class Real> void add_one(const HalfSpace<D, Real>& plane) {
        const auto& [normal, offset, restitution, friction] = plane;
        add(normal, offset, restitution, friction);
    }

    template <int D, class Real> void add_one(const collide::Pose<D, Real>& pose) {
        const auto& [position, rotation] = pose;
        add(position, rotation.number);
    }
    template <int D, class Real> void add_one(const collide::Collider<D, Real>& collider) {
        const auto& [shape, from, target, restitution, friction, filter, one_way, is_sensor, belt, name, tag] =
            collider;
        add(shape.index(), from, target, restitution, friction, filter.layers, filter.mask, one_way, is_sensor);
        if (belt != Vec<D, Real>{}) add(belt);
        std::visit([&](const auto& held) { add_shape(held); }, shape);
    }
    template <int D, class Real> void add_shape(const collide::HalfSpace<D, Real>& plane) {
        add(plane.normal, plane.offset);
    }
    template <int D, class Real> void add_shape(const collide::Sphere<D, Real>& sphere) { add(sphere.radius); }
    template <int D, class Real> void add_shape(const collide::Capsule<D, Real>& capsule) {
        add(capsule.a, capsule.b, capsule.radius);
    }
    template <int D, class Real> void add_shape(const collide::Box<D, Real>& box) { add(box.half()); }
    template <class Real> void add_shape(const collide::Polygon<2, Real>& polygon) { add(polygon.corners); }
    template <class Real> void add_shape(const collide::Chain<2, Real>& chain) { add(chain.points, chain.is_closed); }
    template <class Real> void add_shape(const collide::Mesh<3, Real>& mesh) {
        add(mesh.corners());
        for (const auto& [a, b, c] : mesh.triangles()) add(a, b, c);
    }
    template <class Real> void add_shape(const collide::HeightField<3, Real>& field) {
        add(field.columns, field.spacing, field.height);
    }
};

/// Drives and break forces, of the rows that have one.
template <class Table> void add_drives(const Table& table, Digest& digest) {
    for (Row row = 0; row < table.size(); ++row)
        if (table.break_force[row] < limit::measure<std::decay_t<decltype(table.low(row))>>)
            digest.add(row, table.break_force[row]);
    for (Row row = 0; row < table.size(); ++row)
        if (table.gives(row) || table.damping_time[row] != 0 || table.motorized[row])
            digest.add(row, table.max_force[row], table.damping_time[row], table.motor_speed[row],
                       table.motorized[row]);
}

/// Rows of one kind of constraint; columns that are rarely used count only where a row uses them.
template <class Table> void add_constraints(const Table& table, Digest& digest) {
    for (Row row = 0; row < table.size(); ++row)
        for (const Row member : table.members[row]) digest.add(member);
    digest.add(table.limits.lows(), table.limits.highs(), table.compliance, table.relaxation, table.split,
               table.breaking_strain, table.multiplier, table.figure);
    for (Row row = 0; row < table.size(); ++row)
        if (table.damage_limit[row] > 0) digest.add(row, table.damage_limit[row], table.damage[row]);
    add_drives(table, digest);
}

/// Parameters that edits change, by columns: a world with sleepers hashes them in every step.
template <class Table> void add_parameters(const Table& table, Digest& digest) {
    if constexpr (requires { table.members.pool; })
        digest.add(table.members.pool, table.members.first);
    else
        digest.add(table.members.rows);
    digest.add(table.limits.lows(), table.limits.highs(), table.compliance, table.relaxation, table.split,
               table.breaking_strain, table.damage_limit, table.figure);
    add_drives(table, digest);
}

template <class WorldT> void add_pins(const WorldT& world, Digest& digest) {
    const auto& p = world.particles;
    for (const auto& pin : world.pins)
        digest.add(p.handles.find(pin.particle).value_or(Row(p.size())), pin.from, pin.target, pin.compliance,
                   pin.damping, pin.max_force);
    for (const auto& pin : world.pins)
        if (pin.hold != Hold::fixed || pin.steers()) digest.add(pin.hold, pin.steer, pin.steer_damping);
}

void add_figures(const std::vector<Figure>& figures, Digest& digest) {
    for (const auto& figure : figures) digest.add(figure.in_use(), figure.direct, figure.tethers);
    for (std::size_t i = 0; i < figures.size(); ++i) {
        const auto& [layers, mask] = figures[i].filter;
        if (figures[i].collides || !(figures[i].filter == collide::Filter{}))
            digest.add(i, layers, mask, figures[i].collides, figures[i].touches_itself, figures[i].friction);
    }
    for (std::size_t i = 0; i < figures.size(); ++i)
        if (figures[i].cloth != ClothContactKind::spheres) digest.add(i, figures[i].cloth);
    for (std::size_t i = 0; i < figures.size(); ++i)
        if (figures[i].integrator) digest.add(i, *figures[i].integrator);
    for (std::size_t i = 0; i < figures.size(); ++i) {
        if (figures[i].bounce != 0) digest.add(i, figures[i].bounce);
        if (figures[i].wall_friction) digest.add(i, *figures[i].wall_friction);
        if (figures[i].internal_damping != 0) digest.add(i, figures[i].internal_damping);
    }
}

/// Positions of the sleepers, by runs of rows.
template <class Particles> void add_sleepers(const Particles& p, Digest& digest) {
    const auto is_asleep = [&](std::size_t row) { return row < p.size() && p.asleep[row]; };
    for (std::size_t row = 0; row < p.size(); ++row) {
        const auto first = row;
        while (is_asleep(row)) ++row;
        if (row > first) digest.add(first, std::span(p.position).subspan(first, row - first));
    }
}

/// Particles that turn, or roll in another way than by default.
template <int D, class Real> void add_rolling(const Particles<D, Real>& p, Digest& digest) {
    for (Row row = 0; row < p.size(); ++row) {
        if (p.spin[row] != Vec<spins<D>, Real>{} || p.turn[row] != collide::Rotation<D, Real>{})
            digest.add(row, p.spin[row], p.turn[row].number);
        if (p.rolls[row] != Rolls::loose || p.inertia[row] != Real(solid_inertia<D>))
            digest.add(row, p.rolls[row], p.inertia[row]);
    }
}

/// Contacts of the last step, from which the next one starts.
template <class Contacts> void add_contacts(const Contacts& contacts, Digest& digest) {
    for (const auto& pair : contacts.touching)
        if (!is_plane(pair.collider)) digest.add(pair.particle, pair.collider); // no step reads the others
    for (const auto& [key, multiplier, friction] : contacts.kept) {
        for (const auto particle : key.particle) digest.add(particle);
        digest.add(key.collider, key.feature, multiplier, friction);
    }
}

} // namespace

template <int D, class Real> std::uint64_t state_hash(const World<D, Real>& world) {
    Digest digest;
    const auto& p = world.particles;
    digest.add(world.settings, world.time, world.steps, world.last_step, world.last_substep);
    if (world.repair_window) digest.add(world.repair_window);
    digest.add(p.position, p.previous, p.velocity, p.residual, p.force, p.inverse_mass, p.radius, p.figure,
               p.quarantined, p.mobility);
    if (world.settings.sleep.speed != 0) digest.add(p.rest_time, p.asleep, world.sleep_parameters);
    if (any_near(p)) digest.add(p.near);
    add_rolling(p, digest);
    if (p.energy_debt.any_of([](double debt) { return debt != 0; })) digest.add(p.energy_debt);
    for_each_table(world, [&](const auto& table) { add_constraints(table, digest); });
    for (const auto& run : world.sweep) digest.add(run.kind, run.count);
    add_pins(world, digest);
    add_figures(world.figures, digest);
    for (const auto& force : world.forces) digest.add(force);
    for (const auto& plane : world.bounds) digest.add(plane);
    for (const auto& collider : world.colliders) digest.add(collider);
    add_contacts(world.contacts, digest);
    return digest.value();
}

template <int D, class Real> std::uint64_t parameter_hash(const World<D, Real>& world) {
    Digest digest;
    const auto& p = world.particles;
    digest.add(world.settings, p.inverse_mass, p.radius, p.figure, p.quarantined, p.mobility);
    add_sleepers(p, digest);
    for_each_table(world, [&](const auto& table) { add_parameters(table, digest); });
    for (const auto& pin : world.pins)
        digest.add(p.handles.find(pin.particle).value_or(Row(p.size())), pin.compliance, pin.damping, pin.max_force);
    add_figures(world.figures, digest);
    for (const auto& force : world.forces) digest.add(force);
    for (const auto& plane : world.bounds) digest.add(plane);
    for (const auto& collider : world.colliders) digest.add_but_target(collider);
    return digest.value();
}

#define SINEW_STATE_HASH(D, Real)                                                                                      \
    template std::uint64_t state_hash(const World<D, Real>&);                                                          \
    template std::uint64_t parameter_hash(const World<D, Real>&);
SINEW_INSTANTIATE(SINEW_STATE_HASH)

} // namespace sinew
