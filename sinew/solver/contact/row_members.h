#pragma once

#include "sinew/solver/contact/row_writer.h"

namespace sinew::detail {

/// Members of a row between figures, with the levers of friction, and the row of the last substep.
template <int D, class Real> class RowMembers : protected RowWriter<D, Real> {
    using Base = RowWriter<D, Real>;

  protected:
    using Base::Base, Base::take, Base::add, Base::admit, Base::share_of_deep;
    using Base::state_, Base::room_;
    using typename Base::ContactRowT;
    using typename Base::Origin;
    using Particle = ContactParticle<Real>;

    const ContactList<D, Real>& list_ = room_.list;
    Real near_by_ = list_.near_by, margin_ = list_.margin;
    std::uint32_t source_ = 0; ///< the candidate

    void take(ContactRowT& row, const Particle& p, const Particle& other) const {
        take(row, p.slot, Real(1));
        take(row, other.slot, Real(-1));
        if (!rubs(p, other)) return;
        add_lever(row, 0, p, p.radius);
        add_lever(row, 1, other, other.radius);
    }
    /// A particle, and the point t of a segment.
    void take(ContactRowT& row, const Particle& p, const Particle& a, const Particle& b, Real t) const {
        const Real radius = min(a.radius, b.radius);
        const bool has_lever = rubs(p, a) && radius > Real(0) && is_rigid(a, b);
        take(row, p.slot, Real(1));
        if (has_lever || t < Real(1)) take(row, a.slot, t - Real(1));
        if (has_lever || t > Real(0)) take(row, b.slot, -t);
        if (has_lever) add_lever(row, 1, 2, radius);
        if (rubs(p, a)) add_lever(row, 0, p, p.radius);
    }
    /// A particle, and a face by the shares of its corners. The face turns with all three (ContactRow::is_on_face).
    void take(ContactRowT& row, const Particle& p, std::array<const Particle*, 3> corners,
              const Vec<D, Real>& shares) const {
        const Real radius = min(min(corners[0]->radius, corners[1]->radius), corners[2]->radius);
        take(row, p.slot, Real(1));
        for (int i = 0; i < 3; ++i) take(row, corners[std::size_t(i)]->slot, -shares[i]);
        row.is_on_face = true;
        if (!rubs(p, *corners[0])) return;
        if (radius > Real(0) && is_rigid(*corners[0], *corners[1]) && is_rigid(*corners[0], *corners[2])) {
            add_lever(row, 1, 2, radius);
            row.lever[row.levers++] = {.a = 1, .b = 3};
        }
        add_lever(row, 0, p, p.radius);
    }
    /// The points s and t of two segments.
    void take(ContactRowT& row, std::array<const Particle*, 4> ends, Real s, Real t) const {
        const std::array<Real, 4> weight{Real(1) - s, s, t - Real(1), -t};
        for (std::size_t i = 0; i < 4; ++i) take(row, ends[i]->slot, weight[i]);
        if (!rubs(*ends[0], *ends[2])) return;
        if (is_rigid(*ends[0], *ends[1])) add_lever(row, 0, 1, min(ends[0]->radius, ends[1]->radius));
        if (is_rigid(*ends[2], *ends[3])) add_lever(row, 2, 3, min(ends[2]->radius, ends[3]->radius));
    }
    static bool rubs(const Particle& a, const Particle& b) { return min(a.friction, b.friction) > Real(0); }
    /// True for ends of a link of a rigid body: of a cluster, or of a rod. Ropes and limbs give way to a moment, and
    /// friction acts on their lines.
    bool is_rigid(const Particle& a, const Particle& b) const {
        const auto& links = room_.projector.links();
        const auto clusters = room_.projector.cluster_of();
        if (a.strip != b.strip || clusters[a.slot] != clusters[b.slot]) return false;
        if (clusters[a.slot] != links.none) return true;
        const auto component = links.component_of[a.slot];
        return component != links.none && component == links.component_of[b.slot] && links.is_rod(component);
    }
    /// Lever of a particle, by a link that ends there. A rolling one has a spin of its own.
    void add_lever(ContactRowT& row, std::size_t member, const Particle& p, Real radius) const {
        if (radius == Real(0) || !p.in_segment || state_.rolls(p.slot)) return;
        const auto& beside = room_.particles[p.beside];
        const auto known = row.slots();
        if (!is_rigid(p, beside) || std::ranges::find(known, beside.slot) != known.end()) return;
        take(row, beside.slot, Real(0));
        add_lever(row, member, row.members - std::size_t(1), radius);
    }
    static void add_lever(ContactRowT& row, std::size_t a, std::size_t b, Real radius) {
        if (radius == Real(0)) return;
        row.lever[row.levers++] = {.radius = radius, .a = std::uint8_t(a), .b = std::uint8_t(b)};
    }

    std::uint32_t number_of(const Particle& p) const { return std::uint32_t(&p - room_.particles.data()); }
    /// Corners of boxes side by side are outside of each other by rounding.
    static Real slack_of(Real radius) { return Real(0.01) * radius; }

    // --- rows --------------------------------------------------------------------------------------------------------

    static void set_thickness(Origin& origin, Real thickness, Real deep = share_of_deep) {
        origin.thickness = thickness, origin.deep = deep * thickness;
    }
    bool finish(ContactRowT& row, Origin& origin, const Particle& first, const Particle& second) {
        return add(row, origin, restore(row, origin, first, second));
    }
    /// Takes up the multipliers of the last substep; returns the gap up to which the row acts.
    Real restore(ContactRowT& row, Origin& origin, const Particle& first, const Particle& second) const {
        row.friction = min(first.friction, second.friction);
        origin.restitution = max(first.restitution, second.restitution);
        const auto& kept = room_.multipliers[source_];
        row.multiplier = kept.normal, row.tangent = kept.tangent;
        origin.source = source_;
        return row.multiplier > Real(0) ? near_by_ + margin_ : near_by_;
    }
};

} // namespace sinew::detail
