#include "sinew/session/keep_changes.h"

#include "sinew/session/changes_added.h"
#include "sinew/session/changes_described.h"
#include "sinew/session/changes_of_forces.h"
#include "sinew/world/mobility.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace sinew {
namespace {

using namespace detail;

/// Gives the rows of the new world their ids in the old one.
template <class WorldT> class Ids {
  public:
    explicit Ids(Merge<WorldT>& merged) : all_(merged) {}

    void adopt_all(Renamed& renamed) {
        auto& p = all_.fresh.particles;
        const auto particle = adopt(p.handles, Row(p.size()), all_.particles);
        adopt(all_.fresh.collider_handles, Row(all_.fresh.colliders.size()), all_.colliders);
        const auto pins = ids_of(all_.fresh.pin_handles, Row(all_.fresh.pins.size()));
        const auto pin = adopt(all_.fresh.pin_handles, Row(all_.fresh.pins.size()), all_.pins);
        for (const auto& id : pins) renamed.pins.push_back({id, pin(id)});
        for (auto& each : all_.fresh.pins) each.particle = particle(each.particle);
        std::vector<std::function<Id<ConstraintTag>(const Id<ConstraintTag>&)>> of_kind;
        for_each_table(all_.fresh, [&](auto& table) {
            std::vector<std::array<Id<ConstraintTag>, 2>> same;
            for (const auto& [is, was] : all_.constraints)
                if (is.kind == int(of_kind.size())) same.push_back({is.id, was.id});
            const int kind = int(of_kind.size());
            const auto ids = ids_of(table.handles, Row(table.size()));
            of_kind.emplace_back(adopt(table.handles, Row(table.size()), same));
            for (const auto& id : ids) renamed.constraints.push_back({{{kind, id}, {kind, of_kind.back()(id)}}});
        });
        const auto constraint = [&](const ConstraintId& id) {
            return id.kind < 0 ? id : ConstraintId{id.kind, of_kind[std::size_t(id.kind)](id.id)};
        };
        for (auto& figure : all_.fresh.figures) rename(figure, particle, constraint);
        for (Row row = 0; row < p.size(); ++row)
            if (p.mobility[row] != p.inverse_mass[row]) detail::refresh_mobility(all_.fresh, row);
        all_.fresh.journal.adjacency.forget();
        all_.fresh.journal.change_all();
    }

  private:
    Merge<WorldT>& all_;

    template <class Tag> static std::vector<Id<Tag>> ids_of(const HandleMap<Tag>& handles, Row rows) {
        std::vector<Id<Tag>> ids;
        for (Row row = 0; row < rows; ++row) ids.push_back(handles.id_of(row));
        return ids;
    }
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

/// Number of constraints that belong to no figure.
template <class WorldT> std::size_t loose_constraints(const WorldT& world) {
    std::size_t count = 0;
    for_each_table(world, [&](const auto& table) {
        for (Row row = 0; row < table.size(); ++row) count += table.figure[row] == no_figure ? 1 : 0;
    });
    return count;
}
/// Reason why a world of another type loses something: none of its parts goes on.
template <class WorldT> std::string lost_of(const Replacement& worlds, const WorldT& old) {
    const auto base = instantiate(worlds.scene);
    const auto& began = std::get<WorldT>(base);
    const auto is_described = [&](const Figure& figure) { return find_figure(began, figure.name).has_value(); };
    const bool has_added =
        std::ranges::any_of(old.figures,
                            [&](const Figure& figure) { return figure.in_use() && !is_described(figure); }) ||
        std::ranges::find(old.particles.figure, no_figure) != old.particles.figure.end() ||
        old.colliders.size() > began.colliders.size() || old.forces.size() > began.forces.size() ||
        loose_constraints(old) > loose_constraints(began) ||
        old.pins.size() > began.pins.size() + worlds.not_kept.size();
    return has_added
               ? "figures, particles, constraints, pins, colliders and forces that were added cannot go on in another "
                 "dimension or precision"
               : "";
}

/// Keys of a search.
template <class Tag> auto key_of(const Id<Tag>& id) {
    return std::pair(id.index, id.generation);
}
auto key_of(const ConstraintId& id) {
    return std::pair(id.kind, key_of(id.id));
}
constexpr auto key_before = [](const auto& pair) { return key_of(pair[0]); };

template <class IdT> void rename_in(const std::vector<std::array<IdT, 2>>& pairs, IdT& id) {
    const auto found = std::ranges::lower_bound(pairs, key_of(id), {}, key_before);
    if (found != pairs.end() && (*found)[0] == id) id = (*found)[1];
}

} // namespace

void Renamed::sort() {
    std::ranges::sort(pins, {}, key_before);
    std::ranges::sort(constraints, {}, key_before);
}
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
            if (!fresh) return lost_of(worlds, old);
            const auto base = instantiate(worlds.scene);
            Merge<WorldT> merge(std::get<WorldT>(base), worlds, old, *fresh);
            Described<WorldT>(merge).merge_all();
            Added<WorldT> added(merge);
            added.add_all();
            ForceMerge<WorldT>(merge).merge_all();
            Ids<WorldT>(merge).adopt_all(renamed);
            renamed.sort();
            added.copy_figures();
            carry_contacts(old, *fresh);
            return merge.lost;
        },
        worlds.old);
}

} // namespace sinew
