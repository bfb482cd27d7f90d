#pragma once

#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/contact/row_solver.h"

namespace sinew::detail {

/// Adds rows of contact to a part at the start of a substep.
template <int D, class Real> class RowWriter {
  protected:
    using Vector = Vec<D, Real>;
    using ContactRowT = ContactRow<D, Real>;
    using Origin = ContactOrigin<D, Real>;

    World<D, Real>& world_;
    Particles<D, Real>& p_;
    SweepState<D, Real>& state_;
    ContactRoom<D, Real>& room_;
    ContactPart<D, Real>& part_;
    Real h_;
    RowSolver<D, Real> rows_{state_, max_displacement(h_)};
    const ContactFilter& filter_;
    static constexpr Real share_of_deep = Origin::share_of_deep;
    static constexpr std::size_t most_held = 256; ///< in a part: the cost of each grows with its figure

    RowWriter(World<D, Real>& world, Solver<D, Real>& solver, ContactPart<D, Real>& part, Real h)
        : world_(world), p_(world.particles), state_(solver.sweep_state), room_(contact_room(solver)), part_(part),
          h_(h), filter_(solver.options.contact_filter) {}

    Vector position(Row row) const { return state_.position_at(state_.slot_of[row]); }
    Vector displacement(Row row) const { return state_.displacement_at(state_.slot_of[row]); }

    /// Heaviest load of a figure, as a multiple of a particle's mass. Under a person a rope as soft as for the rope
    /// alone would sink in as many times deeper.
    Real load_on(Row slot) const {
        return room_.projector.is_in_cluster(slot) ? Real(1) : room_.projector.heaviest(slot) * state_.mobility[slot];
    }
    /// Share of the load that is felt: limbs of bodies, up to ten times as heavy as each other, rest on soft rows.
    static constexpr Real share_of_load = Real(0.1);
    /// Load from which the passes of a substep no longer suffice: a row acts on the whole figure.
    static constexpr Real much = 1000;
    /// Two figures are turned at arms that meet, however far apart they are when the blow is foreseen: what one
    /// receives of angular momentum the other gives.
    Real arm_of(const ContactRowT& row, const Origin& origin) const {
        bool any = row.levers > 0;
        for (std::size_t i = 0; i < row.members; ++i)
            any = any || (RowSolver<D, Real>::is_ball(row, i) && state_.rolls(row.slot[i]));
        if (!any) return 0;
        return origin.thickness > Real(0) ? origin.arm_at(norm(rows_.centre_line(row))) : Real(1);
    }
    static void take(ContactRowT& row, Row slot, Real weight) {
        row.slot[row.members] = slot;
        row.weight[row.members++] = weight;
    }

    /// Adds a row that may touch within the substep: gap <= 2 approach + slack. True if so.
    bool add(ContactRowT& row, Origin& origin, Real slack) {
        Real response = 0, approach = dot(row.normal, origin.surface_displacement);
        for (int i = 0; i < row.members; ++i) {
            const auto slot = row.slot[std::size_t(i)];
            const Real weight = row.weight[std::size_t(i)];
            response += square(weight) * state_.mobility[slot];
            approach -= weight * dot(row.normal, state_.displacement_at(slot));
        }
        return admit(row, origin, response, approach, slack);
    }
    bool admit(ContactRowT& row, Origin& origin, Real response, Real approach, Real slack) {
        if (response == Real(0) || row.gap > Real(2) * absolute(approach) + slack) return false;
        origin.approach = approach;
        if (!is_admitted(row, origin)) return false;
        std::uint32_t component = 0;
        for (int i = 0; i < row.members; ++i) {
            const auto slot = row.slot[std::size_t(i)];
            row.keeps = row.keeps && room_.is_exact[slot];
            row.acts_on_clusters = row.acts_on_clusters || room_.projector.is_in_cluster(slot);
            const Real load = load_on(slot);
            row.load = max(row.load, share_of_load * load);
            if (load > much) row.is_held = true, component = room_.projector.links().component_of[slot];
        }
        row.is_held = row.is_held && row.keeps && part_.held.size() < most_held;
        for (std::size_t i = row.members; i < row.slot.size(); ++i) row.slot[i] = row.slot[0]; // of no weight
        row.arm = arm_of(row, origin);
        rows_.take_levers(row);
        row.is_central = row.keeps && row.members > 1 && origin.thickness > Real(0) && rows_.is_central(row);
        row.mass = Real(1) / response;
        row.tangent -= row.normal * dot(row.normal, row.tangent);
        part_.rows.push_back(row);
        part_.origins.push_back(origin);
        if (row.is_held) part_.held.push_back({.row = std::uint32_t(part_.rows.size() - 1), .component = component});
        const bool is_crossing = D == 3 && row.members == 4 && !RowSolver<D, Real>::is_ball(row, 0);
        const Real ahead = is_crossing ? Real(2) * absolute(approach) : Real(0);
        if (row.keeps && row.gap - ahead < Real(-0.5) * origin.deep)
            part_.deep.push_back(std::uint32_t(part_.rows.size() - 1));
        return true;
    }

    /// The program's answer, which may change friction and restitution.
    bool is_admitted(ContactRowT& row, Origin& origin) const {
        if (!filter_) return true;
        PendingContact contact{.particle = state_.row_of[row.slot[0]],
                               .gap = double(row.gap),
                               .speed = double(origin.approach / h_),
                               .friction = double(row.friction),
                               .restitution = double(origin.restitution)};
        for (std::size_t i = row.members; i-- > 0;)
            if (row.weight[i] < Real(0)) contact.other = state_.row_of[row.slot[i]];
        if (contact.other == PendingContact::none && origin.collider < world_.colliders.size())
            contact.collider = origin.collider;
        contact.set_normal(row.normal);
        if (!filter_.ask(contact)) return false;
        row.friction = Real(contact.friction), origin.restitution = Real(contact.restitution);
        return true;
    }
};

} // namespace sinew::detail
