#pragma once

#include "sinew/math/random.h"
#include "sinew/scene/scene.h"
#include "sinew/world/force.h"

/// From the section "forces" of a scene to the force fields of a world.
namespace sinew {

/// Wind of a force or an event: the same everywhere and always.
template <int D, class Real, class Section> Wind<D, Real> wind_of(const Section& section, const Units& units) {
    constexpr double usual = 0.1; // kg/s
    const double strength = section.density > 0 ? 0 : usual * units.scale(unit::drag);
    return {.velocity = section.velocity.template as<D, Real>(),
            .strength = Real(section.strength.value_or(strength)),
            .density = Real(section.density),
            .drag_coefficient = Real(section.drag_coefficient),
            .metre = Real(units.per_metre)};
}

/// Seed of a force, combined with the scene's. The same function leads back.
inline std::uint64_t seed_of(const Scene& scene, std::uint64_t own) {
    return own ^ random::mix(std::uint64_t(scene.solver.seed));
}

namespace detail {

template <int D, class Real> Force<D, Real> law_of(const Scene&, const GravityForce& force) {
    return Gravity<D, Real>{force.acceleration.as<D, Real>()};
}
template <int D, class Real> Force<D, Real> law_of(const Scene&, const DragForce& force) {
    return Drag<D, Real>{Real(force.strength)};
}
template <int D, class Real> Force<D, Real> law_of(const Scene& scene, const WindForce& force) {
    auto wind = wind_of<D, Real>(force, scene.measures());
    wind.gust = force.gust.as<D, Real>();
    wind.gust_period = Real(force.gust_period), wind.gust_size = Real(force.gust_size);
    wind.seed = seed_of(scene, std::uint64_t(force.seed));
    return wind;
}
template <int D, class Real> Force<D, Real> law_of(const Scene&, const AttractorForce& force) {
    return Attractor<D, Real>{force.center.as<D, Real>(), Real(force.strength), Real(force.softness)};
}
template <int D, class Real> Force<D, Real> law_of(const Scene& scene, const RandomPushForce& force) {
    return RandomPush<D, Real>{force.low.as<D, Real>(), force.high.as<D, Real>(),
                               seed_of(scene, std::uint64_t(force.seed))};
}

} // namespace detail

/// Force field of a section. `figure`: index of the figure named by an attractor, else no_figure.
template <int D, class Real>
Force<D, Real> force_of(const Scene& scene, const ForceSection& section, FigureIndex figure) {
    auto law = std::visit([&](const auto& force) { return detail::law_of<D, Real>(scene, force); }, section.force);
    if (auto* attractor = std::get_if<Attractor<D, Real>>(&law)) attractor->figure = figure;
    return law;
}

/// Name of the only figure that a force pulls; empty: all.
inline std::string_view pulled_by(const ForceSection& section) {
    const auto* attractor = std::get_if<AttractorForce>(&section.force);
    return attractor ? std::string_view(attractor->figure) : std::string_view();
}

} // namespace sinew
