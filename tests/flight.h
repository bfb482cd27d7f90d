#pragma once

#include "sinew/world/measure.h"

#include "tests/prefab/make.h"
#include "tests/stepped.h"

/// Figures of the catalogue in free flight: thrown and turning, without pins.
namespace sinew::test {

inline constexpr double turn_rate = 3; ///< rad/s

inline Vec3<double> moment_of(const Vec2<double>& arm, const Vec2<double>& momentum) {
    return {{0, 0, cross(arm, momentum)}};
}
inline Vec3<double> moment_of(const Vec3<double>& arm, const Vec3<double>& momentum) {
    return cross(arm, momentum);
}
inline Vec2<double> turned(const Vec2<double>& arm) {
    return {{-arm[1], arm[0]}};
}
inline Vec3<double> turned(const Vec3<double>& arm) {
    return cross(Vec3<double>{{0.36, 0.48, 0.8}}, arm);
}

template <int D> Vec<D, double> thrown() {
    Vec<D, double> velocity;
    for (int i = 0; i < D; ++i) velocity[i] = 5 - 2.5 * i;
    return velocity;
}

template <int D, class Real = double> struct Flight {
    Stepped<D, Real> world;

    Flight(const AnyPrefab& prefab, const Vec<D, double>& velocity, double damping, Direct direct = Direct::automatic) {
        build(world, prefab, "it", Placement<D, Real>{});
        for (auto& figure : world.figures) // prefabs with wheels have chosen to be swept
            if (figure.direct == Direct::automatic) figure.direct = direct;
        while (!world.pins.empty()) unpin_all(world, world.pins[0].particle);
        world.forces.push_back(Gravity<D, Real>{Vec<D, Real>::axis(1) * Real(-9.81)});
        world.settings.damping = Real(damping);
        const auto center = center_of_mass(world);
        for (Row row = 0; row < world.particles.size(); ++row) {
            const auto arm = cast<double>(world.particles.position[row]) - center;
            set_velocity(world, world.particles.handles.id_of(row), cast<Real>(velocity + turned(arm) * turn_rate));
        }
    }
    bool direct() const {
        const auto& at_end = world.particles.at_end;
        return std::all_of(at_end.begin(), at_end.end(), [](char at) { return at != 0; });
    }
    /// Angular momentum about the centre.
    Vec3<double> spin() const { return angular_momentum(world) - moment_of(center_of_mass(world), momentum(world)); }
    double size() const {
        double max = 0;
        for (const auto& position : world.particles.position)
            max = std::max(max, distance(cast<double>(position), center_of_mass(world)));
        return max;
    }
    void fly(double seconds) {
        for (int i = 0; i < int(seconds * 60); ++i) step(world, Real(1) / 60);
    }
};

/// Calls check(prefab) with every prefab in every dimension it exists in.
template <class Check> void for_every_figure(Check&& check) {
    Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab>) {
        if constexpr (Prefab::dimensions.include(2)) check.template operator()<2>(Prefab{});
        if constexpr (Prefab::dimensions.include(3)) check.template operator()<3>(Prefab{});
    });
}

/// Kinetic energy about the centre, and what springs hold.
template <int D, class Real> double inner_energy(const World<D, Real>& world) {
    const auto whole = momentum(world);
    return energy(world).kinetic - 0.5 * dot(whole, whole) / total_mass(world) + energy(world).stored;
}

} // namespace sinew::test
