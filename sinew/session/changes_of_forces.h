#pragma once

#include "sinew/session/changes_merge.h"

#include <array>
#include <optional>
#include <vector>

namespace sinew::detail {

/// Forces of the scene, changed or removed by calls, and further ones, added by calls and events.
template <class WorldT> class ForceMerge {
    using Law = Force<WorldT::dimension, typename WorldT::Real>;
    using Pull = Attractor<WorldT::dimension, typename WorldT::Real>;

  public:
    explicit ForceMerge(Merge<WorldT>& merged) : all_(merged), is_taken_(merged.fresh.forces.size(), 0) {}

    void merge_all() {
        for (Row row = 0; row < all_.base.forces.size(); ++row) merge_described(row);
        for (const auto id : gone_) all_.fresh.forces.remove(id);
        for (Row row = 0; row < all_.old.forces.size(); ++row)
            if (all_.old.forces.tag_of(row) >= all_.base.forces.size()) add(row);
        adopt_ids();
    }

  private:
    Merge<WorldT>& all_;
    std::vector<char> is_taken_;                 ///< by row of the new world: a force of the old scene goes on there
    std::vector<std::array<ForceId, 2>> same_{}; ///< ids in the new world and in the old one
    std::vector<ForceId> gone_{};                ///< in the new world: removed from the old one

    void merge_described(Row row) {
        const auto before = in_fresh(all_.base, all_.base.forces[row]);
        const auto is = before ? place_of(row, *before) : std::nullopt;
        if (!is) return;
        is_taken_[*is] = 1;
        const auto id = all_.fresh.forces.id_of(*is);
        const auto was = tagged(row);
        if (!was) return gone_.push_back(id);
        same_.push_back({id, all_.old.forces.id_of(*was)});
        if (const auto changed = in_fresh(all_.old, all_.old.forces[*was]))
            merge(*before, *changed, all_.fresh.forces[*is]);
    }
    /// Row of a force of the scene in the new world: the same where the scene has as many, or else that of an equal
    /// one.
    std::optional<Row> place_of(Row row, const Law& law) const {
        const auto& now = all_.fresh.forces;
        if (now.size() == all_.base.forces.size() || row == 0) return row;
        for (Row is = 1; is < now.size(); ++is)
            if (!is_taken_[is] && now[is] == law) return is;
        return std::nullopt;
    }
    std::optional<Row> tagged(std::uint32_t tag) const {
        for (Row row = 0; row < all_.old.forces.size(); ++row)
            if (all_.old.forces.tag_of(row) == tag) return row;
        return std::nullopt;
    }
    /// A force that pulls the figure of the same name in the new world; nothing if there is none.
    std::optional<Law> in_fresh(const WorldT& world, Law law) const {
        auto* pull = std::get_if<Pull>(&law);
        if (!pull || !has_figure(world, pull->figure)) return law;
        const auto figure = find_figure(all_.fresh, world.figures[pull->figure].name);
        if (!figure) return std::nullopt;
        pull->figure = *figure;
        return law;
    }
    void add(Row row) {
        const auto law = in_fresh(all_.old, all_.old.forces[row]);
        if (!law) return all_.lose("a force pulls a figure that would be gone");
        same_.push_back({all_.fresh.forces.push_back(*law), all_.old.forces.id_of(row)});
    }
    void adopt_ids() {
        std::vector<ForceId> wanted(all_.fresh.forces.size());
        for (const auto& [is, was] : same_) wanted[*all_.fresh.forces.row_of(is)] = was;
        all_.fresh.forces.take_over(wanted);
    }
};

} // namespace sinew::detail
