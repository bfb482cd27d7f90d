#pragma once

#include "sinew/prefab/car.h"
#include "sinew/prefab/controls.h"
#include "sinew/world/world.h"

namespace sinew {

/// Moment of inertia of a wheel of a car that no brake holds, as a share of mass times radius^2.
inline constexpr double car_wheel_inertia = 0.8;

/// Drives a car in the step that follows: called once before each, with the length of the step. Everything is worked
/// out from the world, so copies, snapshots and replays go on alike. No effect on a figure without particles rear_wheel
/// and front_wheel that roll, and in classic mode.
///
/// `along` turns both wheels towards that share of the top speed, by at most the torque, whose reaction the body
/// feels; 0 lets them roll. `jump` brakes. `up` leans the body while no wheel stands on anything.
///
///     steer(world, racer, car, {.along = throttle, .jump = brake}, 1.0 / 60);
///     simulation.step(1.0 / 60);
template <class Real>
void steer(World<2, Real>& world, FigureIndex figure, const Car& car, const Controls& controls, Real dt);

} // namespace sinew
