#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/candidate_search.h"

#include <utility>

namespace sinew::detail {

/// Renewal of a list of candidates around particles gone astray.
template <int D, class Real> class CandidateRenewal {
  public:
    using Vector = Vec<D, Real>;

    CandidateRenewal(const SweepState<D, Real>& state, ContactRoom<D, Real>& room, CandidateSearch<D, Real>& search,
                     Real h)
        : state_(state), room_(room), list_(room.list), search_(search), h_(h) {}

    /// New forecasts for particles gone astray, and a search around it; all other pairs stay. The grids of the list
    /// remain good for the rest in the frame of the mean velocity, since its balls hold the expected motion.
    void run() {
        if (!list_.has_segments) list_.fill_segments();
        forecast_anew();
        fill_renewed();
        for (auto& found : list_.found) found.clear();
        const auto add = [&](std::uint32_t first, std::uint32_t second) {
            const ContactCandidate pair{first, second};
            list_.found[part_of(room_, pair)].push_back(pair);
        };
        for (const auto i : list_.astray) search_.each_around_particle(i, add);
        for (const auto i : list_.astray_segments) search_.each_around_segment(i, add);
        for (const auto i : list_.astray_solids) search_.each_around_solid(i, add);
        merge_by_parts();
        for (const auto i : list_.astray) list_.is_new[i] = 0;
    }

  private:
    const SweepState<D, Real>& state_;
    ContactRoom<D, Real>& room_;
    ContactList<D, Real>& list_;
    CandidateSearch<D, Real>& search_;
    Real h_; ///< a substep

    std::uint32_t particles() const { return std::uint32_t(room_.particles.size()); }

    /// Behind the horizon everything is expected to stay.
    void forecast_anew() {
        const bool stays = list_.age >= list_.horizon;
        for (const auto i : list_.astray) {
            const Row slot = room_.particles[i].slot;
            list_.position[i] = state_.position_at(slot);
            list_.velocity[i] = stays ? Vector{} : state_.displacement_at(slot) * (Real(1) / h_);
            list_.born[i] = min(list_.age, list_.horizon);
            list_.is_new[i] = 1;
            if (!std::exchange(list_.is_renewed[i], char(1))) list_.renewed.push_back(i);
        }
        list_.renewed_segments.clear(), list_.astray_segments.clear();
        for (std::uint32_t i = 0; i < room_.segments.size(); ++i) {
            const auto& s = room_.segments[i];
            if (search_.is_renewed(s)) list_.renewed_segments.push_back(i);
            if (!search_.is_new(s)) continue;
            list_.astray_segments.push_back(i);
            list_.search_radius[particles() + i] = search_.radius_of(s);
        }
        list_.renewed_solids.clear(), list_.astray_solids.clear();
        for (std::uint32_t i = 0; i < room_.polyhedra.solids.size(); ++i) {
            const auto& solid = room_.polyhedra.solids[i];
            if (search_.is_renewed(solid)) list_.renewed_solids.push_back(i);
            if (search_.is_new(solid)) list_.astray_solids.push_back(i);
        }
    }
    void fill_renewed() {
        auto& places = list_.renewed_places;
        auto& balls = list_.renewed_balls;
        places.clear(), balls.clear();
        for (const auto i : list_.renewed) {
            places.push_back(search_.position_in_frame(i));
            balls.push_back(search_.radius_of(i));
        }
        list_.renewed_particles.fill(places, balls);
        places.clear(), balls.clear();
        for (const auto i : list_.renewed_segments) {
            const auto& s = room_.segments[i];
            const auto a = search_.position_in_frame(s.number_a), b = search_.position_in_frame(s.number_b);
            places.push_back((a + b) * Real(0.5));
            balls.push_back(Real(0.5) * distance(a, b) + search_.radius_of(s));
        }
        list_.renewed_segment_grid.fill(places, balls);
        places.clear(), balls.clear();
        for (const auto i : list_.renewed_solids) {
            const auto box = search_.box_in_frame(room_.polyhedra.solids[i]);
            places.push_back((box.low + box.high) * Real(0.5));
            balls.push_back(Real(0.5) * distance(box.low, box.high) + search_.radius_of(room_.polyhedra.solids[i]));
        }
        list_.renewed_solid_grid.fill(places, balls);
    }
    bool is_new(std::uint32_t feature) const {
        const auto count = particles();
        if (feature < count) return list_.is_new[feature] != 0;
        return room_.is_solid(feature) ? search_.is_new(room_.solid(feature))
                                       : search_.is_new(room_.segments[feature - count]);
    }
    /// Former pairs of particles true to their forecast and those found, in order.
    void merge_by_parts() {
        auto& parts = room_.parts.list;
        list_.candidates.clear();
        std::uint32_t old = 0;
        for (std::uint32_t number = 0; number < parts.size(); ++number) {
            auto& found = list_.found[number];
            sinew::sort(found.begin(), found.end());
            parts[number].first = std::uint32_t(list_.candidates.size());
            auto next = found.begin();
            for (; old < list_.end_before[number]; ++old) {
                const auto& pair = list_.before[old];
                if (is_new(pair.first) || is_new(pair.second)) continue;
                while (next != found.end() && *next < pair) list_.candidates.push_back(*next++);
                list_.candidates.push_back(pair);
            }
            list_.candidates.insert(list_.candidates.end(), next, found.end());
            parts[number].last = std::uint32_t(list_.candidates.size());
        }
    }
};

} // namespace sinew::detail
