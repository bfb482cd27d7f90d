#pragma once

#include "sinew/solver/contact/contact_room.h"

/// Bound of a warm start. Rows that hold take back the speed that forces have just added, and the multipliers of the
/// last substep do so again. Beside other rows, at other places or on bodies slowed down since, these may add energy
/// instead, and more in each substep. An island of bodies whose energy grows many times by them gets the share s of
/// them at which its kinetic energy, a parabola
///
///     T(s) = T0 + b s + a s^2,    a = sum of m |d1 - d0|^2 / 2
///
/// is least. Islands that something moving pushes are left alone. Energies are times h^2.
namespace sinew::detail {

template <int D, class Real> class WarmStart {
  public:
    WarmStart(ContactRoom<D, Real>& room, SweepState<D, Real>& state) : room_(room), state_(state) {}

    /// Notes the displacements before the multipliers act.
    void note() {
        room_.warm_from.resize(state_.size());
        room_.rims_from.resize(state_.rollers.size());
        for (Row slot = 0; slot < state_.size(); ++slot) room_.warm_from[slot] = state_.displacement_at(slot);
        for (Row slot = 0; slot < room_.rims_from.size(); ++slot) room_.rims_from[slot] = state_.rollers[slot].rim;
    }
    /// After these have acted, with the links held.
    void bound() {
        measure();
        if (std::ranges::none_of(room_.warm_gains, [](const auto& body) { return body.is_large(); })) return;
        join();
        for (std::uint32_t body = 0; body < room_.warm_gains.size(); ++body)
            if (const auto first = room_.groups.first_of(body); first != body)
                room_.warm_gains[first] += room_.warm_gains[body];
        keep_shares();
    }

  private:
    ContactRoom<D, Real>& room_;
    SweepState<D, Real>& state_;

    std::uint32_t body_of(Row slot) const { return room_.projector.body_of(slot); }
    bool is_movable(Row slot) const { return state_.mobility[slot] > Real(0); }
    double share_of(Row slot) { return room_.warm_gains[room_.groups.first_of(body_of(slot))].share(); }

    void measure() {
        room_.warm_gains.assign(room_.projector.bodies(), {});
        for (Row slot = 0; slot < state_.size(); ++slot) {
            if (!is_movable(slot)) continue;
            auto& body = room_.warm_gains[body_of(slot)];
            body.add(room_.warm_from[slot], state_.displacement_at(slot), state_.mobility[slot]);
            if (state_.rolls(slot))
                body.add(room_.rims_from[slot], state_.rollers[slot].rim, state_.rim_mobility(slot));
        }
    }
    /// Joins the bodies that rows have pushed.
    void join() {
        room_.groups.reset(room_.projector.bodies());
        for (auto& part : room_.parts.list)
            for (std::size_t i = 0; i < part.rows.size(); ++i) {
                const auto& row = part.rows[i];
                if (!(row.multiplier > Real(0))) continue;
                const auto members = std::span(row.slot).first(std::size_t(row.members));
                const auto first = std::ranges::find_if(members, [&](Row slot) { return is_movable(slot); });
                if (first == members.end()) continue;
                auto& body = room_.warm_gains[body_of(*first)];
                body.is_pushed = body.is_pushed || part.origins[i].surface_displacement != Vec<D, Real>{};
                for (const Row slot : members)
                    if (is_movable(slot))
                        room_.groups.join(body_of(*first), body_of(slot));
                    else
                        body.is_pushed = body.is_pushed || state_.displacement_at(slot) != Vec<D, Real>{};
            }
    }
    void keep_shares() {
        const auto keep = [&](Row slot) { return Real(share_of(slot)); };
        for (auto& part : room_.parts.list)
            for (auto& row : part.rows)
                for (std::size_t i = 0; i < std::size_t(row.members); ++i)
                    if (is_movable(row.slot[i])) {
                        row.multiplier *= keep(row.slot[i]), row.tangent *= keep(row.slot[i]);
                        break;
                    }
        room_.joints.scale([&](Row slot) { return is_movable(slot) ? keep(slot) : Real(1); });
        for (Row slot = 0; slot < state_.size(); ++slot) {
            if (!is_movable(slot)) continue;
            const Real share = keep(slot);
            if (share == Real(1)) continue;
            const auto from = room_.warm_from[slot];
            state_.set_displacement(slot, from + (state_.displacement_at(slot) - from) * share);
            if (!state_.rolls(slot)) continue;
            auto& rim = state_.rollers[slot].rim;
            rim = room_.rims_from[slot] + (rim - room_.rims_from[slot]) * share;
        }
    }
};

} // namespace sinew::detail
