#include "sinew/math/sort.h"
#include "sinew/solver/contact/candidate_renewal.h"
#include "sinew/solver/contact/nested_solids.h"

#include <algorithm>

/// List of the pairs of features that may touch: made anew, or renewed around particles that left their forecast.
namespace sinew {
namespace {

template <int D, class Real> class CandidateFinder {
  public:
    using Vector = Vec<D, Real>;

    CandidateFinder(World<D, Real>& world, Solver<D, Real>& solver, Real left, Real h)
        : state_(solver.sweep_state), room_(contact_room(solver)), list_(room_.list), search_(world, room_),
          left_(left), h_(h), threads_(threads_for(room_.particles.size(), solver.options.threads_wanted())) {}

    bool holds() {
        list_.age += h_;
        if (!list_.is_valid || list_.h != h_ || list_.position.size() != room_.particles.size() || !have_same_size()) {
            list_.is_valid = false;
            return false;
        }
        find_astray();
        return list_.astray.empty();
    }
    void run() {
        set_aside();
        list_.was_renewed = can_renew();
        list_.was_renewed ? detail::CandidateRenewal<D, Real>(state_, room_, search_, h_).run() : make();
        note_slots();
        list_.is_valid = true;
    }

  private:
    SweepState<D, Real>& state_;
    ContactRoom<D, Real>& room_;
    detail::ContactList<D, Real>& list_;
    detail::CandidateSearch<D, Real> search_;
    Real left_, h_; ///< rest of the step, and a substep
    int threads_;

    static constexpr int chunks = 64;
    static_assert(chunks >= int(contact_parts), "found pairs by chunks or by parts");

    Real squared(const Vector& v) const { return dot(v, v); }
    std::uint32_t particles() const { return std::uint32_t(room_.particles.size()); }

    // --- validity ----------------------------------------------------------------------------------------------------

    bool have_same_size() const {
        for (std::size_t i = 0; i < room_.particles.size(); ++i)
            if (list_.radius[i] != room_.particles[i].radius) return false;
        return true;
    }
    /// Lists what is astray: particles that deviate by more than the margin from their expected place, or whose
    /// displacement in this substep does so by more than a quarter of that, since a blow hands on speed. With them come
    /// those that are half as far off: else a list of many slow particles would be renewed in every substep.
    void find_astray() {
        const Real time = min(list_.age, list_.horizon), next = list_.age < list_.horizon ? h_ : Real(0);
        const Real off = square(list_.margin), change = square(Real(0.25) * list_.margin);
        list_.astray.clear();
        bool any = false;
        for (std::uint32_t i = 0; i < particles(); ++i) {
            const Row slot = room_.particles[i].slot;
            const auto& v = list_.velocity[i];
            const Real far = squared(state_.position_at(slot) - list_.position[i] - v * (time - list_.born[i]));
            const Real faster = squared(state_.displacement_at(slot) - v * next);
            if (far <= Real(0.25) * off && faster <= Real(0.25) * change) continue;
            list_.astray.push_back(i);
            any = any || !(far <= off) || !(faster <= change);
        }
        if (!any) list_.astray.clear();
    }
    /// A list of which more than a quarter was renewed costs more than a new one.
    bool can_renew() const {
        return list_.is_valid && list_.nested.empty() &&
               4 * (list_.renewed.size() + list_.astray.size()) < room_.particles.size();
    }

    void set_aside() {
        list_.before.swap(list_.candidates);
        list_.multipliers_before.swap(room_.multipliers);
        list_.follows_last = list_.is_valid;
        for (std::size_t i = 0; i < room_.parts.list.size(); ++i) list_.end_before[i] = room_.parts.list[i].last;
    }

    // --- a new list --------------------------------------------------------------------------------------------------

    void make() {
        note_motion();
        find_radii();
        list_.particles.fill(list_.position, std::span(list_.search_radius).first(room_.particles.size()),
                             list_.velocity, list_.radius, list_.figure);
        list_.has_segments = false;
        if constexpr (D == 3) list_.fill_segments(), list_.solids.fill(list_.solid_middle, list_.solid_ball);
        search();
        sort_by_parts();
    }
    void note_motion() {
        list_.position.clear(), list_.velocity.clear();
        list_.radius.clear(), list_.figure.clear();
        list_.renewed.clear(), list_.renewed_segments.clear(), list_.renewed_solids.clear();
        list_.born.assign(room_.particles.size(), 0);
        list_.is_new.assign(room_.particles.size(), 0), list_.is_renewed.assign(room_.particles.size(), 0);
        list_.horizon = horizon();
        list_.age = 0, list_.h = h_;
        Vector sum{};
        for (const auto& particle : room_.particles) {
            list_.position.push_back(state_.position_at(particle.slot));
            list_.velocity.push_back(state_.displacement_at(particle.slot) * (Real(1) / h_));
            list_.radius.push_back(particle.radius), list_.figure.push_back(particle.figure);
            sum += list_.velocity.back();
        }
        list_.mean = sum * inverse_or_zero(Real(list_.velocity.size()));
    }
    /// Twice the time for which the last list was valid, between a few substeps and the rest of the step: among blows a
    /// list that looks far ahead is long, and does not last.
    Real horizon() const {
        const Real last = list_.is_valid ? Real(2) * list_.age : left_;
        return min(left_, max(last, shortest_horizon * h_));
    }
    static constexpr Real shortest_horizon = 4; ///< substeps

    void find_radii() {
        list_.search_radius.clear(), list_.middle.clear(), list_.segment_ball.clear();
        list_.solid_middle.clear(), list_.solid_ball.clear();
        for (std::uint32_t i = 0; i < particles(); ++i) list_.search_radius.push_back(search_.radius_of(i));
        for (const auto& s : room_.segments) {
            list_.search_radius.push_back(search_.radius_of(s));
            const auto &a = list_.position[s.number_a], &b = list_.position[s.number_b];
            list_.middle.push_back((a + b) * Real(0.5));
            list_.segment_ball.push_back(Real(0.5) * distance(a, b) + list_.search_radius.back());
        }
        for (const auto& solid : room_.polyhedra.solids) {
            list_.search_radius.push_back(search_.radius_of(solid));
            const auto box = search_.box_in_frame(solid);
            list_.solid_middle.push_back((box.low + box.high) * Real(0.5));
            list_.solid_ball.push_back(Real(0.5) * distance(box.low, box.high) + list_.search_radius.back());
        }
    }

    /// Features of a chunk find those with lower numbers.
    void search() {
        const auto segments = room_.particles.size() + room_.segments.size();
        const auto features = std::uint32_t(segments + room_.polyhedra.solids.size());
        list_.found.resize(chunks);
        Workers::run(threads_, chunks, [&](int chunk) {
            auto& found = list_.found[std::size_t(chunk)];
            found.clear();
            const auto first = std::uint32_t(std::uint64_t(features) * std::uint64_t(chunk) / chunks),
                       last = std::uint32_t(std::uint64_t(features) * std::uint64_t(chunk + 1) / chunks);
            for (auto feature = first; feature < last; ++feature) {
                const auto begun = found.size();
                const auto list = [&](std::uint32_t other) { found.push_back({feature, other}); };
                search_.each_lower(feature, list);
                const bool is_segment = feature >= particles() && feature < segments;
                if (is_segment && !list_.nested.empty())
                    search_.each_nested(room_.segments[feature - particles()], list);
                const auto own = found.begin() + std::ptrdiff_t(begun);
                sinew::sort(own, found.end());
                found.erase(std::unique(own, found.end()), found.end());
            }
        });
    }
    void sort_by_parts() {
        auto& parts = room_.parts.list;
        for (auto& part : parts) part.first = part.last = 0;
        std::uint32_t all = 0;
        for (const auto& found : list_.found)
            for (const auto& pair : found) ++parts[part_of(room_, pair)].last, ++all;
        std::uint32_t begin = 0;
        for (auto& part : parts) {
            const auto size = part.last;
            part.first = part.last = begin;
            begin += size;
        }
        list_.candidates.resize(all);
        for (const auto& found : list_.found)
            for (const auto& pair : found) list_.candidates[parts[part_of(room_, pair)].last++] = pair;
    }

    bool is_nested(std::uint32_t particle, const ContactSegment& s) const {
        if (list_.nested.empty() || s.side == 0) return false;
        return list_.is_nested(detail::Solids<D, Real>(room_, state_).of(particle), s.first);
    }
    /// Numbers for the first look at a pair in each substep (simd/near_pairs.h). Pairs of segments, and of solids
    /// in space, are always looked at closely.
    void note_slots() {
        const auto all = list_.candidates.size();
        list_.near_p.resize(all), list_.near_a.resize(all), list_.near_b.resize(all), list_.near_size.resize(all);
        const auto count = room_.particles.size();
        const auto put = [&](std::size_t i, std::uint32_t p, std::uint32_t a, std::uint32_t b, Real size) {
            list_.near_p[i] = room_.particles[p].slot;
            list_.near_a[i] = room_.particles[a].slot, list_.near_b[i] = room_.particles[b].slot;
            list_.near_size[i] = size + list_.near_by;
        };
        for (std::size_t i = 0; i < all; ++i) {
            const auto [first, second] = list_.candidates[i];
            if (first < count) {
                put(i, first, second, second, search_.size_of(first) + search_.size_of(second));
                continue;
            }
            if (room_.is_solid(first)) {
                put(i, second, second, second, std::numeric_limits<Real>::infinity());
                continue;
            }
            const auto& s = room_.segments[first - count];
            if (second < count && !is_nested(second, s))
                put(i, second, s.number_a, s.number_b, search_.size_of(second) + search_.size_of(s));
            else if (second < count)
                put(i, second, s.number_a, s.number_b, std::numeric_limits<Real>::infinity());
            else
                put(i, s.number_a, s.number_a, s.number_b, std::numeric_limits<Real>::infinity());
        }
    }
};

} // namespace

template <int D, class Real> void find_nested_solids(World<D, Real>& world, Solver<D, Real>& solver) {
    auto& room = contact_room(solver);
    if constexpr (D == 2) detail::NestedSolids<D, Real>(world, room, solver.sweep_state).find();
}

template <int D, class Real>
bool find_contact_candidates(World<D, Real>& world, Solver<D, Real>& solver, Real left, Real h) {
    CandidateFinder<D, Real> finder(world, solver, left, h);
    if (finder.holds()) return false;
    finder.run();
    return true;
}

/// Adds the particles that have gone astray, in order.
template <class Room, class IsNear> static void add_astray(Room& room, const IsNear& is_near) {
    for (const auto i : room.list.astray) {
        if (room.is_of_cloth(room.particles[i].row) || !is_near(i)) continue;
        auto& listed = room.parts.list[room.particles[i].strip].near_planes;
        const auto at = std::lower_bound(listed.begin(), listed.end(), i);
        if (at == listed.end() || *at != i) listed.insert(at, i);
    }
}

template <int D, class Real>
void find_near_planes(const World<D, Real>& world, ContactRoom<D, Real>& room, Real margin, bool all) {
    const auto& list = room.list;
    const auto is_near = [&](std::uint32_t i) {
        const Real far = norm(list.velocity[i]) * (list.horizon + Real(2) * list.h) + Real(2) * list.margin + margin +
                         Real(1.1) * room.particles[i].radius;
        return std::any_of(world.bounds.begin(), world.bounds.end(), [&](const auto& plane) {
            return dot(plane.normal, list.position[i]) - plane.offset <= far;
        });
    };
    if (!all && list.was_renewed) return add_astray(room, is_near);
    for (auto& part : room.parts.list) {
        part.near_planes.clear();
        for (const auto i : part.particles)
            if (is_near(i)) part.near_planes.push_back(i);
    }
}

#define SINEW_CONTACT_CANDIDATES(D, Real)                                                                              \
    template void find_nested_solids(World<D, Real>&, Solver<D, Real>&);                                               \
    template bool find_contact_candidates(World<D, Real>&, Solver<D, Real>&, Real, Real);                              \
    template void find_near_planes(const World<D, Real>&, ContactRoom<D, Real>&, Real, bool);
SINEW_INSTANTIATE(SINEW_CONTACT_CANDIDATES)

} // namespace sinew
