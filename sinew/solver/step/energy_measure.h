#pragma once

#include "sinew/solver/step/energy_room.h"
#include "sinew/world/energy_terms.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

/// Measures of the energy of bodies around a step.
namespace sinew::detail {

template <int D, class Real> class EnergyMeasure {
  public:
    EnergyMeasure(World<D, Real>& world, const SweepState<D, Real>& swept, EnergyRoom<D, Real>& room, double dt)
        : world_(world), p_(world.particles), swept_(swept), bodies_(room.found), room_(room), dt_(dt) {
        for (const auto& force : world.forces)
            if (const auto* field = std::get_if<Gravity<D, Real>>(&force))
                gravity_ += cast<double>(field->acceleration);
    }

    /// Finds the bodies of an edited world, whose springs are to be measured anew.
    void find_bodies() {
        if (std::exchange(bodies_.edits, world_.journal.edits) == world_.journal.edits) return;
        SleepBodyFinder(world_, bodies_).run();
        list_rows();
        room_.stored.clear();
    }

    /// Notes the state before a step; remains of the step before are still here.
    void note() {
        find_bodies();
        if (!room_.any_rows) return;
        room_.velocity = p_.velocity, room_.at_end = p_.at_end, room_.last_substep = double(world_.last_substep);
        note_spins();
        if (!is_as_noted()) {
            note_places();
            measure_springs(room_.stored);
        }
        room_.in_pins.assign(bodies_.bodies.size(), 0);
        each_soft_pin([&](std::uint32_t body, double energy) { room_.in_pins[body] += energy; });
    }

    /// Gains of all bodies. False if no body gained so much that an island may have.
    bool measure_gains() {
        room_.bodies.assign(bodies_.bodies.size(), {});
        const bool walled = !world_.colliders.empty() || !world_.bounds.empty();
        for (std::uint32_t i = 0; i < room_.bodies.size(); ++i) {
            auto& body = room_.bodies[i];
            for (const Row row : room_.rows[i]) measure(row, room_.rows[i].front(), body);
            body.tenser = room_.next[i] - room_.stored[i] - room_.in_pins[i];
            body.springs = room_.springs[i] != 0, body.is_bounded = walled;
            const double size = 2 * square_root(body.second * inverse_or_zero(body.mass));
            body.slack = energy_tolerance * norm(gravity_) * body.mass * size;
        }
        for (const auto& [number, row] : bodies_.attached) {
            if (room_.rows[number].empty()) continue;
            auto& body = room_.bodies[number];
            body.is_bounded = body.is_held = true;
            const auto reach = distance(p_.position[row], p_.position[room_.rows[number].front()]);
            body.slack = max(body.slack, energy_tolerance * norm(gravity_) * body.mass * double(reach));
        }
        for (const auto& pin : world_.pins)
            if (const auto row = p_.handles.find(pin.particle)) room_.bodies[bodies_.body_of[*row]].is_bounded = true;
        each_soft_pin([&](std::uint32_t body, double energy) { room_.bodies[body].tenser += energy; });
        room_.may_have_gained.clear();
        for (const auto& body : room_.bodies) room_.may_have_gained.push_back(body.may_have_gained());
        return std::ranges::find(room_.may_have_gained, 1) != room_.may_have_gained.end();
    }
    void measure_springs(std::vector<double>& stored) {
        stored.assign(bodies_.bodies.size(), 0);
        room_.springs.assign(bodies_.bodies.size(), 0);
        each_spring([&](std::uint32_t body, double energy) { stored[body] += energy, room_.springs[body] = 1; });
    }
    /// Notes the state that the energy of springs depends on.
    void note_places() {
        room_.position = p_.position;
        int kind = 0;
        for_each_table(world_, [&](const auto& table) {
            auto& kept = room_.multiplier[std::size_t(kind++)];
            kept.clear();
            if (has_springs(table)) kept = table.multiplier;
        });
    }

    /// Gives the springs of a body the forces of the step before.
    void put_back_forces(std::uint32_t number) {
        int kind = 0;
        for_each_table(world_, [&](auto& table) {
            const auto& kept = room_.multiplier[std::size_t(kind++)];
            if (!has_springs(table)) return;
            for (Row row = 0; row < table.size(); ++row)
                if (body_of(table, row) == number) table.multiplier[row] = kept[row];
        });
    }

  private:
    using Vector = Vec<D, double>;
    static constexpr std::uint32_t none = ~0U;

    World<D, Real>& world_;
    Particles<D, Real>& p_;
    const SweepState<D, Real>& swept_;
    SleepRoom<D, Real>& bodies_;
    EnergyRoom<D, Real>& room_;
    double dt_;
    Vector gravity_{};

    void note_spins() {
        room_.spin.clear();
        if (!p_.inertia.any_of([](Real inertia) { return inertia > Real(0); })) return;
        room_.spin.resize(p_.size());
        for (Row row = 0; row < p_.size(); ++row) room_.spin[row] = p_.spin[row];
    }
    template <class Table> static bool has_springs(const Table& table) {
        return table.compliance.any_of([](Real compliance) { return compliance > Real(0); });
    }
    /// Lists the particles of the bodies that may gain: those with masses that differ, near others, or with springs,
    /// but for links in an order that is stable in one direction. Others, such as cloth of equal threads, are only ever
    /// slowed down by the sweep.
    void list_rows() {
        auto& risks = room_.risks;
        risks.assign(bodies_.bodies.size(), 0);
        auto& elastic = room_.springs; // by links
        elastic.assign(bodies_.bodies.size(), 0);
        for_each_table(world_, [&](const auto& table) {
            using Kind = typename std::decay_t<decltype(table)>::Kind;
            if (!has_springs(table)) return;
            for (Row row = 0; row < table.size(); ++row)
                if (const auto body = body_of(table, row); body != none)
                    (std::is_same_v<Kind, Distance<D>> ? elastic : risks)[body] = 1;
        });
        for (const auto& component : swept_.plan.components)
            if (component.goes_back())
                for (Row slot = component.begin.slot; slot < swept_.plan.end_of(component).slot; ++slot)
                    if (const auto body = bodies_.body_of[swept_.row_of[slot]]; elastic[body]) risks[body] = 1;
        for (const auto& run : swept_.plan.others)
            if (run.both_ways)
                visit_table(world_, run.kind, [&](const auto& table) {
                    for (Row row = run.rows.first; row < run.rows.last; ++row)
                        if (const auto body = body_of(table, row); body != none) risks[body] = 1;
                });
        constexpr Real alike = Real(4); // ratio of masses below which a sweep of equal links only ever loses energy
        auto& mobilities = room_.mobilities;
        mobilities.assign(bodies_.bodies.size(), {std::numeric_limits<Real>::max(), Real(0)});
        for (Row row = 0; row < p_.size(); ++row) {
            const auto body = bodies_.body_of[row];
            auto& [least, most] = mobilities[body];
            least = min(least, p_.mobility[row]), most = max(most, p_.mobility[row]);
            if (p_.near[row] != 0) risks[body] = 1;
        }
        for (std::size_t i = 0; i < risks.size(); ++i)
            if (mobilities[i][1] > alike * mobilities[i][0]) risks[i] = 1;
        room_.rows.fill(bodies_.bodies.size(), [&](auto&& visit) {
            for (Row row = 0; row < p_.size(); ++row)
                if (risks[bodies_.body_of[row]] && p_.mobility[row] > Real(0)) visit(bodies_.body_of[row], row);
        });
        room_.any_rows = room_.rows.entries() > 0;
    }

    void measure(Row row, Row first, EnergyGain<D>& body) const {
        const double mass = mass_of(p_, row);
        const auto now = cast<double>(p_.velocity[row]), before = cast<double>(room_.velocity[row]);
        const auto place = cast<double>(p_.position[row]);
        const double higher = -mass * dot(gravity_, place - cast<double>(room_.position[row]));
        const double half = p_.at_end[row] ? 0 : 0.5 * double(world_.last_substep);
        const double half_before = room_.at_end[row] ? 0 : 0.5 * room_.last_substep;
        body.mass += mass;
        body.kinetic += 0.5 * mass * dot(now, now);
        body.faster += 0.5 * mass * (dot(now, now) - dot(before, before));
        body.higher += higher;
        body.midway += higher + mass * dot(gravity_, now * half - before * half_before);
        body.before += before * mass, body.after += now * mass;
        body.weight += gravity_ * (mass * (dt_ + half_before - half));
        body.rounding += 4 * double(std::numeric_limits<Real>::epsilon()) * mass * norm(now);
        const auto arm = place - cast<double>(p_.position[first]);
        body.second += mass * dot(arm, arm);
        body.swept = body.swept || !p_.at_end[row] || p_.near[row] != 0;
        if (room_.spin.empty()) return;
        const auto turns = cast<double>(p_.spin[row]), turned = cast<double>(room_.spin[row]);
        body.kinetic += 0.5 * inertia_of(p_, row) * dot(turns, turns);
        body.faster += 0.5 * inertia_of(p_, row) * (dot(turns, turns) - dot(turned, turned));
    }

    bool is_as_noted() const {
        bool same = room_.position == p_.position && room_.stored.size() == bodies_.bodies.size();
        int kind = 0;
        for_each_table(world_, [&](const auto& table) {
            const auto& kept = room_.multiplier[std::size_t(kind++)];
            same = same && (has_springs(table) ? kept == table.multiplier : kept.empty());
        });
        return same;
    }
    /// Calls visit(body, energy) for each spring of a body that may gain.
    template <class Visit> void each_spring(Visit&& visit) {
        std::optional<SlackLinks> slack;
        for_each_table(world_, [&](const auto& table) {
            if (!has_springs(table)) return;
            for (Row row = 0; row < table.size(); ++row)
                if (const auto body = body_of(table, row); body != none && room_.risks[body])
                    visit(body, stored(table, row, slack));
        });
    }
    template <class Visit> void each_soft_pin(Visit&& visit) {
        for (const auto& pin : world_.pins)
            if (const auto row = p_.handles.find(pin.particle); row && !pin.is_rigid())
                visit(bodies_.body_of[*row],
                      pin.spring_energy(cast<double>(p_.position[*row]) - cast<double>(pin.target)));
    }
    /// Body of a spring; none for a rigid constraint.
    template <class Table> std::uint32_t body_of(const Table& table, Row row) const {
        if (table.is_rigid(row)) return none;
        for (const Row member : table.members[row])
            if (p_.mobility[member] > Real(0)) return bodies_.body_of[member];
        return none;
    }
    template <class Table> double stored(const Table& table, Row row, std::optional<SlackLinks>& slack) {
        using Kind = typename Table::Kind;
        const auto members = table.members[row];
        const auto point = [&](Row member) { return cast<double>(p_.position[member]); };
        const auto weight = [&](Row member) { return double(p_.mobility[member]); };
        const auto measured = measure_row(table, row, room_.points, point, weight);
        const bool swept = std::none_of(members.begin(), members.end(), [&](Row m) { return p_.at_end[m] != 0; });
        const double multiplier = double(table.multiplier[row]), substep = double(world_.last_substep);
        if (swept && multiplier != 0 && is_beyond_sweep(double(table.compliance[row]), measured.response, substep))
            return energy_of_force(table, row, multiplier, substep);
        const double low = double(table.low(row)), high = double(table.high(row));
        const double measure = detail::unwrap<Kind>(measured.value, low, high);
        double energy = table.spring_energy(row, measure - clamp(measure, low, high));
        if constexpr (std::is_same_v<Kind, Angle<D>>)
            if (energy > 0) {
                if (!slack) slack.emplace(std::get<kind_number<Distance, D>>(world_.constraints), room_.links);
                energy *= slack->tautness(members, point);
            }
        return energy;
    }
};

} // namespace sinew::detail
