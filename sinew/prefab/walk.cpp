#include "sinew/prefab/walk.h"

#include "sinew/prefab/ground.h"
#include "sinew/prefab/hold.h"
#include "sinew/world/colliders.h"

#include <utility>

namespace sinew {
namespace {

using detail::Ground, detail::GroundFinder, detail::Hands, detail::Support, detail::Upright;

/// Forces on the two ends of a character for one step.
template <class Real> class Walker {
  public:
    using Vector = Vec<2, Real>;

    Walker(World<2, Real>& world, FigureIndex figure, const Character& character, std::array<Row, 2> rows, Real dt)
        : world_(world), p_(world.particles), figure_(figure), character_(character), feet_(rows[0]), head_(rows[1]),
          dt_(dt), upright_(Upright<Real>::of(world)) {}

    Footing move(const Controls& controls) {
        Hands<Real> hands(world_, figure_, character_, head_);
        auto held = detail::held_by(world_, figure_);
        if (held && !controls.hold) hands.let_go(), held.reset();
        if (!held && controls.hold && hands.take()) held = detail::held_by(world_, figure_);
        if (held) {
            hands.climb(clamp(Real(controls.up), Real(-1), Real(1)));
            rub(0);
            push(upright_.right * (mass() * Real(character_.swing) * along(controls)));
            return {.is_holding = true, .figure = *held};
        }
        stand_up();
        const auto ground = finder().find();
        if (!ground) {
            steer_in_air(along(controls));
            return {};
        }
        if (controls.jump)
            jump(*ground);
        else
            walk(*ground, along(controls));
        return {.on_ground = true, .figure = ground->figure};
    }

  private:
    World<2, Real>& world_;
    Particles<2, Real>& p_;
    FigureIndex figure_;
    const Character& character_;
    Row feet_, head_;
    Real dt_;
    Upright<Real> upright_;

    GroundFinder<Real> finder() const { return {world_, figure_, character_, feet_, dt_}; }
    static Real along(const Controls& controls) { return clamp(Real(controls.along), Real(-1), Real(1)); }
    Real mass_of(Row row) const { return inverse_or_zero(p_.inverse_mass[row]); }
    Real mass() const { return mass_of(feet_) + mass_of(head_); }
    Vector velocity() const {
        return (p_.velocity[feet_] * mass_of(feet_) + p_.velocity[head_] * mass_of(head_)) * inverse_or_zero(mass());
    }

    /// A force on the whole body, shared by mass.
    void push(const Vector& force) {
        for (const Row row : {feet_, head_})
            apply_force(world_, p_.handles.id_of(row), force * (mass_of(row) * inverse_or_zero(mass())));
    }
    /// The opposite force on what carries the body.
    void push_back(const Support& support, const Vector& force) {
        apply_force(world_, support.first, force * Real(support.share - 1));
        apply_force(world_, support.second, force * Real(-support.share));
    }

    /// Friction at all surfaces.
    void rub(double friction) {
        auto& own = world_.figures[figure_];
        if (own.wall_friction == friction && own.friction == friction) return;
        set_contact(world_, figure_,
                    {.figures = own.collides,
                     .itself = own.touches_itself,
                     .cloth = own.cloth,
                     .friction = friction,
                     .filter = own.filter,
                     .bounce = own.bounce,
                     .wall_friction = friction});
    }

    /// A couple that turns the body upright within a few steps, as a gyroscope would.
    ///
    ///     omega* = rate sin(angle),      F = m1 m2 / (m1 + m2) L (omega* - omega) / dt
    void stand_up() {
        const auto spine = p_.position[head_] - p_.position[feet_];
        const Real length = norm(spine), rate = Real(0.25) / dt_;
        if (!(length > Real(0))) return;
        const auto aside = perpendicular(spine) * (Real(1) / length);
        const Real lean = cross(spine, upright_.up) / length;
        const Real turning = dot(p_.velocity[head_] - p_.velocity[feet_], aside) / length;
        const Real reduced = mass_of(feet_) * mass_of(head_) * inverse_or_zero(mass());
        const auto force = aside * (reduced * length * (rate * lean - turning) / dt_);
        apply_force(world_, p_.handles.id_of(head_), force);
        apply_force(world_, p_.handles.id_of(feet_), -force);
    }

    /// Speeds up along a direction to a speed, by at most an acceleration; returns the force.
    Vector force_to(const Vector& direction, Real wanted, Real now, Real acceleration) const {
        const Real change = clamp(wanted - now, -acceleration * dt_, acceleration * dt_);
        return direction * (mass() * change / dt_);
    }

    void steer_in_air(Real along) {
        rub(0);
        if (along == Real(0)) return;
        push(force_to(upright_.right, along * Real(character_.speed), dot(velocity(), upright_.right),
                      Real(character_.air_acceleration)));
    }

    void jump(const Ground<Real>& ground) {
        rub(0);
        const Real rise = square_root(Real(2) * upright_.gravity * Real(character_.jump_height));
        const auto change = upright_.up * (rise - dot(velocity() - ground.velocity, upright_.up));
        for (const Row row : {feet_, head_}) set_velocity(world_, p_.handles.id_of(row), p_.velocity[row] + change);
        if (ground.figure == no_figure) return;
        apply_impulse(world_, ground.support.first, change * (mass() * Real(ground.support.share - 1)));
        apply_impulse(world_, ground.support.second, change * (mass() * Real(-ground.support.share)));
    }

    void walk(Ground<Real> ground, Real along) {
        auto tangent = upright_.right - ground.normal * dot(upright_.right, ground.normal);
        const auto ahead = tangent * (along < Real(0) ? Real(-1) : Real(1));
        bool climbs = false;
        if (along != Real(0))
            if (const auto riser = finder().riser(ahead)) {
                ground.normal = riser->normal, climbs = true;
                tangent = upright_.right - ground.normal * dot(upright_.right, ground.normal);
                if (dot(tangent, upright_.up) * along < Real(0)) tangent = -tangent;
            }
        tangent = direction(tangent);
        const Real pace = climbs ? max(absolute(dot(tangent, upright_.right)), slowest) : Real(1); // not to take off
        const auto relative = velocity() - ground.velocity;
        const Real now = dot(relative, tangent), slow = Real(0.1) * Real(character_.speed);
        if (along == Real(0) && absolute(now) <= slow) return rub(stands);
        rub(0);
        auto force = force_to(tangent, along * pace * Real(character_.speed), now, Real(character_.acceleration));
        force += tangent * (mass() * upright_.gravity * dot(tangent, upright_.up));
        if (ground.figure != no_figure) push_back(ground.support, force);
        push(force + follow(ground, relative));
    }

    /// Force that keeps the feet on ground that falls away.
    Vector follow(const Ground<Real>& ground, const Vector& relative) const {
        const Real least = Real(0.01) * p_.radius[feet_];
        if (ground.gap <= least) return {};
        const Real wanted = -min(Real(0.5) * ground.gap / dt_, Real(0.5) * Real(character_.speed));
        const Real now = dot(relative, ground.normal);
        return now > wanted ? ground.normal * (mass() * (wanted - now) / dt_) : Vector{};
    }

    static constexpr Real slowest = Real(0.4); ///< up a riser, of the speed
    static constexpr double stands = 2;        ///< friction of one that stands, for the steepest slopes: 63 degrees
};

/// Rows of feet and head; nothing for a figure that is no character of a physical world.
template <class Real> std::optional<std::array<Row, 2>> character_rows(const World<2, Real>& world, FigureIndex index) {
    if (!has_figure(world, index) || world.settings.mode == Mode::classic) return std::nullopt;
    const auto& figure = world.figures[index];
    const auto feet = figure.particle_names.find("feet"), head = figure.particle_names.find("head");
    if (!feet || !head || figure.quarantined) return std::nullopt;
    const auto lower = world.particles.handles.find(*feet), upper = world.particles.handles.find(*head);
    return lower && upper ? std::optional(std::array{*lower, *upper}) : std::nullopt;
}

} // namespace

template <class Real>
Footing walk(World<2, Real>& world, FigureIndex figure, const Character& character, const Controls& controls, Real dt) {
    const auto rows = character_rows(world, figure);
    return rows && dt > Real(0) ? Walker<Real>(world, figure, character, *rows, dt).move(controls) : Footing{};
}

template <class Real>
Footing footing_of(const World<2, Real>& world, FigureIndex figure, const Character& character, Real dt) {
    const auto rows = character_rows(world, figure);
    if (!rows || !(dt > Real(0))) return {};
    if (const auto held = detail::held_by(world, figure)) return {.is_holding = true, .figure = *held};
    const auto ground = GroundFinder<Real>(world, figure, character, (*rows)[0], dt).find();
    return {.on_ground = ground.has_value(), .figure = ground ? ground->figure : no_figure};
}

#define SINEW_WALK(D, Real)                                                                                            \
    template Footing walk(World<D, Real>&, FigureIndex, const Character&, const Controls&, Real);                      \
    template Footing footing_of(const World<D, Real>&, FigureIndex, const Character&, Real);
SINEW_INSTANTIATE_2D(SINEW_WALK)

} // namespace sinew
