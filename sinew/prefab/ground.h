#pragma once

#include "sinew/prefab/character.h"
#include "sinew/world/edit.h"
#include "sinew/world/query.h"

#include <optional>

namespace sinew::detail {

/// Upwards and to the right, as seen on screen, in a world of two dimensions.
template <class Real> struct Upright {
    Vec<2, Real> up{{0, 1}}, right{{1, 0}};
    Real gravity = 0; ///< acceleration downwards

    static Upright of(const World<2, Real>& world) {
        Vec<2, Real> pull{};
        for (const auto& force : world.forces)
            if (const auto* field = std::get_if<Gravity<2, Real>>(&force)) pull += field->acceleration;
        Upright upright;
        upright.gravity = norm(pull);
        if (upright.gravity > Real(0)) upright.up = direction(-pull);
        upright.right = -perpendicular(upright.up);
        if (upright.right[0] < Real(0)) upright.right = -upright.right;
        return upright;
    }
};

/// Part of a figure, or none: a point between two particles, or at one.
struct Support {
    ParticleId first{}, second{};
    double share = 0; ///< of the way from the first to the second
};

/// Surface under the feet.
template <class Real> struct Ground {
    Vec<2, Real> normal{}, velocity{};
    Real gap = 0;                   ///< between the feet and the surface, along the normal
    FigureIndex figure = no_figure; ///< no_figure: a collider or a plane
    Support support{};              ///< of the figure: receives the opposite force
};

/// Finds the ground under a character by rays: what is found follows from positions alone.
template <class Real> class GroundFinder {
  public:
    using Vector = Vec<2, Real>;

    GroundFinder(const World<2, Real>& world, FigureIndex figure, const Character& character, Row feet, Real dt)
        : world_(world), p_(world.particles), figure_(figure), character_(character), feet_(feet), dt_(dt),
          upright_(Upright<Real>::of(world)), steepest_(Real(cosine(character.max_slope))),
          filter_(world.figures[figure].filter) {}

    /// Ground within the height of a step below the feet, unless they rise from it or fall on it.
    std::optional<Ground<Real>> find() const {
        const Real rim = p_.radius[feet_], deep = max(Real(character_.step_height), Real(0.1) * rim);
        const auto hit = cast(feet(), upright_.up * -deep, rim * Real(0.9));
        if (!hit || dot(hit->normal, upright_.up) < steepest_) return std::nullopt;
        const auto ground = ground_of(*hit);
        const Real away = dot(p_.velocity[feet_] - ground.velocity, ground.normal), near = Real(0.05) * rim;
        const Real most = Real(0.5) * Real(character_.speed);
        const bool stays = ground.gap <= near ? away < most : away < Real(0.1) * most && away > -most;
        return stays ? std::optional(ground) : std::nullopt;
    }

    /// Riser of a step in a direction, as ground whose normal leans back: it may be walked up.
    std::optional<Ground<Real>> riser(const Vector& ahead) const {
        const Real rim = p_.radius[feet_];
        const auto level = direction(upright_.right * dot(ahead, upright_.right));
        const auto hit = cast(feet(), level * (Real(0.1) * rim + Real(character_.speed) * dt_), rim * Real(0.97));
        if (!hit) return std::nullopt;
        const Real lean = dot(hit->normal, upright_.up);
        if (lean >= steepest_ || lean < Real(-0.1) || dot(hit->normal, level) >= Real(0)) return std::nullopt;
        return has_tread(level) ? std::optional(ground_of(*hit)) : std::nullopt;
    }

  private:
    const World<2, Real>& world_;
    const Particles<2, Real>& p_;
    FigureIndex figure_;
    const Character& character_;
    Row feet_;
    Real dt_;
    Upright<Real> upright_;
    Real steepest_; ///< cosine of the largest slope
    collide::Filter filter_;

    const Vector& feet() const { return p_.position[feet_]; }
    std::optional<RayHit<2, Real>> cast(const Vector& from, const Vector& by, Real radius) const {
        return cast_ray(world_, from, by, radius, filter_, figure_);
    }

    /// Velocity of the surface of a collider at a point, in the coming step.
    Vector velocity_of(const collide::Collider<2, Real>& collider, const Vector& point, const Vector& normal) const {
        auto velocity = collider.belt_velocity(collider.target, normal);
        if (!collider.is_at_rest())
            velocity += (collider.target.to_world(collider.from.to_local(point)) - point) * (Real(1) / dt_);
        return velocity;
    }

    Ground<Real> ground_of(const RayHit<2, Real>& hit) const {
        Ground<Real> ground{
            .normal = hit.normal, .gap = dot(feet() - hit.point, hit.normal) - p_.radius[feet_], .figure = hit.figure};
        if (hit.is_collider) {
            const auto row = world_.collider_handles.find(hit.collider);
            if (row) ground.velocity = velocity_of(world_.colliders[*row], hit.point, hit.normal);
            return ground;
        }
        const auto first = p_.handles.find(hit.particle);
        const auto second = p_.handles.find(hit.line_end.value_or(hit.particle));
        if (hit.is_plane || !first || !second) return ground;
        const auto line = p_.position[*second] - p_.position[*first];
        const Real share =
            clamp(dot(hit.point - p_.position[*first], line) * inverse_or_zero(dot(line, line)), Real(0), Real(1));
        ground.velocity = p_.velocity[*first] * (Real(1) - share) + p_.velocity[*second] * share;
        ground.support = {p_.handles.id_of(*first), p_.handles.id_of(*second), double(share)};
        return ground;
    }

    /// True if there is free room above a riser, and ground on it that is no higher than a step.
    bool has_tread(const Vector& level) const {
        const Real rim = p_.radius[feet_], high = Real(character_.step_height), thin = rim * Real(0.5);
        const auto above = feet() + upright_.up * (high - thin);
        const auto on = level * (rim * Real(1.2));
        if (cast(above, on, thin)) return false;
        const auto hit = cast(above + on, upright_.up * -(high + Real(0.2) * rim), thin);
        return hit && dot(hit->normal, upright_.up) >= steepest_;
    }
};

} // namespace sinew::detail
