#pragma once

#include "sinew/assert/assert.h"
#include "sinew/scene/text.h"
#include "sinew/session/changes_merge.h"
#include "sinew/world/colliders.h"

#include <array>
#include <string>
#include <vector>

namespace sinew::detail {

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

} // namespace sinew::detail
