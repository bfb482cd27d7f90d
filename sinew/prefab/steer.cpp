#include "sinew/prefab/steer.h"

#include "sinew/prefab/ground.h"
#include "sinew/world/edit.h"

#include <array>
#include <optional>

namespace sinew {
namespace {

/// Particles of a car, as rows.
struct CarRows {
    std::array<Row, 2> wheels{}, axles{}; ///< rear, front
};

template <class Real> class CarDriver {
  public:
    using Vector = Vec<2, Real>;

    CarDriver(World<2, Real>& world, FigureIndex figure, const Car& car, const CarRows& rows, Real dt)
        : world_(world), p_(world.particles), figure_(figure), car_(car), rows_(rows), dt_(dt),
          upright_(detail::Upright<Real>::of(world)) {}

    void drive(const Controls& controls) {
        // Rolling to the right is clockwise where up is to the left of right, as in a frame with y upwards.
        const Real hand = cross(upright_.right, upright_.up) > Real(0) ? Real(-1) : Real(1);
        const Real along = share(controls.along), lean = share(controls.up);
        for (const Row wheel : rows_.wheels) {
            const Real top = hand * Real(car_.top_speed) / p_.radius[wheel];
            p_.inertia.set(wheel, Real(car_wheel_inertia));
            if (controls.jump)
                brake(wheel);
            else if (along != Real(0))
                turn_towards(wheel, along * top, Real(car_.torque));
        }
        if (lean != Real(0) && !stands()) twist_body(-hand * lean * Real(car_.lean));
    }

  private:
    World<2, Real>& world_;
    Particles<2, Real>& p_;
    FigureIndex figure_;
    const Car& car_;
    const CarRows& rows_;
    Real dt_;
    detail::Upright<Real> upright_;

    static Real share(double wish) { return clamp(Real(wish), Real(-1), Real(1)); }

    /// Turns a wheel by a torque of at most `most`; the body feels the opposite one.
    ///
    ///     torque = clamp(I (omega* - omega) / dt, -most, most)
    void turn_towards(Row wheel, Real wanted, Real most) {
        const Real moment = moment_of(wheel);
        const Real now = p_.spin[wheel][0];
        const Real torque = clamp(moment * (wanted - now) / dt_, -most, most);
        if (torque == Real(0)) return;
        set_spin(world_, p_.handles.id_of(wheel), {{now + torque * dt_ * inverse_or_zero(moment)}});
        twist_body(-torque);
    }

    /// A wheel that the brake can stop is locked: so heavy to turn that it rubs as a block does.
    void brake(Row wheel) {
        const Real needed = absolute(p_.spin[wheel][0]) * moment_of(wheel) / dt_, most = Real(car_.brake);
        turn_towards(wheel, 0, most);
        if (needed <= most && most > Real(0)) p_.inertia.set(wheel, Real(locked));
    }
    static constexpr double locked = 1000; ///< share of mass times radius^2

    Real moment_of(Row wheel) const {
        return p_.inertia[wheel] * square(p_.radius[wheel]) * inverse_or_zero(p_.inverse_mass[wheel]);
    }

    /// A couple on the two axles of the body.
    void twist_body(Real torque) {
        const auto base = p_.position[rows_.axles[1]] - p_.position[rows_.axles[0]];
        const auto force = perpendicular(base) * (torque * inverse_or_zero(dot(base, base)));
        apply_force(world_, p_.handles.id_of(rows_.axles[1]), force);
        apply_force(world_, p_.handles.id_of(rows_.axles[0]), -force);
    }

    /// True if there is ground just below a wheel.
    bool stands() const {
        for (const Row wheel : rows_.wheels) {
            const Real rim = p_.radius[wheel];
            if (cast_ray(world_, p_.position[wheel], upright_.up * (Real(-0.15) * rim), rim * Real(0.95),
                         world_.figures[figure_].filter, figure_))
                return true;
        }
        return false;
    }
};

template <class Real> std::optional<CarRows> rows_of_car(const World<2, Real>& world, FigureIndex index) {
    if (!has_figure(world, index) || world.settings.mode == Mode::classic) return std::nullopt;
    const auto& figure = world.figures[index];
    constexpr std::array<std::string_view, 4> names{"rear_wheel", "front_wheel", "rear", "front"};
    std::array<Row, 4> rows{};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto id = figure.particle_names.find(names[i]);
        const auto row = id ? world.particles.handles.find(*id) : std::nullopt;
        if (!row) return std::nullopt;
        rows[i] = *row;
    }
    if (figure.quarantined) return std::nullopt;
    return CarRows{{rows[0], rows[1]}, {rows[2], rows[3]}};
}

} // namespace

template <class Real>
void steer(World<2, Real>& world, FigureIndex figure, const Car& car, const Controls& controls, Real dt) {
    const auto rows = rows_of_car(world, figure);
    if (rows && dt > Real(0)) CarDriver<Real>(world, figure, car, *rows, dt).drive(controls);
}

#define SINEW_STEER(D, Real) template void steer(World<D, Real>&, FigureIndex, const Car&, const Controls&, Real);
SINEW_INSTANTIATE_2D(SINEW_STEER)

} // namespace sinew
