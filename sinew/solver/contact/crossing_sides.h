#pragma once

#include "sinew/solver/contact/contact_room.h"

namespace sinew::detail {

/// Sides on which crossing links of figures are of each other in space: without them links pressed until their axes
/// pass each other would be pushed on. A side is the sign of the product of both directions and the way between the
/// nearest points. A contact that slides to a neighbouring link or to the particle between two links while it is
/// pressed through hands that over, and not the side: where a line winds around another or folds back over it, links
/// beside each other may have either side.
template <class Real> class CrossingSides {
  public:
    using Vector = Vec3<Real>;

    CrossingSides(const SweepState<3, Real>& state, const ContactRoom<3, Real>& room)
        : state_(state), room_(room), count_(std::uint32_t(room.particles.size())) {}

    /// Side of `away`, the way from a line along v to one along u: 1 or -1, or 0 where they hardly cross there.
    static int side_of(const Vector& away, const Vector& u, const Vector& v) {
        const auto axis = cross(u, v);
        const Real along = dot(axis, away), across = dot(axis, axis), far = dot(away, away);
        if (across < square(least_sine) * dot(u, u) * dot(v, v)) return 0;
        if (square(along) < square(least_cosine) * across * far) return 0;
        return along < Real(0) ? -1 : 1;
    }
    /// Direction of the line at a particle; zero at an end where no link begins.
    Vector direction_at(std::uint32_t particle) const {
        const auto next = link_from(particle);
        if (next == none) return {};
        const auto last = before(next);
        return position(room_.segments[next].number_b) -
               position(last == none ? particle : room_.segments[last].number_a);
    }

    /// Side kept by a pair; of a new one the present side, or the other where a pair beside it is pressed through.
    int kept(std::uint32_t pair, int present) const {
        if (const int own = room_.multipliers[pair].side; own != 0) return own;
        const auto [first, second] = room_.list.candidates[pair];
        for (const auto other : beside(first))
            if (is_through(other, second)) return -present;
        for (const auto other : beside(second))
            if (is_through(first, other)) return -present;
        return present;
    }

  private:
    static constexpr auto none = ~std::uint32_t(0);
    static constexpr Real least_sine = Real(0.3);   ///< between lines that cross
    static constexpr Real least_cosine = Real(0.7); ///< between the way and the axis of both lines
    const SweepState<3, Real>& state_;
    const ContactRoom<3, Real>& room_;
    std::uint32_t count_; ///< particles

    Vector position(std::uint32_t particle) const { return state_.position_at(room_.particles[particle].slot); }

    std::uint32_t link_from(std::uint32_t particle) const {
        const auto at = room_.first_segment_at[particle];
        return at < room_.first_segment_at[particle + 1] ? room_.segments_at[at] : none;
    }
    std::uint32_t before(std::uint32_t link) const {
        return link > 0 && room_.segments[link - 1].number_b == room_.segments[link].number_a ? link - 1 : none;
    }
    std::uint32_t after(std::uint32_t link) const {
        const auto next = link + 1;
        return next < room_.segments.size() && room_.segments[next].number_a == room_.segments[link].number_b ? next
                                                                                                              : none;
    }
    std::uint32_t feature(std::uint32_t link) const { return link == none ? none : count_ + link; }

    /// Features beside a particle, or beside a link and at its ends.
    std::array<std::uint32_t, 4> beside(std::uint32_t number) const {
        if (number < count_) {
            const auto next = link_from(number), last = next == none ? none : before(next);
            return {feature(next), feature(last), next == none ? none : room_.segments[next].number_b,
                    last == none ? none : room_.segments[last].number_a};
        }
        const auto link = number - count_;
        return {room_.segments[link].number_a, room_.segments[link].number_b, feature(before(link)),
                feature(after(link))};
    }
    /// True if the pair of two features has kept the side on which it no longer is.
    bool is_through(std::uint32_t a, std::uint32_t b) const {
        const int side = of(a, b);
        return side != 0 && side_of(away(a, b), direction_of(a), direction_of(b)) == -side;
    }
    Vector direction_of(std::uint32_t number) const {
        if (number < count_) return direction_at(number);
        const auto [start, end] = ends_of(number);
        return end - start;
    }
    /// Way from the nearest point of b to that of a.
    Vector away(std::uint32_t a, std::uint32_t b) const {
        const auto [p, q] = ends_of(a);
        const auto [r, s] = ends_of(b);
        const auto at = collide::nearest_parameters(p, q, r, s);
        return p + (q - p) * at.s - (r + (s - r) * at.t);
    }
    std::pair<Vector, Vector> ends_of(std::uint32_t number) const {
        if (number < count_) return {position(number), position(number)};
        const auto& link = room_.segments[number - count_];
        return {position(link.number_a), position(link.number_b)};
    }
    /// Side kept by the pair of two features, if it is listed.
    int of(std::uint32_t a, std::uint32_t b) const {
        if (a == none || b == none || (a < count_ && b < count_)) return 0;
        const ContactCandidate pair{std::max(a, b), std::min(a, b)};
        const auto& part = room_.parts.list[part_of(room_, pair)];
        const auto begin = room_.list.candidates.begin() + part.first, end = room_.list.candidates.begin() + part.last;
        const auto found = std::lower_bound(begin, end, pair);
        if (found == end || *found != pair) return 0;
        return room_.multipliers[std::size_t(found - room_.list.candidates.begin())].side;
    }
};

} // namespace sinew::detail
