#include "sinew/session/change_figure.h"

#include "sinew/session/changes_merge.h"
#include "sinew/session/similarity.h"
#include "sinew/world/changes.h"
#include "sinew/world/mobility.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace sinew {
namespace {

using detail::copy_row;

template <class Column> bool is_same_row(const Column& a, Row i, const Column& b, Row k) {
    return a[i] == b[k];
}
template <class Real> bool is_same_row(const LimitColumns<Real>& a, Row i, const LimitColumns<Real>& b, Row k) {
    return a.low(i) == b.low(k) && a.high(i) == b.high(k);
}

/// Rows of one thing: by the old description, by the new one, and in the running world.
struct Places {
    Row before = detail::no_row, after = detail::no_row, now = detail::no_row;
    bool are_known() const { return before != detail::no_row && after != detail::no_row && now != detail::no_row; }
};

template <class WorldT> class FigureChange {
    static constexpr int D = WorldT::dimension;
    using Real = typename WorldT::Real;
    using Vector = typename WorldT::Vector;

  public:
    FigureChange(WorldT& world, FigureIndex figure, const WorldT& before, const WorldT& after)
        : world_(world), before_(before), after_(after), is_(world.figures[figure]), was_(before.figures.front()),
          wanted_(after.figures.front()), index_(figure) {}

    std::string run() {
        if (!find_places()) return "the figure would begin anew: its form changes, or it has been cut or joined";
        const auto moved = similarity_of(before_, was_, after_, wanted_);
        if (!moved) return "the figure would begin anew: its form changes";
        if (!moved->is_translation() && is_pinned())
            return "the figure would begin anew: it is pinned, and would turn or grow";
        for (const auto& places : particles_) change_particle(places);
        for (std::size_t i = 0; i < is_.constraints.size(); ++i) change_constraint(i);
        change_looks();
        if (!moved->is_identity) move(*moved);
        world_.journal.change_all();
        return {};
    }

  private:
    WorldT& world_;
    const WorldT &before_, &after_;
    Figure& is_;
    const Figure &was_, &wanted_;
    FigureIndex index_;
    std::vector<Places> particles_{};
    std::vector<Row> now_of_after_{}; ///< rows of particles

    static Row row_in(const WorldT& world, ParticleId id) { return row_of(world, id).value_or(detail::no_row); }
    static Row row_in(const WorldT& world, const ConstraintId& id) {
        Row found = detail::no_row;
        visit_table(world, id.kind,
                    [&](const auto& table) { found = table.handles.find(id.id).value_or(detail::no_row); });
        return found;
    }
    template <class List> Places places_of(const List Figure::*list, std::size_t i) const {
        return {row_in(before_, (was_.*list)[i]), row_in(after_, (wanted_.*list)[i]), row_in(world_, (is_.*list)[i])};
    }
    /// False unless all three have the same particles, and constraints of the same kinds.
    bool find_places() {
        const auto count = is_.particles.size(), links = is_.constraints.size();
        if (was_.particles.size() != count || wanted_.particles.size() != count || was_.constraints.size() != links ||
            wanted_.constraints.size() != links)
            return false;
        bool are_known = true;
        now_of_after_.assign(after_.particles.size(), detail::no_row);
        for (std::size_t i = 0; i < count; ++i) {
            const auto& places = particles_.emplace_back(places_of(&Figure::particles, i));
            are_known = are_known && places.are_known();
            if (places.after != detail::no_row) now_of_after_[places.after] = places.now;
        }
        for (std::size_t i = 0; i < links; ++i)
            are_known = are_known && is_.constraints[i].kind == wanted_.constraints[i].kind &&
                        is_.constraints[i].kind == was_.constraints[i].kind &&
                        places_of(&Figure::constraints, i).are_known();
        return are_known;
    }
    bool is_pinned() const {
        return std::ranges::any_of(world_.pins, [&](const auto& pin) {
            const auto row = row_of(world_, pin.particle);
            return row && world_.particles.figure[*row] == index_;
        });
    }

    template <class Column>
    static void take_changed(const Column& before, const Column& after, Column& now, const Places& places) {
        if (!is_same_row(before, places.before, after, places.after)) copy_row(after, places.after, now, places.now);
    }
    void change_particle(const Places& places) {
        const auto &b = before_.particles, &a = after_.particles;
        auto& now = world_.particles;
        take_changed(b.inverse_mass, a.inverse_mass, now.inverse_mass, places);
        take_changed(b.radius, a.radius, now.radius, places);
        take_changed(b.rolls, a.rolls, now.rolls, places);
        take_changed(b.inertia, a.inertia, now.inertia, places);
        detail::refresh_mobility(world_, places.now);
    }
    void change_constraint(std::size_t i) {
        const auto places = places_of(&Figure::constraints, i);
        visit_table(world_, is_.constraints[i].kind, [&]<class Table>(Table& now) {
            const auto &b = std::get<Table>(before_.constraints), &a = std::get<Table>(after_.constraints);
            const auto take_all = [&](auto... column) {
                (take_changed(b.*column, a.*column, now.*column, places), ...);
            };
            take_all(&Table::limits, &Table::compliance, &Table::relaxation, &Table::split, &Table::max_force,
                     &Table::damping_time, &Table::motor_speed, &Table::motorized, &Table::breaking_strain,
                     &Table::break_force, &Table::damage_limit);
        });
    }

    /// Everything but names, parts and ids.
    void change_looks() {
        auto next = wanted_;
        next.name = is_.name;
        next.particles = is_.particles, next.constraints = is_.constraints;
        next.particle_names = is_.particle_names, next.constraint_names = is_.constraint_names;
        next.quarantined = is_.quarantined, next.faces_wind = is_.faces_wind;
        next.generation = is_.generation;
        next.fragments = is_.fragments;
        for (auto& piece : next.pieces) piece.particles = own(piece.particles);
        if (!is_.fragments.empty()) next.pieces = is_.pieces; // as a cut has left them
        is_ = std::move(next);
    }
    IdList<ParticleId> own(const IdList<ParticleId>& described) const {
        IdList<ParticleId> list;
        for (const auto id : described) {
            const Row after = row_in(after_, id), now = after == detail::no_row ? detail::no_row : now_of_after_[after];
            list.push_back(now == detail::no_row ? ParticleId{} : world_.particles.handles.id_of(now));
        }
        return list;
    }

    /// The figure with its pins, which are displaced alone.
    void move(const Similarity<D>& by) {
        move_by(world_, is_, by);
        for (auto& pin : world_.pins) {
            const auto row = row_of(world_, pin.particle);
            if (!row || world_.particles.figure[*row] != index_) continue;
            const auto shift = cast<Real>(by.to - by.from);
            pin.from += shift, pin.target += shift;
        }
    }
};

} // namespace

std::string change_figure(AnyWorld& any, FigureIndex figure, const Descriptions& descriptions) {
    return std::visit(
        [&]<class WorldT>(WorldT& world) {
            const auto *before = std::get_if<WorldT>(&descriptions.before),
                       *after = std::get_if<WorldT>(&descriptions.after);
            SINEW_ASSERT(before && after, "descriptions are of the dimension and the precision of the world");
            SINEW_ASSERT(has_figure(world, figure), "the figure is in the world");
            return FigureChange<WorldT>(world, figure, *before, *after).run();
        },
        any);
}

} // namespace sinew
