#pragma once

#include "sinew/math/scalar.h"
#include "sinew/math/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::detail {

/// Link within a cluster, by numbers of the cluster's particles.
struct RestLink {
    std::uint32_t a = 0, b = 0;
    double length = 0;
};

/// Shape of particles from the lengths of the links between them. The bits follow from the lengths, and from the sides
/// on which the particles lie, alone.
template <int D> class RestShape {
  public:
    using Vector = Vec<D, double>;
    std::vector<Vector> places; ///< the mean is zero for equal masses

    /// `links` hold `count` particles, each of which has D links to those before it, the second one and in space the
    /// third one less. `present(particle)`: present places. False if the lengths contradict each other.
    template <class Present>
    bool find(std::span<const RestLink> links, std::size_t count, const Present& present) {
        places.assign(count, {});
        for (std::uint32_t i = 1; i < count; ++i)
            if (!place(links, i, present)) return false;
        for (int round = 0; round < rounds; ++round) spread_errors(links);
        for (const auto& link : links)
            if (!(absolute(norm(places[link.b] - places[link.a]) - link.length) <= tolerance * link.length))
                return false;
        return true;
    }

  private:
    static constexpr int rounds = 30;         ///< lengths in floats contradict each other by their rounding
    static constexpr double tolerance = 1e-4; ///< share of a length
    static constexpr double flattest = 1e-3;  ///< height of a simplex as a share of a length

    /// Other ends, with their links' lengths, of the links to particles before one.
    struct Known {
        std::uint32_t particle = 0;
        double length = 0;
    };
    std::vector<Known> known_;

    template <class Present> bool place(std::span<const RestLink> links, std::uint32_t i, const Present& present) {
        known_.clear();
        for (const auto& link : links)
            if (link.a == i && link.b < i)
                known_.push_back({link.b, link.length});
            else if (link.b == i && link.a < i)
                known_.push_back({link.a, link.length});
        if (i == 1) return known_.size() == 1 && put_second();
        if constexpr (D == 2)
            return put_beside_best(i, present);
        else
            return i == 2 ? put_third() : put_above_best(i, present);
    }
    bool put_second() {
        places[1][0] = known_[0].length;
        return known_[0].length > 0;
    }
    /// Coordinates from a and b on: along a-b, and the distance from that line; negative if there is none.
    std::array<double, 2> triangle(const Known& a, const Known& b, double between) const {
        const double along = (square(a.length) - square(b.length) + square(between)) * inverse_or_zero(2 * between);
        return {along, square(a.length) - square(along)};
    }
    template <class Present> bool put_beside_best(std::uint32_t i, const Present& present) requires(D == 2) {
        double best = flattest;
        for (std::size_t m = 0; m < known_.size(); ++m)
            for (std::size_t n = m + 1; n < known_.size(); ++n) {
                const auto &a = known_[m], &b = known_[n];
                const auto way = places[b.particle] - places[a.particle];
                const double between = norm(way);
                const auto [along, height2] = triangle(a, b, between);
                const double height = square_root(max(height2, 0.0));
                const double share = height * inverse_or_zero(max(a.length, b.length));
                if (!(share > best)) continue;
                best = share;
                const auto from = cast<double>(present(a.particle)), to = cast<double>(present(b.particle));
                const double side = cross(to - from, cast<double>(present(i)) - from) < 0 ? -1 : 1;
                const auto unit = way * (1 / between);
                places[i] = places[a.particle] + unit * along + perpendicular(unit) * (side * height);
            }
        return best > flattest;
    }
    bool put_third() {
        if (known_.size() != 2) return false;
        const auto [along, height2] = triangle(known_[0].particle == 0 ? known_[0] : known_[1],
                                               known_[0].particle == 0 ? known_[1] : known_[0], places[1][0]);
        const double height = square_root(max(height2, 0.0));
        places[2][0] = along, places[2][1] = height;
        return height > flattest * places[1][0];
    }
    template <class Present> bool put_above_best(std::uint32_t i, const Present& present) requires(D == 3) {
        double best = flattest;
        for (std::size_t m = 0; m < known_.size(); ++m)
            for (std::size_t n = m + 1; n < known_.size(); ++n)
                for (std::size_t k = n + 1; k < known_.size(); ++k)
                    best = max(best, put_above(i, {known_[m], known_[n], known_[k]}, best, present));
        return best > flattest;
    }
    /// Places a particle by three spheres if its height over them is better; returns that, as a share of its lengths.
    template <class Present>
    double put_above(std::uint32_t i, const std::array<Known, 3>& known, double best, const Present& present) {
        const auto &[a, b, c] = known;
        const auto x = direction(places[b.particle] - places[a.particle]);
        const auto way = places[c.particle] - places[a.particle];
        const double c_along = dot(x, way);
        const auto y = direction(way - x * c_along);
        const double c_across = dot(y, way), between = norm(places[b.particle] - places[a.particle]);
        if (!(c_across > flattest * between)) return 0;
        const double along = triangle(a, b, between)[0];
        const double across = (square(a.length) - square(c.length) + square(c_along) + square(c_across) -
                               2 * along * c_along) / (2 * c_across);
        const double height = square_root(max(square(a.length) - square(along) - square(across), 0.0));
        const double share = height * inverse_or_zero(max(a.length, max(b.length, c.length)));
        if (!(share > best)) return 0;
        const auto from = cast<double>(present(a.particle));
        const auto to = [&](std::uint32_t p) { return cast<double>(present(p)) - from; };
        const double side = dot(cross(to(b.particle), to(c.particle)), to(i)) < 0 ? -1 : 1;
        places[i] = places[a.particle] + x * along + y * across + cross(x, y) * (side * height);
        return share;
    }
    void spread_errors(std::span<const RestLink> links) {
        for (const auto& link : links) {
            const auto way = places[link.b] - places[link.a];
            const double length = norm(way);
            const auto half = way * (0.5 * (length - link.length) * inverse_or_zero(length));
            places[link.a] += half, places[link.b] -= half;
        }
    }
};

} // namespace sinew::detail
