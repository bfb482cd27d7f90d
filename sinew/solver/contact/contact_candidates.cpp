#include "sinew/math/sort.h"
#include "sinew/solver/contact/collider_sweep.h"
#include "sinew/solver/contact/contact_room.h"

#include <algorithm>

/// Search for the pairs of features that may touch.
namespace sinew {
namespace {

template <int D, class Real> class CandidateFinder {
  public:
    using Vector = Vec<D, Real>;

    CandidateFinder(World<D, Real>& world, Solver<D, Real>& solver, Real left, Real h)
        : world_(world), state_(solver.sweep_state), room_(contact_room(solver)), list_(room_.list), left_(left), h_(h),
          threads_(threads_for(room_.particles.size(), solver.options.threads)) {}

    bool holds() {
        list_.age += h_;
        return list_.is_valid && list_.h == h_ && list_.position.size() == room_.particles.size() && have_same_size() &&
               move_as_expected();
    }

    void run() {
        set_aside();
        note_motion();
        find_reaches();
        list_.particles.fill(list_.position, std::span(list_.reach).first(room_.particles.size()), list_.velocity,
                             list_.size, list_.figure);
        if constexpr (D == 3) list_.segments.fill(list_.middle, list_.segment_ball);
        search();
        sort_by_parts();
        note_slots();
        list_.is_valid = true;
    }

  private:
    World<D, Real>& world_;
    SweepState<D, Real>& state_;
    ContactRoom<D, Real>& room_;
    detail::ContactList<D, Real>& list_;
    Real left_, h_; ///< rest of the step, and a substep
    int threads_;

    static constexpr int chunks = 64;

    Real squared(const Vector& v) const { return dot(v, v); }

    // --- validity ----------------------------------------------------------------------------------------------------

    bool have_same_size() const {
        for (std::size_t i = 0; i < room_.particles.size(); ++i)
            if (list_.radius[i] != room_.particles[i].radius || list_.cover[i] != room_.particles[i].cover)
                return false;
        return true;
    }
    /// True if nothing deviates by more than the margin from its expected place, nor its displacement in this substep
    /// by more than a quarter of that: a blow hands on speed.
    bool move_as_expected() const {
        const Real time = min(list_.age, list_.horizon), next = list_.age < list_.horizon ? h_ : Real(0);
        const Real off = square(list_.margin), change = square(Real(0.25) * list_.margin);
        for (std::size_t i = 0; i < room_.particles.size(); ++i) {
            const Row slot = room_.particles[i].slot;
            const auto& v = list_.velocity[i];
            if (!(squared(state_.position_at(slot) - list_.position[i] - v * time) <= off) ||
                !(squared(state_.displacement_at(slot) - v * next) <= change))
                return false;
        }
        return true;
    }

    void set_aside() {
        list_.before.swap(list_.candidates);
        list_.multipliers_before.swap(room_.multipliers);
        for (std::size_t i = 0; i < room_.parts.list.size(); ++i) list_.end_before[i] = room_.parts.list[i].last;
    }

    // --- search ------------------------------------------------------------------------------------------------------

    void note_motion() {
        list_.position.clear(), list_.velocity.clear();
        list_.radius.clear(), list_.cover.clear(), list_.figure.clear(), list_.size.clear();
        list_.horizon = horizon();
        list_.age = 0, list_.h = h_;
        for (const auto& particle : room_.particles) {
            list_.position.push_back(state_.position_at(particle.slot));
            list_.velocity.push_back(state_.displacement_at(particle.slot) * (Real(1) / h_));
            list_.radius.push_back(particle.radius), list_.cover.push_back(particle.cover);
            list_.figure.push_back(particle.figure), list_.size.push_back(max(particle.radius, particle.cover));
        }
    }
    /// Twice the time for which the last list was valid, between a substep and the rest of the step: among blows a list
    /// that looks far ahead is long, and does not last.
    Real horizon() const {
        const Real last = list_.is_valid ? Real(2) * list_.age : left_;
        return min(left_, max(last, h_));
    }
    /// Time for which a relative speed brings features nearer to each other: rows look two substeps ahead.
    Real time_ahead() const { return list_.horizon + Real(2) * h_; }

    void find_reaches() {
        Vector mean{};
        for (const auto& velocity : list_.velocity) mean += velocity;
        mean *= inverse_or_zero(Real(list_.velocity.size()));
        list_.reach.clear(), list_.middle.clear(), list_.segment_ball.clear();
        const auto way = [&](std::uint32_t i) { return norm(list_.velocity[i] - mean) * time_ahead(); };
        for (std::uint32_t i = 0; i < room_.particles.size(); ++i)
            list_.reach.push_back(size_of(i) + Real(2) * list_.margin + list_.near_by + way(i));
        for (const auto& s : room_.segments) {
            const auto &a = list_.position[s.number_a], &b = list_.position[s.number_b];
            list_.reach.push_back(size_of(s) + Real(2) * list_.margin + list_.near_by +
                                  max(way(s.number_a), way(s.number_b)));
            if constexpr (D == 2) continue;
            list_.middle.push_back((a + b) * Real(0.5));
            list_.segment_ball.push_back(Real(0.5) * distance(a, b) + list_.reach.back());
        }
    }
    Real size_of(std::uint32_t particle) const {
        return max(room_.particles[particle].radius, room_.particles[particle].cover);
    }
    /// A filled area pushes out what is in its skin.
    Real size_of(const ContactSegment& s) const {
        const Real radius = min(room_.particles[s.number_a].radius, room_.particles[s.number_b].radius);
        return s.side != 0 ? radius + Real(2) * list_.widest : radius;
    }

    /// Features of a chunk find those with lower numbers.
    void search() {
        const auto features = std::uint32_t(room_.particles.size() + room_.segments.size());
        list_.found.resize(chunks);
        Workers::run(threads_, chunks, [&](int chunk) {
            auto& found = list_.found[std::size_t(chunk)];
            found.clear();
            const auto first = std::uint32_t(std::uint64_t(features) * std::uint64_t(chunk) / chunks),
                       last = std::uint32_t(std::uint64_t(features) * std::uint64_t(chunk + 1) / chunks);
            for (auto feature = first; feature < last; ++feature) {
                const auto begun = found.size();
                search_around(feature, found);
                sinew::sort(found.begin() + std::ptrdiff_t(begun), found.end());
            }
        });
    }
    void search_around(std::uint32_t feature, std::vector<ContactCandidate>& found) const {
        const auto count = std::uint32_t(room_.particles.size());
        if (feature < count) {
            const auto& particle = room_.particles[feature];
            if (particle.in_segment) return;
            list_.particles.each_near(seeker(feature, feature, feature, size_of(feature)), [&](auto other) {
                if (other < feature && are_near(feature, other) && may_touch(feature, other))
                    found.push_back({feature, other});
            });
            return;
        }
        const auto& segment = room_.segments[feature - count];
        const auto &a = list_.position[segment.number_a], &b = list_.position[segment.number_b];
        const auto number_a = segment.number_a, number_b = segment.number_b;
        list_.particles.each_near(seeker(feature, number_a, number_b, size_of(segment)), [&](auto other) {
            if (are_near(segment, feature, other) && may_touch(other, segment)) found.push_back({feature, other});
        });
        if constexpr (D == 3)
            list_.segments.each_near(box_around(a, b).grown(list_.reach[feature]), [&](std::uint32_t other) {
                if (other + count < feature && are_near(segment, feature, room_.segments[other], other + count) &&
                    may_touch(segment, room_.segments[other]))
                    found.push_back({feature, other + count});
            });
    }

    auto seeker(std::uint32_t feature, std::uint32_t a, std::uint32_t b, Real size) const {
        return typename detail::FeatureGrid<D, Real>::Seeker{.a = list_.position[a],
                                                             .b = list_.position[b],
                                                             .velocity_a = list_.velocity[a],
                                                             .velocity_b = list_.velocity[b],
                                                             .reach = list_.reach[feature],
                                                             .near = size + slack(),
                                                             .ahead = time_ahead(),
                                                             .group = group_of(room_.particles[a].figure)};
    }
    static collide::BoundingBox<D, Real> box_around(const Vector& a, const Vector& b) {
        collide::BoundingBox<D, Real> box;
        box.include(a);
        box.include(b);
        return box;
    }
    /// Figure whose particles need not be looked at.
    std::uint32_t group_of(FigureIndex figure) const {
        return world_.figures[figure].touches_itself ? no_figure : figure;
    }

    // --- distances ---------------------------------------------------------------------------------------------------

    Real slack() const { return Real(4) * list_.margin + Real(2) * list_.near_by; }
    /// Largest distance at which features that close in at a relative speed may touch while the list holds.
    bool is_within(Real squared_distance, Real sizes, Real squared_speed) const {
        const Real max = sizes + slack() + square_root(squared_speed) * time_ahead();
        return squared_distance <= square(max);
    }
    bool are_near(std::uint32_t a, std::uint32_t b) const {
        const Real far = squared(list_.position[a] - list_.position[b]);
        return far <= square(list_.reach[a] + list_.reach[b]) &&
               is_within(far, size_of(a) + size_of(b), squared(list_.velocity[a] - list_.velocity[b]));
    }
    bool are_near(const ContactSegment& s, std::uint32_t feature, std::uint32_t p) const {
        const auto &a = list_.position[s.number_a], &b = list_.position[s.number_b], &x = list_.position[p];
        const auto far = squared(x - (a + (b - a) * collide::nearest_parameter(a, b, x)));
        if (!(far <= square(list_.reach[feature] + list_.reach[p]))) return false;
        const auto& v = list_.velocity[p];
        const Real speed = max(squared(v - list_.velocity[s.number_a]), squared(v - list_.velocity[s.number_b]));
        return is_within(far, size_of(p) + size_of(s), speed);
    }
    bool are_near(const ContactSegment& s, std::uint32_t feature_s, const ContactSegment& t,
                  std::uint32_t feature_t) const {
        const auto &a = list_.position[s.number_a], &b = list_.position[s.number_b];
        const auto &c = list_.position[t.number_a], &d = list_.position[t.number_b];
        const auto at = collide::nearest_parameters(a, b, c, d);
        const auto far = squared(a + (b - a) * at.s - (c + (d - c) * at.t));
        return far <= square(list_.reach[feature_s] + list_.reach[feature_t]);
    }

    // --- kinds of pairs ----------------------------------------------------------------------------------------------

    bool may_touch(std::uint32_t i, std::uint32_t k) const {
        const auto &a = room_.particles[i], &b = room_.particles[k];
        return !a.in_segment && !b.in_segment && meets(a.row, b.row) && !are_linked(a.row, b.row);
    }
    bool may_touch(std::uint32_t particle, const ContactSegment& segment) const {
        const Row row = room_.particles[particle].row;
        return row != segment.a && row != segment.b && meets(row, segment.a) && !are_linked(row, segment.a) &&
               !are_linked(row, segment.b);
    }
    bool may_touch(const ContactSegment& s, const ContactSegment& t) const {
        return meets(s.a, t.a) && s.a != t.a && s.a != t.b && s.b != t.a && s.b != t.b && !are_linked(s.a, t.a) &&
               !are_linked(s.a, t.b) && !are_linked(s.b, t.a) && !are_linked(s.b, t.b);
    }
    bool meets(Row a, Row b) const {
        if (room_.is_of_cloth(a) && room_.is_of_cloth(b)) return false; // cloth_contact.h
        const auto figure_a = world_.particles.figure[a], figure_b = world_.particles.figure[b];
        if (figure_a == figure_b) return world_.figures[figure_a].touches_itself;
        return touch(detail::filter_of(world_, a), detail::filter_of(world_, b));
    }
    bool are_linked(Row a, Row b) const {
        if (room_.links.empty()) return false;
        const std::array<Row, 2> pair = {std::min(a, b), std::max(a, b)};
        return std::binary_search(room_.links.begin(), room_.links.end(), pair);
    }

    // --- order -------------------------------------------------------------------------------------------------------

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

    /// Numbers for the first look at a pair in each substep (simd/near_pairs.h). Pairs of segments are always looked
    /// at closely.
    void note_slots() {
        list_.near_p.clear(), list_.near_a.clear(), list_.near_b.clear(), list_.near_size.clear();
        const auto count = room_.particles.size();
        const auto add = [&](std::uint32_t p, std::uint32_t a, std::uint32_t b, Real size) {
            list_.near_p.push_back(room_.particles[p].slot);
            list_.near_a.push_back(room_.particles[a].slot), list_.near_b.push_back(room_.particles[b].slot);
            list_.near_size.push_back(size + list_.near_by);
        };
        for (const auto& [first, second] : list_.candidates) {
            if (first < count) {
                add(first, second, second, size_of(first) + size_of(second));
                continue;
            }
            const auto& s = room_.segments[first - count];
            if (second < count)
                add(second, s.number_a, s.number_b, size_of(second) + size_of(s));
            else
                add(s.number_a, s.number_a, s.number_b, std::numeric_limits<Real>::infinity());
        }
    }
};

} // namespace

template <int D, class Real>
bool find_contact_candidates(World<D, Real>& world, Solver<D, Real>& solver, Real left, Real h) {
    CandidateFinder<D, Real> finder(world, solver, left, h);
    if (finder.holds()) return false;
    finder.run();
    return true;
}

template <int D, class Real>
void find_near_planes(const World<D, Real>& world, ContactRoom<D, Real>& room, Real reach) {
    const auto& list = room.list;
    const auto is_near = [&](std::uint32_t i) {
        const Real far = norm(list.velocity[i]) * (list.horizon + Real(2) * list.h) + Real(2) * list.margin + reach +
                         Real(1.1) * room.particles[i].radius;
        return std::any_of(world.bounds.begin(), world.bounds.end(), [&](const auto& plane) {
            return dot(plane.normal, list.position[i]) - plane.offset <= far;
        });
    };
    for (auto& part : room.parts.list) {
        part.near_planes.clear();
        for (const auto i : part.particles)
            if (is_near(i)) part.near_planes.push_back(i);
    }
}

#define SINEW_CONTACT_CANDIDATES(D, Real)                                                                              \
    template bool find_contact_candidates(World<D, Real>&, Solver<D, Real>&, Real, Real);                              \
    template void find_near_planes(const World<D, Real>&, ContactRoom<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_CONTACT_CANDIDATES)

} // namespace sinew
