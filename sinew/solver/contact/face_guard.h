#pragma once

#include "sinew/solver/contact/face_rows.h"
#include "sinew/solver/contact/row_solver.h"
#include "sinew/solver/contact/strike_search.h"

namespace sinew::detail {

/// Last look at the displacements of a substep: no particle crosses a face, and no link an edge. Blows along the
/// normals at the impacts come first; what they do not part moves on as one (inelastic zones: Harmon et al., Robust
/// Treatment of Simultaneous Collisions, 2008), which keeps the momentum and never adds energy; in the end motions are
/// cut short.
template <class Real> class FaceGuard {
  public:
    FaceGuard(const World<3, Real>& world, SweepState<3, Real>& state, FaceRoom<3, Real>& room,
              const ContactFilter& filter, Real h)
        : state_(state), room_(room), search_(world, state, room), rows_(state, room, filter, Real(0), h),
          solver_(state, max_displacement(h)) {}

    /// True if a displacement has changed. `cuts_only`: displacements only become shorter.
    bool hold(bool cuts_only) {
        int round = cuts_only ? first_cut : 0;
        bool any = false;
        for (; find_hits(); ++round, any = true) {
            if (round < first_zone)
                strike();
            else if (round < first_cut)
                unite();
            else
                cut(round < first_stop ? Real(0.9) : Real(0));
        }
        for (const Row slot : room_.zoned) room_.zone_of[slot] = slot;
        room_.zoned.clear();
        return any;
    }

  private:
    static constexpr int first_zone = 16, first_cut = 60, first_stop = 80; ///< rounds

    SweepState<3, Real>& state_;
    FaceRoom<3, Real>& room_;
    StrikeSearch<Real> search_;
    FaceRows<Real> rows_;
    RowSolver<3, Real> solver_;

    bool find_hits() {
        room_.hits.clear();
        search_.each_pair([&](Real radius) { return share_kept * radius + grain(); },
                          [&](const StrikePair<Real>& pair) { look_at(pair); });
        return !room_.hits.empty();
    }
    /// Distance that any pair keeps: beyond the rounding of coordinates.
    static constexpr Real share_kept = Real(0.02);
    Real grain() const { return Real(16) * std::numeric_limits<Real>::epsilon() * search_.furthest(); }
    double floor_of(const StrikePair<Real>& pair) const { return double(share_kept * pair.thickness + grain()); }
    /// Distance that a pair keeps in a substep: pairs nearer than the floor come hardly nearer.
    static double kept(double floor, double distance) { return min(floor, 0.9 * distance); }

    void look_at(const StrikePair<Real>& pair) {
        if (pair.side == StrikeSide::inside) return;
        const auto motion = search_.motion(pair);
        const auto near = motion.near_at_start();
        const double floor = floor_of(pair), distance = kept(floor, near.distance);
        if (near.distance < 1e-3 * floor) return; // in touch from the beginning: no side to stay on
        const double spare = near.distance - distance;
        if (spare > motion.fastest()) return;
        const auto impact = first_impact(motion, near, distance, min(0.1 * spare, 0.5 * floor));
        Real friction = 0;
        if (impact.is_found &&
            rows_.is_admitted(pair, motion, impact.near, near.distance - double(pair.thickness), friction))
            room_.hits.push_back({pair, impact});
    }

    void strike() {
        for (const auto& hit : room_.hits) {
            const auto motion = search_.motion(hit.pair);
            const double spare = motion.near_at_start().distance - hit.impact.near.distance;
            const double lift = min(floor_of(hit.pair), 0.5 * spare);
            if (rows_.add(hit.pair, motion, hit.impact, -lift))
                solver_.solve(room_.rows.back(), Softness<Real>::hard());
        }
    }

    // --- zones -------------------------------------------------------------------------------------------------------

    Row root_of(Row slot) const {
        while (room_.zone_of[slot] != slot) slot = room_.zone_of[slot];
        return slot;
    }
    void unite() {
        for (const auto& hit : room_.hits)
            for (const Row slot : hit.pair.slot) {
                room_.zoned.push_back(slot);
                const Row a = root_of(slot), b = root_of(hit.pair.slot[0]);
                room_.zone_of[std::max(a, b)] = std::min(a, b);
            }
        sinew::sort(room_.zoned.begin(), room_.zoned.end());
        room_.zoned.erase(std::unique(room_.zoned.begin(), room_.zoned.end()), room_.zoned.end());
        move_as_one();
    }
    void move_as_one() {
        for (const Row slot : room_.zoned) room_.momentum[slot] = {}, room_.mass[slot] = 0;
        for (const Row slot : room_.zoned) {
            constexpr double held = 1e30;
            const Real mobility = state_.mobility[slot];
            const double mass = mobility > Real(0) ? 1 / double(mobility) : held;
            const Row root = root_of(slot);
            room_.momentum[root] += cast<double>(state_.displacement_at(slot)) * mass;
            room_.mass[root] += mass;
        }
        for (const Row slot : room_.zoned) {
            const Row root = root_of(slot);
            if (state_.mobility[slot] > Real(0))
                state_.set_displacement(slot, cast<Real>(room_.momentum[root] * inverse_or_zero(room_.mass[root])));
        }
    }

    void cut(Real share) {
        for (const auto& hit : room_.hits)
            for (const Row slot : hit.pair.slot)
                state_.set_displacement(slot, state_.displacement_at(slot) * (share * Real(hit.impact.share)));
    }
};

} // namespace sinew::detail
