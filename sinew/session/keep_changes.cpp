#include "sinew/session/keep_changes.h"

#include "sinew/assert/assert.h"
#include "sinew/scene/check.h"
#include "sinew/scene/text.h"
#include "sinew/world/colliders.h"
#include "sinew/world/edit.h"
#include "sinew/world/mobility.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

/// Three worlds are compared: that of the scene as it began (`base`), the old one and the new one. A number that the
/// edit leaves as it was at the beginning is taken from the old world, as in a merge of three texts.
namespace sinew {
namespace {

constexpr Row no_row = ~Row(0);

/// Takes a number over, unless the edit has changed it.
template <class T> void merge(const T& base, const T& old, T& fresh) {
    if (fresh == base) fresh = old;
}

template <class T>
void merge_row(const std::vector<T>& base, Row b, const std::vector<T>& old, Row o, std::vector<T>& fresh, Row f) {
    merge(base[b], old[o], fresh[f]);
}
template <class T> void merge_row(const Column<T>& base, Row b, const Column<T>& old, Row o, Column<T>& fresh, Row f) {
    if (fresh[f] == base[b]) fresh.set(f, old[o]);
}
template <class Real>
void merge_row(const LimitColumns<Real>& base, Row b, const LimitColumns<Real>& old, Row o, LimitColumns<Real>& fresh,
               Row f) {
    if (fresh.low(f) == base.low(b) && fresh.high(f) == base.high(b)) fresh.set(f, old.low(o), old.high(o));
}

template <class T> void copy_row(const std::vector<T>& from, Row row, std::vector<T>& to, Row into) {
    to[into] = from[row];
}
template <class T> void copy_row(const Column<T>& from, Row row, Column<T>& to, Row into) {
    to.set(into, from[row]);
}
template <class Real> void copy_row(const LimitColumns<Real>& from, Row row, LimitColumns<Real>& to, Row into) {
    to.set(into, from.low(row), from.high(row));
}

/// Copies a row of a table into a row of another table.
template <class Table> void copy_columns(const Table& from, Row row, Table& to, Row into) {
    std::vector<const void*> columns;
    Table::columns(from, [&](const auto& column) { columns.push_back(&column); });
    std::size_t number = 0;
    Table::columns(to, [&]<class Column>(Column& column) { // of the same types, in the same order
        copy_row(*static_cast<const Column*>(columns[number++]), row, column, into);
    });
}

/// Rows of the particles of one world in another one: figure by figure, in the order of construction.
template <class WorldT> class Counterparts {
  public:
    Counterparts(const WorldT& base, const WorldT& old, const WorldT& fresh, std::span<const FigureIndex> going_on)
        : old_of_base(base.particles.size(), no_row), fresh_of_base(base.particles.size(), no_row),
          fresh_of_old(old.particles.size(), no_row), is_described(old.figures.size(), 0) {
        for (const auto& figure : base.figures) {
            const auto was = find_figure(old, figure.name);
            if (!was) continue;
            is_described[*was] = 1;
            map(base, figure, old, old.figures[*was], old_of_base);
            const auto is = find_figure(fresh, figure.name);
            if (!is || std::ranges::find(going_on, *is) == going_on.end()) continue;
            map(base, figure, fresh, fresh.figures[*is], fresh_of_base);
            map(old, old.figures[*was], fresh, fresh.figures[*is], fresh_of_old);
        }
    }

    std::vector<Row> old_of_base, fresh_of_base, fresh_of_old;
    std::vector<char> is_described; ///< by figure of the old world: the scene has built it

  private:
    static void map(const WorldT& from, const Figure& first, const WorldT& to, const Figure& second,
                    std::vector<Row>& rows) {
        if (first.particles.size() != second.particles.size()) return;
        for (std::size_t i = 0; i < first.particles.size(); ++i) {
            const auto a = row_of(from, first.particles[i]), b = row_of(to, second.particles[i]);
            if (a && b) rows[*a] = *b;
        }
    }
};

/// One row of each of the three worlds; no_row where it is missing.
struct Match {
    Row base = no_row, old = no_row, fresh = no_row;
};

/// The worlds, and their rows.
template <class WorldT> struct Merge {
    static constexpr int D = WorldT::dimension;
    using Real = typename WorldT::Real;

    Merge(const WorldT& began, const Replacement& all, const WorldT& before, WorldT& now)
        : base(began), worlds(all), old(before), fresh(now), rows(began, before, now, all.going_on) {
        for_each_table(old, [&](const auto& table) { known_constraints.emplace_back(table.size(), char(0)); });
        known_pins.assign(old.pins.size(), 0);
        for (const auto id : worlds.not_kept)
            if (const auto row = old.pin_handles.find(id)) known_pins[*row] = 1;
    }

    const WorldT& base;
    const Replacement& worlds;
    const WorldT& old;
    WorldT& fresh;
    Counterparts<WorldT> rows;
    std::vector<std::vector<char>> known_constraints{}; ///< by kind and row of the old world: not to be added
    std::vector<char> known_pins{};                     ///< by row of the old world
    std::vector<std::array<ParticleId, 2>> particles{}; ///< ids in the new world and in the old one
    std::vector<std::array<ConstraintId, 2>> constraints{};
    std::vector<std::array<PinId, 2>> pins{};
    std::vector<std::array<ColliderId, 2>> colliders{};
    std::string lost{}; ///< why something cannot go on

    void lose(std::string reason) {
        if (lost.empty()) lost = std::move(reason);
    }
};

/// Parts that the scene has built: numbers that were set, and parts that were removed.
template <class WorldT> class Described {
    static constexpr int D = WorldT::dimension;
    using Real = typename WorldT::Real;

  public:
    explicit Described(Merge<WorldT>& merged) : all_(merged) {}

    void merge_all() {
        merge_surroundings();
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

    static const Gravity<D, Real>* gravity_in(const WorldT& world) {
        return world.forces.empty() ? nullptr : std::get_if<Gravity<D, Real>>(&world.forces.front());
    }
    void merge_surroundings() {
        const auto *before = gravity_in(all_.base), *old = gravity_in(all_.old), *fresh = gravity_in(all_.fresh);
        if (before && old && fresh && fresh->acceleration == before->acceleration) all_.fresh.forces.front() = *old;
        auto& contacts = all_.fresh.contacts;
        contacts.lists_planes = contacts.lists_planes || all_.old.contacts.lists_planes;
        contacts.lists_figures = contacts.lists_figures || all_.old.contacts.lists_figures;
    }

    /// Colliders of the scene have the number of their section as a tag.
    void merge_colliders() {
        for (std::uint32_t tag = 0; tag < all_.worlds.scene.colliders.size(); ++tag) {
            const auto before = tagged(all_.base, tag), was = tagged(all_.old, tag), is = tagged(all_.fresh, tag);
            if (before.size() != is.size()) continue;
            for (std::size_t i = 0; i < is.size(); ++i)
                if (was.size() == is.size())
                    merge_collider(all_.base.colliders[before[i]], was[i], is[i]);
                else
                    gone_colliders_.push_back(all_.fresh.collider_handles.id_of(is[i]));
        }
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
            if (was && is && !goes_on && !has_same_size(figure, all_.old.figures[*was]))
                all_.lose(
                    concat("the figure ", in_quotes(figure.name), " has been cut or joined, and would begin anew"));
        }
        for (Row row = 0; row < all_.base.particles.size(); ++row)
            if (all_.rows.old_of_base[row] != no_row && all_.rows.fresh_of_base[row] != no_row)
                merge_particle({row, all_.rows.old_of_base[row], all_.rows.fresh_of_base[row]});
    }
    static bool has_same_size(const Figure& a, const Figure& b) {
        return a.particles.size() == b.particles.size() && a.constraints.size() == b.constraints.size();
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

/// Parts that calls and events have added.
template <class WorldT> class Added {
    static constexpr int D = WorldT::dimension;
    using Real = typename WorldT::Real;

  public:
    explicit Added(Merge<WorldT>& merged) : all_(merged) {}

    void add_all() {
        add_figures();
        add_particles();
        add_constraints();
        add_pins();
        add_colliders();
    }
    /// Copies names and pieces, once ids hold in both worlds.
    void copy_figures() {
        for (FigureIndex i = 0; i < new_index_.size(); ++i) {
            if (new_index_[i] == no_figure) continue;
            auto& figure = all_.fresh.figures[new_index_[i]];
            const auto generation = figure.generation;
            figure = all_.old.figures[i];
            figure.generation = generation;
        }
    }

  private:
    Merge<WorldT>& all_;
    std::vector<FigureIndex> new_index_{}; ///< by index in the old world

    std::string figure_of(Row old_row) const {
        const auto figure = all_.old.particles.figure[old_row];
        return has_figure(all_.old, figure) ? in_quotes(all_.old.figures[figure].name) : "a loose particle";
    }

    bool is_added(FigureIndex figure) const { return has_figure(all_.old, figure) && !all_.rows.is_described[figure]; }

    void add_figures() {
        new_index_.assign(all_.old.figures.size(), no_figure);
        for (FigureIndex i = 0; i < all_.old.figures.size(); ++i) {
            if (!is_added(i)) continue;
            const auto& figure = all_.old.figures[i];
            if (find_figure(all_.fresh, figure.name))
                all_.lose(
                    concat("a figure of the scene would have the name of an added one, ", in_quotes(figure.name)));
            else
                new_index_[i] = index_for(i);
        }
    }
    /// The same index as before, where it is unused.
    FigureIndex index_for(FigureIndex index) {
        const auto& figure = all_.old.figures[index];
        auto& figures = all_.fresh.figures;
        if (has_figure(all_.fresh, index)) {
            all_.lose(concat("a figure of the scene would have the index of an added one, ", in_quotes(figure.name)));
            return add_figure(all_.fresh, figure.name, figure.prefab);
        }
        if (index >= figures.size()) {
            all_.fresh.unused_figures += index + 1 - figures.size();
            figures.resize(std::size_t(index) + 1);
        }
        --all_.fresh.unused_figures;
        figures[index].generation = figure.generation;
        all_.fresh.figure_names.emplace_back(figure.name, index);
        return index;
    }

    void add_particles() {
        const auto& p = all_.old.particles;
        for (Row row = 0; row < p.size(); ++row) {
            const auto figure = p.figure[row];
            const auto owner = is_added(figure) ? new_index_[figure] : no_figure;
            if (figure != no_figure && owner == no_figure) continue;
            const auto id = add_particle(all_.fresh, ParticleSpec<D, Real>{});
            const auto into = *row_of(all_.fresh, id);
            copy_columns(p, row, all_.fresh.particles, into);
            all_.fresh.particles.figure[into] = owner;
            all_.fresh.particles.asleep.set(into, 0);
            all_.fresh.particles.rest_time.set(into, 0);
            all_.fresh.particles.any_force = all_.fresh.particles.any_force || p.any_force;
            all_.rows.fresh_of_old[row] = into;
            all_.particles.push_back({id, p.handles.id_of(row)});
        }
    }

    /// In the order of the sweep.
    void add_constraints() {
        std::array<Row, Kinds<D>::size> next{};
        for (const auto& run : all_.old.sweep)
            visit_table(all_.old, run.kind, [&]<class Table>(const Table& table) {
                auto& row = next[std::size_t(run.kind)];
                for (const Row end = row + run.count; row < end; ++row) {
                    const auto figure = table.figure[row];
                    if (all_.known_constraints[std::size_t(run.kind)][row]) continue;
                    if (figure == no_figure || is_added(figure)) add_constraint_like(table, run.kind, row);
                }
            });
    }
    template <class Table> void add_constraint_like(const Table& table, int kind, Row row) {
        std::vector<ParticleId> members;
        for (const Row member : table.members[row]) {
            const Row into = all_.rows.fresh_of_old[member];
            if (into == no_row)
                return all_.lose(concat("a constraint holds ", figure_of(member), ", which begins anew"));
            members.push_back(all_.fresh.particles.handles.id_of(into));
        }
        const auto id = add_constraint(all_.fresh, kind, members,
                                       ConstraintSpec<Real>{.limits = between(table.low(row), table.high(row)),
                                                            .breaking_strain = table.breaking_strain[row],
                                                            .break_force = table.break_force[row]});
        SINEW_ASSERT(id.has_value(), "a constraint that is possible in one world is so in another");
        if (!id) return;
        auto& own = std::get<Table>(all_.fresh.constraints);
        const auto into = *own.handles.find(id->id);
        copy_columns(table, row, own, into);
        own.figure.set(into, table.figure[row] == no_figure ? no_figure : new_index_[table.figure[row]]);
        all_.constraints.push_back({*id, ConstraintId{kind, table.handles.id_of(row)}});
    }

    void add_pins() {
        for (Row row = 0; row < all_.old.pins.size(); ++row) {
            const auto& old = all_.old.pins[row];
            const auto from = row_of(all_.old, old.particle);
            if (all_.known_pins[row] || !from) continue;
            const Row into = all_.rows.fresh_of_old[*from];
            if (into == no_row) {
                all_.lose(concat("a pin holds ", figure_of(*from), ", which begins anew"));
                continue;
            }
            const auto particle = all_.fresh.particles.handles.id_of(into);
            const auto id = pin(all_.fresh, particle, spec_of(old));
            if (!id) continue;
            auto& added = all_.fresh.pins[*all_.fresh.pin_handles.find(*id)];
            added = old;
            added.particle = particle;
            all_.pins.push_back({*id, all_.old.pin_handles.id_of(row)});
        }
    }

    void add_colliders() {
        for (Row row = 0; row < all_.old.colliders.size(); ++row) {
            if (all_.old.colliders[row].tag < all_.worlds.scene.colliders.size()) continue;
            const auto id = add_collider(all_.fresh, all_.old.colliders[row]);
            all_.fresh.colliders.back() = all_.old.colliders[row];
            all_.colliders.push_back({id, all_.old.collider_handles.id_of(row)});
        }
    }
};

/// Gives the rows of the new world their ids in the old one.
template <class WorldT> class Ids {
  public:
    explicit Ids(Merge<WorldT>& merged) : all_(merged) {}

    void adopt_all(Renamed& renamed) {
        auto& p = all_.fresh.particles;
        const auto particle = adopt(p.handles, Row(p.size()), all_.particles);
        adopt(all_.fresh.collider_handles, Row(all_.fresh.colliders.size()), all_.colliders);
        const auto pin = adopt(all_.fresh.pin_handles, Row(all_.fresh.pins.size()), all_.pins);
        for (const auto& [is, was] : all_.pins) renamed.pins.push_back({is, pin(is)});
        for (auto& each : all_.fresh.pins) each.particle = particle(each.particle);
        std::vector<std::function<Id<ConstraintTag>(const Id<ConstraintTag>&)>> of_kind;
        for_each_table(all_.fresh, [&](auto& table) {
            std::vector<std::array<Id<ConstraintTag>, 2>> same;
            for (const auto& [is, was] : all_.constraints)
                if (is.kind == int(of_kind.size())) same.push_back({is.id, was.id});
            of_kind.emplace_back(adopt(table.handles, Row(table.size()), same));
        });
        const auto constraint = [&](const ConstraintId& id) {
            return id.kind < 0 ? id : ConstraintId{id.kind, of_kind[std::size_t(id.kind)](id.id)};
        };
        for (const auto& [is, was] : all_.constraints) renamed.constraints.push_back({is, constraint(is)});
        for (auto& figure : all_.fresh.figures) rename(figure, particle, constraint);
        for (Row row = 0; row < p.size(); ++row)
            if (p.mobility[row] != p.inverse_mass[row]) detail::refresh_mobility(all_.fresh, row);
        all_.fresh.journal.adjacency.forget();
        all_.fresh.journal.change_all();
    }

  private:
    Merge<WorldT>& all_;

    /// Gives a table the old ids, and returns the function from ids of now to those of then.
    template <class Tag, class Pairs> static auto adopt(HandleMap<Tag>& handles, Row rows, const Pairs& same) {
        std::vector<Id<Tag>> wanted(rows);
        for (const auto& [is, was] : same)
            if (const auto row = handles.find(is)) wanted[*row] = was;
        const auto before = handles;
        handles.take_over(wanted);
        return [before, &handles](const Id<Tag>& id) {
            const auto row = before.find(id);
            return row ? handles.id_of(*row) : id;
        };
    }
    template <class IdT, class Of> static IdList<IdT> renamed_list(const IdList<IdT>& list, const Of& of) {
        IdList<IdT> ids;
        for (const auto& id : list) ids.push_back(of(id));
        return ids;
    }
    template <class IdT, class Of> static NameTable<IdT> renamed_table(const NameTable<IdT>& names, const Of& of) {
        NameTable<IdT> table;
        for (const auto& [name, id] : names) table.emplace_back(name, of(id));
        return table;
    }
    template <class Particle, class Constraint>
    static void rename(Figure& figure, const Particle& particle, const Constraint& constraint) {
        figure.particles = renamed_list(figure.particles, particle);
        figure.constraints = renamed_list(figure.constraints, constraint);
        figure.particle_names = renamed_table(figure.particle_names, particle);
        figure.constraint_names = renamed_table(figure.constraint_names, constraint);
        for (auto& piece : figure.pieces) piece.particles = renamed_list(piece.particles, particle);
    }
};

/// Takes over the touches of the last step, where both sides are left: ids hold.
template <class WorldT> void carry_contacts(const WorldT& old, WorldT& fresh) {
    const auto is_same = [](const auto& before, const auto& now, std::uint32_t slot) {
        return slot < before.indices() && before.in_use(slot) && now.find(before.id_of(before.row_at(slot)));
    };
    const auto has_particle = [&](std::uint32_t slot) {
        return is_same(old.particles.handles, fresh.particles.handles, slot);
    };
    const auto has_collider = [&](std::uint32_t slot) {
        return is_plane(slot) ? old.bounds.size() == fresh.bounds.size()
                              : is_same(old.collider_handles, fresh.collider_handles, slot);
    };
    const auto has_figures = [&](const FigureTouch& touch) {
        const auto is_there = [&](FigureIndex figure) { return figure_id(old, figure) == figure_id(fresh, figure); };
        return is_there(touch.first) && is_there(touch.second) && std::ranges::all_of(touch.particle, has_particle);
    };
    const auto& from = old.contacts;
    auto& to = fresh.contacts;
    to.kept_substep = from.kept_substep;
    for (const auto& kept : from.kept)
        if (std::ranges::all_of(kept.key.particle,
                                [&](auto slot) { return slot == ContactKey::none || has_particle(slot); }) &&
            (kept.key.collider == ContactKey::none || has_collider(kept.key.collider)))
            to.kept.push_back(kept);
    for (const auto& touch : from.touching)
        if (has_particle(touch.particle) && has_collider(touch.collider)) to.touching.push_back(touch);
    for (const auto& touch : from.figures)
        if (has_figures(touch)) to.figures.push_back(touch);
}

/// Reason why a world of another type loses something: none of its parts goes on.
template <class WorldT> std::string lost_of(const Scene& scene, const WorldT& old) {
    const auto is_described = [&](const Figure& figure) {
        return std::ranges::any_of(scene.figures, [&](const auto& one) { return name_of(one) == figure.name; });
    };
    const bool has_added =
        std::ranges::any_of(old.figures,
                            [&](const Figure& figure) { return figure.in_use() && !is_described(figure); }) ||
        std::ranges::find(old.particles.figure, no_figure) != old.particles.figure.end() ||
        std::ranges::any_of(old.colliders, [&](const auto& one) { return one.tag >= scene.colliders.size(); });
    return has_added ? "figures, particles and colliders that were added cannot go on in another dimension or precision"
                     : "";
}

template <class IdT> void rename_in(const std::vector<std::array<IdT, 2>>& pairs, IdT& id) {
    const auto found = std::ranges::find(pairs, id, [](const auto& pair) { return pair[0]; });
    if (found != pairs.end()) id = (*found)[1];
}

} // namespace

void Renamed::rename(PinId& id) const {
    rename_in(pins, id);
}
void Renamed::rename(ConstraintId& id) const {
    rename_in(constraints, id);
}

std::string keep_changes(const Replacement& worlds, Renamed& renamed) {
    return std::visit(
        [&]<class WorldT>(const WorldT& old) {
            auto* fresh = std::get_if<WorldT>(&worlds.fresh);
            if (!fresh) return lost_of(worlds.scene, old);
            const auto base = instantiate(worlds.scene);
            Merge<WorldT> merge(std::get<WorldT>(base), worlds, old, *fresh);
            Described<WorldT>(merge).merge_all();
            Added<WorldT> added(merge);
            added.add_all();
            Ids<WorldT>(merge).adopt_all(renamed);
            added.copy_figures();
            carry_contacts(old, *fresh);
            return merge.lost;
        },
        worlds.old);
}

} // namespace sinew
