#pragma once

#include "sinew/world/constraint_graph.h"
#include "sinew/world/edit.h"

#include <span>

namespace sinew {

/// Binds virtual nodes to the cloth on their side of a cut. The base of a node is a particle corner of the fragment;
/// the axes lead from the base to two neighbours. Fragments on either side of a cut thread find the same base and axes,
/// so their edges stay together.
template <int D, class Real> class NodeBinder {
  public:
    /// Keeps a reference to the world, whose adjacency must be listed.
    explicit NodeBinder(const World<D, Real>& world) : world_(world) {}

    /// Binds the unbound corners.
    void bind(Piece& piece, Fragment& fragment) const {
        for (std::size_t i = 0; i < fragment.corners.size(); ++i) {
            auto& corner = fragment.corners[i];
            if (corner.count > 0) continue;
            const auto base = base_of(fragment, i);
            if (!base) continue;
            const auto a = piece.particles[fragment.corners[*base].of[0]];
            corner = bound(a, Vec3<double>(corner.at), piece.particles);
            corner.of[0] = fragment.corners[*base].of[0];
        }
    }

  private:
    /// Pair of neighbours with the best span of the cloth; quality from 0 (collinear) to 1 (orthogonal, equally long).
    struct Axes {
        Row b = 0, c = 0;
        double quality = 0;
    };

    const World<D, Real>& world_;

    Vec3<double> position(Row row) const {
        Vec3<double> wide{};
        for (int i = 0; i < D; ++i) wide[i] = double(world_.particles.position[row][i]);
        return wide;
    }

    /// The particle corner before, after, or opposite.
    static std::optional<std::size_t> base_of(const Fragment& fragment, std::size_t corner) {
        for (const std::size_t further : {3U, 1U, 2U})
            if (fragment.corners[(corner + further) % 4].is_particle()) return (corner + further) % 4;
        return std::nullopt;
    }

    std::vector<Row> neighbours_of(Row row) const {
        std::vector<Row> rows;
        const auto& distances = std::get<kind_number<Distance, D>>(world_.constraints);
        for_each_link(world_, row, [&](Row link, Row other) {
            if (ties(distances, link)) rows.push_back(other);
        });
        return rows;
    }

    Axes axes_at(Row base, std::span<const Row> near) const {
        Axes best;
        const auto a = position(base);
        for (std::size_t i = 0; i < near.size(); ++i)
            for (std::size_t k = i + 1; k < near.size(); ++k) {
                const auto b = position(near[i]) - a, c = position(near[k]) - a;
                const double quality = 2 * norm(cross(b, c)) * inverse_or_zero(dot(b, b) + dot(c, c));
                if (quality > best.quality) best = {near[i], near[k], quality};
            }
        return best;
    }

    VirtualNode bound(ParticleId base, const Vec3<double>& at, IdList<ParticleId>& particles) const {
        constexpr double min_quality = 0.1, furthest = 4; // times the axes
        VirtualNode node{.count = 1, .at = at};
        const auto row = row_of(world_, base);
        if (!row) return node;
        const auto way = at - position(*row);
        node.at = way;
        const auto near = neighbours_of(*row);
        const auto depends_on = [&](Row other, std::uint8_t number) {
            node.of[number] = std::uint8_t(particles.size());
            node.count = std::uint8_t(number + 1);
            particles.push_back(world_.particles.handles.id_of(other));
        };
        if (const auto axes = axes_at(*row, near); axes.quality > min_quality) {
            const auto b = position(axes.b) - position(*row), c = position(axes.c) - position(*row), n = cross(b, c);
            const double scale = 1 / dot(n, n);
            const Vec3<double> shares{
                {dot(cross(way, c), n) * scale, dot(cross(b, way), n) * scale, D == 2 ? 0 : dot(way, direction(n))}};
            if (absolute(shares[0]) + absolute(shares[1]) > furthest) return node;
            depends_on(axes.b, 1);
            depends_on(axes.c, 2);
            node.at = shares;
        } else if (D == 2 && !near.empty()) {
            const auto b = position(near[0]) - position(*row);
            const double scale = inverse_or_zero(dot(b, b));
            const Vec3<double> shares{{dot(way, b) * scale, (way[1] * b[0] - way[0] * b[1]) * scale, 0}};
            if (absolute(shares[0]) + absolute(shares[1]) > furthest) return node;
            depends_on(near[0], 1);
            node.at = shares;
        }
        return node;
    }
};

} // namespace sinew
