#pragma once

#include "sinew/scene/text.h"
#include "sinew/session/changes_merge.h"
#include "sinew/world/colliders.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace sinew::detail {

/// Parts that the scene has built: numbers that were set, and parts that were removed.
template <class WorldT> class Described {
    static constexpr int D = WorldT::dimension;
    using Real = typename WorldT::Real;

  public:
    explicit Described(Merge<WorldT>& merged) : all_(merged) {}

    void merge_all() {
        merge_lists();
        merge_figures();
        int kind = 0;
        for_each_table(all_.old, [&]<class Table>(const Table&) { merge_joints<Table>(kind++); });
        merge_pins();
        merge_colliders();
        remove_what_is_gone();
    }

  private:
    Merge<WorldT>& all_;
    std::vector<FigureIndex> gone_figures_{};
    std::vector<ConstraintId> gone_constraints_{};
    std::vector<PinId> gone_pins_{};
    std::vector<ColliderId> gone_colliders_{};

    void merge_lists() {
        auto& contacts = all_.fresh.contacts;
        contacts.lists_planes = contacts.lists_planes || all_.old.contacts.lists_planes;
        contacts.lists_figures = contacts.lists_figures || all_.old.contacts.lists_figures;
        merge(all_.base.contacts.hit_impulse, all_.old.contacts.hit_impulse, contacts.hit_impulse);
    }

    /// Colliders of the scene have the number of their section as a tag.
    void merge_colliders() {
        for (std::uint32_t tag = 0; tag < all_.worlds.scene.colliders.size(); ++tag) {
            const auto same = same_section(tag);
            if (!same) continue;
            const auto before = tagged(all_.base, tag), was = tagged(all_.old, tag), is = tagged(all_.fresh, *same);
            if (before.size() != is.size()) continue;
            for (std::size_t i = 0; i < is.size(); ++i)
                if (was.size() == is.size())
                    merge_collider(all_.base.colliders[before[i]], was[i], is[i]);
                else
                    gone_colliders_.push_back(all_.fresh.collider_handles.id_of(is[i]));
        }
    }
    /// Number of a section in the edited scene: by its name; by its number where it has none, and as many are there.
    std::optional<std::uint32_t> same_section(std::uint32_t number) const {
        const auto &before = all_.worlds.scene.colliders, &now = all_.worlds.edited.colliders;
        const auto& name = before[number].name;
        if (before.size() == now.size() && now[number].name == name) return number;
        if (name.empty()) return std::nullopt;
        const auto found = std::ranges::find(now, name, &ColliderSection::name);
        if (found == now.end()) return std::nullopt;
        return std::uint32_t(found - now.begin());
    }
    static std::vector<Row> tagged(const WorldT& world, std::uint32_t tag) {
        std::vector<Row> rows;
        for (Row row = 0; row < world.colliders.size(); ++row)
            if (world.colliders[row].tag == tag) rows.push_back(row);
        return rows;
    }
    void merge_collider(const collide::Collider<D, Real>& before, Row was, Row is) {
        const auto& old = all_.old.colliders[was];
        auto& fresh = all_.fresh.colliders[is];
        if (fresh.target == before.target) fresh.from = old.from, fresh.target = old.target;
        merge(before.filter, old.filter, fresh.filter);
        merge(before.surface_velocity, old.surface_velocity, fresh.surface_velocity);
        all_.colliders.push_back({all_.fresh.collider_handles.id_of(is), all_.old.collider_handles.id_of(was)});
    }

    void merge_figures() {
        for (const auto& figure : all_.base.figures) {
            const auto was = find_figure(all_.old, figure.name), is = find_figure(all_.fresh, figure.name);
            const bool goes_on = is && std::ranges::find(all_.worlds.going_on, *is) != all_.worlds.going_on.end();
            if (is && !was && is_unchanged(figure, all_.fresh.figures[*is])) gone_figures_.push_back(*is);
            if (was && is && *was == *is) all_.fresh.figures[*is].generation = all_.old.figures[*was].generation;
            if (was && goes_on) merge_constraints(figure, all_.old.figures[*was], all_.fresh.figures[*is]);
            if (was && is && !goes_on && !has_same_form(figure, all_.old.figures[*was]))
                all_.lose(
                    concat("the figure ", in_quotes(figure.name), " has been cut or joined, and would begin anew"));
        }
        for (Row row = 0; row < all_.base.particles.size(); ++row)
            if (all_.rows.old_of_base[row] != no_row && all_.rows.fresh_of_base[row] != no_row)
                merge_particle({row, all_.rows.old_of_base[row], all_.rows.fresh_of_base[row]});
    }
    /// True unless parts have been added to a figure of the old world, or removed from it: their ids stay in its lists.
    bool has_same_form(const Figure& before, const Figure& was) const {
        bool is_whole =
            before.particles.size() == was.particles.size() && before.constraints.size() == was.constraints.size();
        for (const auto& id : was.particles) is_whole = is_whole && row_of(all_.old, id);
        for (const auto& id : was.constraints) is_whole = is_whole && constraint_state(all_.old, id);
        return is_whole;
    }
    /// True if both figures have the same particles at the same places.
    bool is_unchanged(const Figure& before, const Figure& is) const {
        if (before.particles.size() != is.particles.size()) return false;
        for (std::size_t i = 0; i < is.particles.size(); ++i)
            if (position_of(all_.base, before.particles[i]) != position_of(all_.fresh, is.particles[i])) return false;
        return true;
    }
    void merge_particle(const Match& match) {
        const auto &b = all_.base.particles, &o = all_.old.particles;
        auto& f = all_.fresh.particles;
        merge(b.inverse_mass[match.base], o.inverse_mass[match.old], f.inverse_mass[match.fresh]);
        merge(b.radius[match.base], o.radius[match.old], f.radius[match.fresh]);
        take_force(match.old, match.fresh);
        all_.particles.push_back({f.handles.id_of(match.fresh), o.handles.id_of(match.old)});
    }
    void take_force(Row old, Row fresh) {
        all_.fresh.particles.force[fresh] = all_.old.particles.force[old];
        all_.fresh.particles.any_force = all_.fresh.particles.any_force || all_.old.particles.any_force;
    }

    void merge_constraints(const Figure& before, const Figure& was, const Figure& is) {
        const auto count = is.constraints.size();
        if (before.constraints.size() != count || was.constraints.size() != count) return;
        for (std::size_t i = 0; i < count; ++i) {
            const auto first = before.constraints[i];
            const auto own = was.constraints[i], id = is.constraints[i];
            if (own.kind != id.kind || first.kind != id.kind) continue;
            visit_table(all_.old, own.kind, [&]<class Table>(const Table& table) {
                const auto b = std::get<Table>(all_.base.constraints).handles.find(first.id);
                const auto o = table.handles.find(own.id),
                           f = std::get<Table>(all_.fresh.constraints).handles.find(id.id);
                if (b && o && f) merge_constraint<Table>(id.kind, {*b, *o, *f});
            });
        }
    }
    template <class Table> void merge_constraint(int kind, const Match& match) {
        const auto &base = std::get<Table>(all_.base.constraints), &old = std::get<Table>(all_.old.constraints);
        auto& fresh = std::get<Table>(all_.fresh.constraints);
        all_.known_constraints[std::size_t(kind)][match.old] = 1;
        all_.constraints.push_back(
            {ConstraintId{kind, fresh.handles.id_of(match.fresh)}, ConstraintId{kind, old.handles.id_of(match.old)}});
        const auto merge_all = [&](auto... column) {
            (merge_row(base.*column, match.base, old.*column, match.old, fresh.*column, match.fresh), ...);
        };
        merge_all(&Table::limits, &Table::multiplier, &Table::compliance, &Table::relaxation, &Table::split,
                  &Table::max_force, &Table::damping_time, &Table::motor_speed, &Table::motorized,
                  &Table::breaking_strain, &Table::break_force, &Table::damage_limit, &Table::damage);
    }

    /// Rows of constraints of no figure: those of the scene, and later ones of calls.
    template <class Table> static std::vector<Row> joints_of(const Table& table) {
        std::vector<Row> rows;
        for (Row row = 0; row < table.size(); ++row)
            if (table.figure[row] == no_figure) rows.push_back(row);
        return rows;
    }
    /// Takes the first row of a list whose members are those of a joint, by a map; no_row if there is none.
    template <class Table>
    static Row take(std::vector<Row>& from, const Table& table, std::span<const Row> members,
                    const std::vector<Row>& map) {
        const auto found = std::ranges::find_if(from, [&](Row row) {
            return std::ranges::equal(table.members[row], members, [&](Row own, Row of) { return own == map[of]; });
        });
        if (found == from.end()) return no_row;
        const Row row = *found;
        from.erase(found);
        return row;
    }
    template <class Table> void merge_joints(int kind) {
        const auto &base = std::get<Table>(all_.base.constraints), &old = std::get<Table>(all_.old.constraints);
        const auto& fresh = std::get<Table>(all_.fresh.constraints);
        auto was = joints_of(old), is = joints_of(fresh);
        for (const Row row : joints_of(base)) {
            const auto members = base.members[row];
            const Row o = take(was, old, members, all_.rows.old_of_base),
                      f = take(is, fresh, members, all_.rows.fresh_of_base);
            if (o != no_row) all_.known_constraints[std::size_t(kind)][o] = 1;
            if (o != no_row && f != no_row) merge_constraint<Table>(kind, {row, o, f});
            if (o == no_row && f != no_row) gone_constraints_.push_back({kind, fresh.handles.id_of(f)});
        }
    }

    /// Pins of a particle, in order.
    static std::vector<Row> pins_of(const WorldT& world, Row particle) {
        std::vector<Row> rows;
        if (particle == no_row) return rows;
        const auto id = world.particles.handles.id_of(particle);
        for (Row row = 0; row < world.pins.size(); ++row)
            if (world.pins[row].particle == id) rows.push_back(row);
        return rows;
    }
    void merge_pins() {
        std::vector<char> done(all_.base.particles.size(), 0);
        for (const auto& pin : all_.base.pins) {
            const auto row = row_of(all_.base, pin.particle);
            if (!row || std::exchange(done[*row], char(1))) continue;
            merge_pins_of(*row);
        }
    }
    void merge_pins_of(Row particle) {
        const auto before = pins_of(all_.base, particle), is = pins_of(all_.fresh, all_.rows.fresh_of_base[particle]);
        auto was = pins_of(all_.old, all_.rows.old_of_base[particle]);
        std::erase_if(was, [&](Row row) { return all_.known_pins[row] != 0; });
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (i < was.size()) all_.known_pins[was[i]] = 1;
            if (i >= is.size()) continue;
            if (i < was.size())
                merge_pin({before[i], was[i], is[i]});
            else if (all_.rows.old_of_base[particle] != no_row)
                gone_pins_.push_back(all_.fresh.pin_handles.id_of(is[i]));
        }
    }
    void merge_pin(const Match& match) {
        const auto &b = all_.base.pins[match.base], &o = all_.old.pins[match.old];
        auto& f = all_.fresh.pins[match.fresh];
        if (f.target == b.target) f.from = o.from, f.target = o.target;
        merge(b.compliance, o.compliance, f.compliance);
        merge(b.damping, o.damping, f.damping);
        merge(b.max_force, o.max_force, f.max_force);
        all_.pins.push_back({all_.fresh.pin_handles.id_of(match.fresh), all_.old.pin_handles.id_of(match.old)});
    }

    void remove_what_is_gone() {
        for (const auto id : gone_pins_) unpin(all_.fresh, id);
        remove_constraints(all_.fresh, std::span<const ConstraintId>(gone_constraints_));
        for (const auto id : gone_colliders_) remove_collider(all_.fresh, id);
        for (const auto figure : gone_figures_) remove_figure(all_.fresh, figure);
        for (Row row = 0; row < all_.old.particles.size(); ++row) all_.rows.fresh_of_old[row] = no_row;
        for (const auto& [is, was] : all_.particles) // rows have moved
            if (const auto from = row_of(all_.old, was), to = row_of(all_.fresh, is); from && to)
                all_.rows.fresh_of_old[*from] = *to;
    }
};

} // namespace sinew::detail
