#include "sinew/world/measure.h"

#include "sinew/world/energy_terms.h"
#include "sinew/world/slack_links.h"

#include <algorithm>

namespace sinew {
namespace {

/// Position for a particle's velocity: in the middle of the last substep; at the end for direct blocks and for classic
/// integrators other than Verlet.
template <int D, class Real> Vec<D, double> position_of_velocity(const World<D, Real>& world, Row row) {
    const auto& p = world.particles;
    const auto position = cast<double>(p.position[row]);
    if (world.settings.mode == Mode::classic) {
        if (!has_mean_velocity(integrator_of(world, row))) return position;
        return (position + cast<double>(p.previous[row])) * 0.5;
    }
    if (p.at_end[row]) return position;
    return position - cast<double>(p.velocity[row]) * (0.5 * double(world.last_substep));
}

/// True if a particle of a direct block is among the members.
template <int D, class Real> bool is_at_end(const Particles<D, Real>& p, std::span<const Row> members) {
    return std::any_of(members.begin(), members.end(), [&](Row member) { return p.at_end[member] != 0; });
}

/// True if the sweep of physical mode acts on the members.
template <int D, class Real> bool is_swept(const World<D, Real>& world, std::span<const Row> members) {
    return world.settings.mode == Mode::physical && !is_at_end(world.particles, members);
}

template <class Table, class Real>
ConstraintState state_of(const Table& table, Row row, double measured, Real substep) {
    using Kind = typename Table::Kind;
    const double low = double(table.low(row)), high = double(table.high(row));
    ConstraintState state;
    state.measure = detail::unwrap<Kind>(measured, low, high);
    state.error = state.measure - clamp(state.measure, low, high);
    state.strain = detail::strain<Kind>(measured, low, high);
    state.tension = -double(table.multiplier[row]) * inverse_or_zero(square(double(substep)));
    return state;
}

} // namespace

template <int D, class Real>
std::optional<ConstraintState> constraint_state(const World<D, Real>& world, const ConstraintId& id) {
    std::optional<ConstraintState> state;
    visit_table(world, id.kind, [&](const auto& table) {
        const auto row = table.handles.find(id.id);
        if (!row) return;
        const auto position = [&](Row particle) { return cast<double>(world.particles.position[particle]); };
        state = state_of(table, *row, measure_row(table, *row, position), world.last_substep);
    });
    return state;
}

namespace {

template <int D, class Real> void add_particle_energy(const World<D, Real>& world, Row row, Energy& sum) {
    const auto& p = world.particles;
    if (p.mobility[row] == Real(0)) return;
    const double mass = mass_of(p, row);
    const auto velocity = cast<double>(p.velocity[row]);
    sum.kinetic += 0.5 * mass * dot(velocity, velocity);
    const auto spin = cast<double>(p.spin[row]);
    sum.kinetic += 0.5 * inertia_of(p, row) * dot(spin, spin);
    for (const auto& force : world.forces)
        sum.potential += std::visit(PotentialOf<D, Real>{mass, position_of_velocity(world, row), p.figure[row]}, force);
}

/// Energy of the figures for which `counts` is true.
template <int D, class Real, class Counts> Energy energy_where(const World<D, Real>& world, Counts&& counts) {
    const auto& p = world.particles;
    Energy sum;
    for (Row row = 0; row < p.size(); ++row)
        if (counts(p.figure[row])) add_particle_energy(world, row, sum);
    std::vector<SlackLink> links;
    std::optional<SlackLinks> slack;
    std::vector<Vec<D, double>> room;
    for_each_table(world, [&](const auto& table) {
        using Kind = typename std::decay_t<decltype(table)>::Kind;
        for (Row row = 0; row < table.size(); ++row) {
            if (table.is_rigid(row) || !counts(table.figure[row])) continue;
            const auto middle = [&](Row particle) { return position_of_velocity(world, particle); };
            const auto weight = [&](Row particle) { return double(p.mobility[particle]); };
            const auto measured = measure_row(table, row, room, middle, weight);
            const auto state = state_of(table, row, measured.value, world.last_substep);
            const bool told_by_force =
                is_swept(world, table.members[row]) &&
                is_beyond_sweep(double(table.compliance[row]), measured.response, double(world.last_substep));
            double stored = told_by_force
                                ? energy_of_force(table, row, double(table.multiplier[row]), double(world.last_substep))
                                : table.spring_energy(row, state.error);
            if constexpr (std::is_same_v<Kind, Angle<D>>)
                if (stored > 0 && !told_by_force && world.settings.mode == Mode::physical) {
                    if (!slack) slack.emplace(std::get<kind_number<Distance, D>>(world.constraints), links);
                    stored *= slack->tautness(table.members[row], middle);
                }
            sum.stored += stored;
        }
    });
    for (const auto& pin : world.pins) {
        const auto row = p.handles.find(pin.particle);
        if (!row || pin.is_rigid() || !counts(p.figure[*row])) continue;
        const std::array held{*row};
        const double substep = double(world.last_substep);
        if (is_swept(world, held) && is_beyond_sweep(double(pin.compliance), double(p.mobility[*row]), substep)) {
            const auto force = cast<double>(pin.multiplier) * inverse_or_zero(square(substep));
            sum.stored += 0.5 * double(pin.compliance) * dot(force, force);
        } else {
            sum.stored += pin.spring_energy(position_of_velocity(world, *row) - cast<double>(pin.target));
        }
    }
    return sum;
}

} // namespace

template <int D, class Real> Energy energy(const World<D, Real>& world) {
    auto sum = energy_where(world, [](FigureIndex) { return true; });
    sum.lost = world.energy_lost;
    return sum;
}

template <int D, class Real> Energy energy_of(const World<D, Real>& world, FigureIndex figure) {
    return energy_where(world, [&](FigureIndex other) { return other == figure; });
}

template <int D, class Real> Energy energy_of(const World<D, Real>& world, ParticleId id) {
    Energy sum;
    if (const auto row = row_of(world, id)) add_particle_energy(world, *row, sum);
    return sum;
}

template <int D, class Real> Vec<D, double> momentum(const World<D, Real>& world) {
    const auto& p = world.particles;
    Vec<D, double> sum{};
    for (Row row = 0; row < p.size(); ++row) sum += cast<double>(p.velocity[row]) * mass_of(p, row);
    return sum;
}

template <int D, class Real> Vec3<double> angular_momentum(const World<D, Real>& world) {
    const auto& p = world.particles;
    Vec3<double> sum{};
    for (Row row = 0; row < p.size(); ++row) {
        Vec3<double> arm{}, impulse{};
        for (int i = 0; i < D; ++i) {
            arm[i] = position_of_velocity(world, row)[i];
            impulse[i] = double(p.velocity[row][i]) * mass_of(p, row);
        }
        sum += cross(arm, impulse);
        for (int i = 0; i < spins<D>; ++i) sum[D == 2 ? 2 : i] += double(p.spin[row][i]) * inertia_of(p, row);
    }
    return sum;
}

template <int D, class Real> Vec<D, double> center_of_mass(const World<D, Real>& world) {
    const auto& p = world.particles;
    Vec<D, double> sum{};
    for (Row row = 0; row < p.size(); ++row) sum += cast<double>(p.position[row]) * mass_of(p, row);
    return sum * inverse_or_zero(total_mass(world));
}

template <int D, class Real> double total_mass(const World<D, Real>& world) {
    double sum = 0;
    for (Row row = 0; row < world.particles.size(); ++row) sum += mass_of(world.particles, row);
    return sum;
}

template <int D, class Real> double max_speed(const World<D, Real>& world) {
    double fastest = 0;
    for (const auto& velocity : world.particles.velocity) fastest = std::max(fastest, norm(cast<double>(velocity)));
    return fastest;
}

template <int D, class Real> Stretch stretch(const World<D, Real>& world) {
    const auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    Stretch result{.count = distances.size()};
    for (Row row = 0; row < distances.size(); ++row) {
        const auto position = [&](Row particle) { return cast<double>(world.particles.position[particle]); };
        const double strain =
            absolute(state_of(distances, row, measure_row(distances, row, position), world.last_substep).strain);
        result.max = std::max(result.max, strain);
        result.mean += strain;
    }
    if (result.count > 0) result.mean /= double(result.count);
    return result;
}

#define SINEW_MEASURE(D, Real)                                                                                         \
    template std::optional<ConstraintState> constraint_state(const World<D, Real>&, const ConstraintId&);              \
    template Energy energy(const World<D, Real>&);                                                                     \
    template Energy energy_of(const World<D, Real>&, FigureIndex);                                                     \
    template Energy energy_of(const World<D, Real>&, ParticleId);                                                      \
    template Vec<D, double> momentum(const World<D, Real>&);                                                           \
    template Vec3<double> angular_momentum(const World<D, Real>&);                                                     \
    template Vec<D, double> center_of_mass(const World<D, Real>&);                                                     \
    template double total_mass(const World<D, Real>&);                                                                 \
    template double max_speed(const World<D, Real>&);                                                                  \
    template Stretch stretch(const World<D, Real>&);
SINEW_INSTANTIATE(SINEW_MEASURE)

} // namespace sinew
