#include "sinew/prefab/tire.h"

namespace sinew {

template <int D, class Real> void Tire::build(Builder<D, Real>& figure) const {
    if constexpr (D == 3)
        build_wheel(figure);
    else
        build_flat(figure);
}

/// Two rims of n corners about an axle. A rim alone is flat and soft across; the rims, the diagonals between them and
/// the spokes from both ends of the axle make frames of triangles.
template <class Real> void Tire::build_wheel(Builder<3, Real>& figure) const {
    const auto n = std::size_t(segments);
    const double share = mass / double(2 * n + 2);
    const auto tread = tread_elasticity.spec(), spoke = spoke_elasticity.spec();
    std::array<std::vector<ParticleId>, 2> rims;
    std::array<ParticleId, 2> hubs{};
    for (const std::size_t side : {0U, 1U}) {
        const double z = side == 0 ? width / 2 : -width / 2;
        figure.number_particles(side == 0 ? "corner" : "back", n);
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 2 * pi<double> * double(i) / double(n);
            rims[side].push_back(
                figure.particle("", {{radius * cosine(angle), radius * sine(angle), z}}, share, thickness / 2));
        }
        hubs[side] = figure.particle(side == 0 ? "center" : "back_center", {{0, 0, z}}, share);
    }
    const auto join = [&](ParticleId a, ParticleId b, const ConstraintSpec<double>& spec) {
        figure.template constrain<Distance>("", {a, b}, spec);
    };
    figure.number_constraints("tread", 2 * n);
    for (const auto& rim : rims)
        for (std::size_t i = 0; i < n; ++i) join(rim[i], rim[(i + 1) % n], tread);
    figure.number_constraints("cross", 3 * n);
    for (std::size_t i = 0; i < n; ++i) {
        join(rims[0][i], rims[1][i], tread);
        join(rims[0][i], rims[1][(i + 1) % n], tread);
        join(rims[1][i], rims[0][(i + 1) % n], tread);
    }
    const auto span = std::size_t(brace_span) % n;
    if (span > 1 && span < n - 1) {
        const auto braces = 2 * span == n ? span : n;
        figure.number_constraints("brace", 2 * braces);
        for (const auto& rim : rims)
            for (std::size_t i = 0; i < braces; ++i) join(rim[i], rim[(i + span) % n], tread);
    }
    figure.number_constraints("spoke", 4 * n);
    for (const auto hub : hubs)
        for (const auto& rim : rims)
            for (const auto corner : rim) join(hub, corner, spoke);
    figure.template constrain<Distance>("axle", {hubs[0], hubs[1]}, spoke);

    for (std::size_t i = 0; i < n; ++i) {
        const auto next = (i + 1) % n;
        figure.draw(Mark::fill, "rim", {rims[0][i], rims[0][next], rims[1][next], rims[1][i]});
    }
    for (const std::size_t side : {1U, 0U}) {
        for (const auto corner : rims[side]) figure.draw(Mark::stroke, "spoke", {hubs[side], corner}, thickness / 6);
        figure.draw(Mark::dot, "hub", {hubs[side]}, 2 * thickness);
        figure.draw(Mark::loop, "tread", std::move(rims[side]), thickness);
    }
}

template <class Real> void Tire::build_flat(Builder<2, Real>& figure) const {
    const auto n = std::size_t(segments);
    const bool classic = figure.mode() == Mode::classic;
    const double share = mass / double(n + 1);
    auto tread = tread_elasticity.spec(), spoke = spoke_elasticity.spec();
    if (classic) tread.relaxation = tread_relaxation, spoke.relaxation = spoke_relaxation;

    std::vector<ParticleId> corners;
    figure.number_particles("corner", n);
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * pi<double> * double(i) / double(n);
        corners.push_back(
            figure.particle("", on_screen<2>(radius * cosine(angle), radius * sine(angle)), share, thickness / 2));
    }
    const auto center = figure.particle("center", {}, share);

    figure.number_constraints("tread", n);
    for (std::size_t i = 0; i < n; ++i)
        figure.template constrain<Distance>("", {corners[i], corners[(i + 1) % n]}, tread);

    const auto span = std::size_t(brace_span) % n;
    if (span > 1 && span < n - 1) {
        const auto braces = 2 * span == n ? span : n; // braces between opposite corners coincide in pairs
        figure.number_constraints("brace", braces);
        for (std::size_t i = 0; i < braces; ++i) {
            figure.template constrain<Distance>("", {corners[i], corners[(i + span) % n]}, tread);
            figure.draw(Mark::stroke, "brace", {corners[i], corners[(i + span) % n]}, thickness / 8, true);
        }
    }
    figure.number_constraints("spoke", n);
    for (std::size_t i = 0; i < n; ++i) figure.template constrain<Distance>("", {center, corners[i]}, spoke);

    figure.draw(Mark::fill, "rim", corners);
    for (const auto corner : corners) figure.draw(Mark::stroke, "spoke", {center, corner}, thickness / 6);
    figure.draw(Mark::dot, "hub", {center}, 2 * thickness);
    figure.draw(Mark::loop, "tread", std::move(corners), thickness);
}

#define SINEW_TIRE(D, Real) template void Tire::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_TIRE)

} // namespace sinew
