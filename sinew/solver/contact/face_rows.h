#pragma once

#include "sinew/solver/contact/face_room.h"
#include "sinew/solver/sweep_state.h"

namespace sinew::detail {

/// Rows of contact of particles with faces, and of links with edges. Nothing has crossed at the start of a substep, so
/// the nearest points tell the side; but solids know their inside.
template <class Real> class FaceRows {
  public:
    using Vector = Vec3<Real>;
    using RowT = ContactRow<3, Real>;

    /// `near_by`: gap at which rows begin, apart from the approach. `h`: length of the substep.
    FaceRows(const SweepState<3, Real>& state, FaceRoom<3, Real>& room, const ContactFilter& filter, Real near_by,
             Real h)
        : state_(state), room_(room), filter_(filter), near_by_(near_by), h_(h) {}

    /// Adds the row of a pair that may touch in the substep. The points of a slow pair are the nearest at the start,
    /// those of a fast one the nearest at the impact.
    void add(const StrikePair<Real>& pair, const PairMotion& motion) {
        const auto near = motion.near_at_start();
        const double thickness = double(pair.thickness), fastest = motion.fastest();
        if (pair.side == StrikeSide::inside) {
            auto out = near;
            out.normal = -near.normal;
            add(pair, motion, {.near = out}, -min(near.distance + thickness, most_depth * thickness));
            return;
        }
        const double gap = near.distance - thickness;
        if (gap > 2 * fastest + double(near_by_) || near.distance < least_side * thickness) return;
        const bool is_fast = fastest > share_of_fast * thickness && gap > 0;
        const auto impact =
            is_fast ? first_impact(motion, near, thickness, impact_tolerance * thickness) : Impact{.near = near};
        if (impact.is_found)
            add(pair, motion, impact, impact.near.distance - thickness);
        else if (pair.side == StrikeSide::nearest && (!is_fast || gap <= double(near_by_)))
            add(pair, motion, {.near = near}, gap);
    }
    /// Adds the row of a pair whose gap at an impact is known. True if it may be moved.
    bool add(const StrikePair<Real>& pair, const PairMotion& motion, const Impact& impact, double gap) {
        const auto& near = impact.near;
        const double link_share = near.weight[1];
        if (pair.first_side == 2 && !(link_share > 0 && link_share < 1)) return false; // rows of the link's ends
        RowT row;
        row.slot.fill(pair.slot[0]);
        std::ranges::copy(pair.slot, row.slot.begin());
        row.members = 4, row.keeps = false;
        row.normal = cast<Real>(near.normal);
        row.gap = Real(gap - impact.share * dot(near.normal, motion.relative(near)));
        Real response = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            row.weight[i] = Real(near.weight[i]);
            response += square(row.weight[i]) * state_.mobility[pair.slot[i]];
        }
        if (response == Real(0) || is_known(row, pair)) return false;
        row.mass = Real(1) / response;
        row.friction = min(room_.strikers[pair.striker].friction, room_.mesh.friction[pair.vertex]);
        if (!is_admitted(pair, motion, near, gap, row.friction)) return false;
        room_.rows.push_back(row);
        room_.touches.push_back({pair.striker, pair.vertex});
        return true;
    }

    /// The program's answer about a pair, which may change the friction.
    bool is_admitted(const StrikePair<Real>& pair, const PairMotion& motion, const NearestPoints<double>& near,
                     double gap, Real& friction) const {
        if (!filter_) return true;
        PendingContact contact{.particle = state_.row_of[pair.slot[0]],
                               .other = state_.row_of[pair.slot[pair.first_side]],
                               .gap = gap,
                               .speed = -dot(near.normal, motion.relative(near)) / double(h_),
                               .friction = double(friction)};
        contact.set_normal(near.normal);
        const bool answer = filter_.ask(contact);
        friction = Real(contact.friction);
        return answer;
    }

  private:
    const SweepState<3, Real>& state_;
    FaceRoom<3, Real>& room_;
    const ContactFilter& filter_;
    Real near_by_, h_;
    static constexpr double share_of_fast = 0.5;     ///< motion that counts as fast, in thicknesses
    static constexpr double most_depth = 4;          ///< depth that a row sees, in thicknesses
    static constexpr double impact_tolerance = 0.02; ///< in thicknesses
    static constexpr double least_side = 1e-6;       ///< distance from which there is a side, in thicknesses

    /// True if a face beside has the same nearest point.
    bool is_known(const RowT& row, const StrikePair<Real>& pair) const {
        for (auto i = room_.rows.size(); i-- > 0 && room_.touches[i].striker == pair.striker;) {
            const auto& other = room_.rows[i];
            if (dot(other.normal, row.normal) > Real(0.99999) &&
                absolute(other.gap - row.gap) < Real(1e-4) * pair.thickness && is_same_point(row, other))
                return true;
        }
        return false;
    }
    static bool is_same_point(const RowT& a, const RowT& b) {
        for (std::size_t i = 0; i < 4; ++i) {
            Real share = 0;
            for (std::size_t k = 0; k < 4; ++k)
                if (b.slot[k] == a.slot[i]) share = b.weight[k];
            if (absolute(share - a.weight[i]) > Real(1e-4)) return false;
        }
        return true;
    }
};

} // namespace sinew::detail
