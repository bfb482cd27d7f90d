#pragma once

#include "sinew/world/edit.h"

#include <optional>

namespace sinew {

/// A similarity of a figure: x becomes to + scale R (x - from), with R a rotation in the plane of the screen.
template <int D> struct Similarity {
    Vec<D, double> from{}, to{}; ///< means of the particles
    Vec2<double> turn{{1, 0}};   ///< cosine and sine
    double scale = 1;
    bool is_identity = true; ///< bit for bit

    /// True for a displacement alone.
    bool is_translation() const {
        constexpr double exact = 1e-6; // as similarity_of
        return absolute(scale - 1) <= exact && absolute(turn[0] - 1) <= exact && absolute(turn[1]) <= exact;
    }
    Vec<D, double> rotated(Vec<D, double> v) const {
        const double x = v[0], y = v[1];
        v[0] = turn[0] * x - turn[1] * y;
        v[1] = turn[1] * x + turn[0] * y;
        return v;
    }
    /// The same about another middle, which is displaced as the means are.
    Vec<D, double> apply(const Vec<D, double>& x, const Vec<D, double>& middle) const {
        return middle + (to - from) + rotated(x - middle) * scale;
    }
};

/// Mean position of a figure's particles that are left.
template <class WorldT> Vec<WorldT::dimension, double> middle_of(const WorldT& world, const Figure& figure) {
    Vec<WorldT::dimension, double> sum{};
    double count = 0;
    for (const auto id : figure.particles)
        if (const auto row = row_of(world, id)) sum += cast<double>(world.particles.position[*row]), ++count;
    return count > 0 ? sum * (1 / count) : sum;
}

/// The similarity that makes one figure the other, particle by particle, to a millionth of its size; nothing if there
/// is none. Least squares in the plane of the screen: with complex numbers, sum conj(a) b / sum |a|^2.
template <class WorldT>
std::optional<Similarity<WorldT::dimension>> similarity_of(const WorldT& before, const Figure& was, const WorldT& after,
                                                           const Figure& is) {
    constexpr int D = WorldT::dimension;
    if (was.particles.size() != is.particles.size()) return std::nullopt;
    Similarity<D> found{.from = middle_of(before, was), .to = middle_of(after, is)};
    std::vector<std::array<Vec<D, double>, 2>> pairs;
    double real = 0, imaginary = 0, flat = 0, extent = 0, grown = 0;
    for (std::size_t i = 0; i < is.particles.size(); ++i) {
        const auto a = row_of(before, was.particles[i]), b = row_of(after, is.particles[i]);
        if (!a || !b) return std::nullopt;
        if (before.particles.position[*a] != after.particles.position[*b]) found.is_identity = false;
        const auto p = cast<double>(before.particles.position[*a]) - found.from;
        const auto q = cast<double>(after.particles.position[*b]) - found.to;
        real += p[0] * q[0] + p[1] * q[1];
        imaginary += p[0] * q[1] - p[1] * q[0];
        flat += p[0] * p[0] + p[1] * p[1];
        extent += dot(p, p), grown += dot(q, q);
        pairs.push_back({p, q});
    }
    if (found.is_identity || (extent == 0 && grown == 0)) return found;
    if (extent == 0 || grown == 0) return std::nullopt;
    found.scale = square_root(grown / extent);
    const double length = square_root(real * real + imaginary * imaginary);
    if (flat > 0 && length > 0) found.turn = {{real / length, imaginary / length}};
    constexpr double tolerance = 1e-6; // of the size; a world of float has 1e-7
    for (const auto& [p, q] : pairs)
        if (!(norm(found.rotated(p) * found.scale - q) <= tolerance * square_root(grown))) return std::nullopt;
    return found;
}

/// Moves a running figure, with its velocities, about its present middle.
template <class WorldT> void move_by(WorldT& world, const Figure& figure, const Similarity<WorldT::dimension>& by) {
    using Real = typename WorldT::Real;
    const auto middle = middle_of(world, figure);
    auto& p = world.particles;
    for (const auto id : figure.particles) {
        const auto row = row_of(world, id);
        if (!row) continue;
        const auto before = cast<double>(p.position[*row] - p.previous[*row]);
        p.position[*row] = cast<Real>(by.apply(cast<double>(p.position[*row]), middle));
        p.previous[*row] = p.position[*row] - cast<Real>(by.rotated(before));
        p.velocity[*row] = cast<Real>(by.rotated(cast<double>(p.velocity[*row])));
        p.residual[*row] = {};
    }
}

} // namespace sinew
