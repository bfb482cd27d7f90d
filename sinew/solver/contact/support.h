#pragma once

#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/contact/row_solver.h"

namespace sinew::detail {

/// Figures that walls hold up, and figures on these. Of two pressed together, the one nearer to the wall does not give
/// way, since its support answers in the same substep (shock propagation: Guendelman, Bridson and Fedkiw 2003).
/// Otherwise a heavy figure would sink into a light one by nearly all of its speed, once a round.
template <int D, class Real> class Support {
  public:
    using RowT = ContactRow<D, Real>;
    using Vector = Vec<D, Real>;

    Support(ContactRoom<D, Real>& room, const RowSolver<D, Real>& rows) : room_(room), rows_(rows) {}

    /// Finds the figures that walls hold, those on these, and so on.
    void find() {
        const auto& links = room_.projector.links();
        room_.supports.assign(links.components.size() + links.component_of.size(), {});
        room_.held_up.clear();
        bool any = false;
        for (auto& part : room_.parts.list)
            for (auto i = part.first_wall; i < part.rows.size(); ++i)
                if (const auto& row = part.rows[i]; touches(row, part.origins[i]))
                    any = hold_up(of(row.slot[0]), {&row, &part.origins[i]}, 0) || any;
        for (std::uint32_t level = 0; any && level < max_level; ++level) {
            any = false;
            for (auto& part : room_.parts.list)
                for (std::size_t i = 0; i < part.first_wall; ++i)
                    if (const auto& row = part.rows[i]; touches(row, part.origins[i]))
                        any = spread(row, part.origins[i], level) || any;
        }
    }
    /// The row as it acts, without the side that does not give way, and that side.
    struct Acting {
        RowT row;
        std::uint32_t held = FigureSupport<D, Real>::none;
    };
    Acting acting(const RowT& row) const {
        const auto sides = sides_of(row);
        if (!sides) return {row};
        const auto [above, below] = *sides;
        if (at(below).level < at(above).level && holds(below, row.normal)) return without(row, below);
        if (at(above).level < at(below).level && holds(above, -row.normal)) return without(row, above);
        return {row};
    }
    /// Notes an impulse on the side that does not give way.
    void load(const Acting& acting, const RowT& row, Real impulse) const {
        const bool is_below = acting.held == (*sides_of(row))[1];
        at(acting.held).load += row.normal * (is_below ? impulse : -impulse);
    }
    /// Tells the rows that hold up a loaded figure of their shares, down to the walls. Rows are listed from the walls
    /// on.
    void pass_loads_on() const {
        for (auto i = room_.held_up.size(); i-- > 0;) {
            auto& holding = room_.held_up[i];
            const auto load = at(holding.figure).load;
            const Real along = along_of(holding, load);
            if (along == Real(0)) continue;
            Real sum = 0;
            for (auto k = at(holding.figure).last; k != none; k = room_.held_up[k].previous)
                sum += along_of(room_.held_up[k], load);
            const Real share = norm(load) * along * inverse_or_zero(sum);
            holding.origin->pushed += share;
            if (holding.on != none) at(holding.on).load += holding.row->normal * (holding.side * share);
        }
    }

  private:
    static constexpr std::uint32_t none = FigureSupport<D, Real>::none;
    static constexpr std::uint32_t max_level = 64; // figures on top of each other
    ContactRoom<D, Real>& room_;
    const RowSolver<D, Real>& rows_;

    /// Index of the component, or of a particle without links.
    std::uint32_t of(Row slot) const {
        const auto& links = room_.projector.links();
        const auto component = links.component_of[slot];
        return component != RigidLinks<D, Real>::none ? component : std::uint32_t(links.components.size() + slot);
    }
    FigureSupport<D, Real>& at(std::uint32_t figure) const { return room_.supports[figure]; }
    /// The figure on the normal's side of a row, and the other one; none if a figure is on both.
    std::optional<std::array<std::uint32_t, 2>> sides_of(const RowT& row) const {
        std::array<std::uint32_t, 2> sides{no_figure, no_figure};
        for (std::size_t i = 0; i < std::size_t(row.members); ++i) {
            if (row.weight[i] == Real(0)) continue;
            auto& side = sides[row.weight[i] > Real(0) ? 0 : 1];
            if (side != no_figure && side != of(row.slot[i])) return std::nullopt;
            side = of(row.slot[i]);
        }
        if (sides[0] == sides[1] || sides[0] == no_figure || sides[1] == no_figure) return std::nullopt;
        return sides;
    }
    Acting without(const RowT& row, std::uint32_t side) const {
        Acting acting{row, side};
        for (std::size_t i = 0; i < std::size_t(row.members); ++i)
            if (of(row.slot[i]) == side) acting.row.weight[i] = 0;
        return acting;
    }
    static Real along_of(const HoldingRow<D, Real>& holding, const Vector& load) {
        return max(dot(holding.row->normal * holding.side, load), Real(0));
    }
    bool touches(const RowT& row, const ContactOrigin<D, Real>& origin) const {
        return row.multiplier > Real(0) || row.gap + rows_.change(row, origin.surface_displacement) <= Real(0);
    }
    bool holds(std::uint32_t figure, const Vector& normal) const {
        constexpr auto least = Real(0.7); // cosine
        const auto& support = at(figure);
        return support.level != none && dot(support.normals, normal) > least * norm(support.normals);
    }
    bool hold_up(std::uint32_t figure, HoldingRow<D, Real> holding, std::uint32_t level) {
        auto& support = at(figure);
        if (support.level < level) return false;
        support.level = level, support.normals += holding.row->normal * holding.side;
        holding.figure = figure, holding.previous = support.last;
        support.last = std::uint32_t(room_.held_up.size());
        room_.held_up.push_back(holding);
        return true;
    }
    bool spread(const RowT& row, ContactOrigin<D, Real>& origin, std::uint32_t level) {
        const auto sides = sides_of(row);
        if (!sides) return false;
        const auto [above, below] = *sides;
        if (at(below).level == level && holds(below, row.normal))
            return hold_up(above, {&row, &origin, below}, level + 1);
        if (at(above).level == level && holds(above, -row.normal))
            return hold_up(below, {&row, &origin, above, Real(-1)}, level + 1);
        return false;
    }
};

} // namespace sinew::detail
