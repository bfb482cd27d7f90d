#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace sinew {

enum class Integrator : std::uint8_t {
    verlet,           ///< x += x - x_prev + a h^2 (Stoermer 1907, Verlet 1967)
    explicit_euler,   ///< x += v h; v += a h, both from the old state (Euler 1768)
    symplectic_euler, ///< v += a h; x += v h with the new velocity: the positions of Verlet
    velocity_verlet,  ///< x += v h + a h^2/2; v += (a + a_new) h/2 (Swope et al. 1982)
    rk4               ///< four evaluations a step (Runge 1895, Kutta 1901)
};
inline constexpr std::array<std::string_view, 5> integrator_names = {
    "verlet", "explicit_euler", "symplectic_euler", "velocity_verlet", "rk4"}; ///< in the order of Integrator

/// True if x - x_prev is the mean velocity of the step, valid in the middle; otherwise x_prev = x - v h, where v is the
/// velocity at the end of the step.
constexpr bool has_mean_velocity(Integrator integrator) {
    return integrator == Integrator::verlet;
}

/// True if the positions are Verlet's: only the reported velocity and energy differ.
constexpr bool goes_as_verlet(Integrator integrator) {
    return integrator == Integrator::verlet || integrator == Integrator::symplectic_euler;
}

} // namespace sinew
