#pragma once

#include "sinew/prefab/builder.h"

#include <array>
#include <string_view>
#include <vector>

/// A row of particles hanging from the figure's position: shared by ropes, chains, bridges and swings.
namespace sinew {

inline constexpr std::array<std::string_view, 4> strand_ends{"start", "end", "both", "none"};

struct Strand {
    int pieces = 1; ///< links between pieces + 1 particles
    double length = 1;
    double angle = 0; ///< direction towards the end, radians: 0 straight down, pi/2 to the right
    double slack = 0; ///< excess of the length over the distance between the ends, as a fraction of that distance
    double mass = 1;
    double weight = 0; ///< mass added to the last particle
    double radius = 0;
    double x = 0, y = 0;                                               ///< position of the first particle
    std::string_view stem = "particle", first = "start", last = "end"; ///< names: stem, first, last
};

/// Half the angle between consecutive pieces of a strand that hangs with some slack as a circular arc: n chords of half
/// angle a span  sin(n a) / (n sin a) = 1 / (1 + slack)  of their length.
double half_turn_of_slack(int pieces, double slack);

/// Builds the particles of a strand at equal steps along a hanging arc. Each particle has half the mass of the pieces
/// at it, so the load of a piece is the weight below its middle.
template <int D, class Real> std::vector<ParticleId> build_strand(Builder<D, Real>& figure, const Strand& strand) {
    const auto pieces = std::size_t(strand.pieces);
    const double piece = strand.length / strand.pieces, share = strand.mass / strand.pieces;
    const double half_turn = half_turn_of_slack(strand.pieces, strand.slack);

    std::vector<ParticleId> particles;
    particles.reserve(pieces + 1);
    figure.number_particles(strand.stem, pieces + 1);
    double x = 0, y = 0; // relative to the first particle, so strands side by side are identical to the last bit
    particles.push_back(figure.particle(strand.first, on_screen<D>(strand.x, strand.y), share / 2, strand.radius));
    for (std::size_t i = 0; i < pieces; ++i) {
        const double heading = strand.angle + half_turn * (2 * double(i) - double(pieces - 1));
        x += piece * sine(heading);
        y -= piece * cosine(heading);
        const bool last = i + 1 == pieces;
        particles.push_back(figure.particle(last ? strand.last : "", on_screen<D>(strand.x + x, strand.y + y),
                                            last ? share / 2 + strand.weight : share, strand.radius));
    }
    return particles;
}

/// Links consecutive particles of a row by distances called stem_0, stem_1, ...
template <int D, class Real>
void link(Builder<D, Real>& figure, const std::vector<ParticleId>& row, const ConstraintSpec<double>& spec,
          std::string_view stem = "link") {
    figure.number_constraints(stem, row.size() - 1);
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
        figure.template constrain<Distance>("", {row[i], row[i + 1]}, spec);
}

/// Adds an angle constraint at each inner particle of a row; called bend_0, bend_1, ... from the second particle on.
template <int D, class Real>
void stiffen(Builder<D, Real>& figure, const std::vector<ParticleId>& row, const ConstraintSpec<double>& spec) {
    figure.number_constraints("bend", row.size() - 2);
    for (std::size_t i = 0; i + 2 < row.size(); ++i)
        figure.template constrain<Angle>("", {row[i], row[i + 1], row[i + 2]}, spec);
}

template <int D, class Real>
void hold_ends(Builder<D, Real>& figure, const std::vector<ParticleId>& row, std::string_view pinned) {
    if (pinned == "start" || pinned == "both") figure.hold(row.front());
    if (pinned == "end" || pinned == "both") figure.hold(row.back());
}

} // namespace sinew
