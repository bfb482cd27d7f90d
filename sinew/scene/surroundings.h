#pragma once

#include "sinew/assert/assert.h"
#include "sinew/scene/check.h"
#include "sinew/scene/colliders.h"
#include "sinew/scene/forces.h"
#include "sinew/scene/scene.h"
#include "sinew/scene/types.h"
#include "sinew/world/colliders.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace sinew {

/// Sign of the second axis upwards: -1 in scenes drawn from the top.
inline int up_of(const Scene& scene) {
    return scene.units.up == "-y" ? -1 : 1;
}

inline Integrator integrator_called(std::string_view name) {
    const auto found = std::find(integrator_names.begin(), integrator_names.end(), name);
    SINEW_ASSERT(found != integrator_names.end(), "the reader accepts names of integrators only");
    return Integrator(found - integrator_names.begin());
}

/// Builds all of a world but the figures: rules, force fields, bounds and colliders.
template <int D, class Real> class Surroundings {
  public:
    /// Keeps references to scene and world.
    Surroundings(const Scene& scene, World<D, Real>& world) : scene_(scene), world_(world) {}

    void build() {
        settings();
        forces();
        bounds();
        colliders();
    }

  private:
    using Vector = Vec<D, Real>;
    const Scene& scene_;
    World<D, Real>& world_;

    static Vector vector(const Point& point) { return point.as<D, Real>(); }

    void settings() {
        const auto& solver = scene_.solver;
        const auto& rules = solver.rules;
        auto& settings = world_.settings;
        settings.mode = solver.mode == "classic" ? Mode::classic : Mode::physical;
        settings.substeps = solver.substeps;
        settings.iterations = solver.iterations;
        settings.damping = Real(scene_.world.damping.value_or(0));
        settings.frame = Real(scene_.measures().per_second / 60);
        if (solver.sleep)
            settings.sleep = {Real(solver.sleep->speed), Real(solver.sleep->delay.value_or(30 * settings.frame))};
        const auto order = std::find(RulesSection::orders.begin(), RulesSection::orders.end(), rules.order);
        settings.classic = {
            .passes = solver.passes,
            .order = std::min(PassOrder(order - RulesSection::orders.begin()), PassOrder::walls_last),
            .moves_each_pass = rules.moves_each_pass,
            .integrator = integrator_called(rules.integrator),
            .keep = Real(scene_.world.damping.value_or(1)),
            .damp_after_force = rules.damp_after_force,
            .root_free = rules.root_free,
            .bounce = Real(scene_.world.bounds ? scene_.world.bounds->bounce : 0),
            .floor_keep = Real(rules.floor_keep),
            .time_scale = Real(rules.time_scale),
            .longest_step = Real(rules.longest_step),
            .outward_bounce = rules.outward_bounce,
            .points_only_passes = rules.points_only_passes,
            .unscaled_inertia = rules.unscaled_inertia,
            .halved_acceleration = rules.halved_acceleration,
            .dropped_leftover = rules.dropped_leftover,
        };
    }

    void forces() {
        world_.forces.push_back(Gravity<D, Real>{vector(scene_.world.gravity)}, 0); // the world's gravity
        for (const auto& section : scene_.world.forces)
            world_.forces.push_back(force_of<D, Real>(scene_, section, figure_called(pulled_by(section))),
                                    std::uint32_t(world_.forces.size()));
    }
    /// Index of a figure by name, known before the figure is built, because figures are built in scene order; no_figure
    /// for an empty name.
    FigureIndex figure_called(std::string_view name) const {
        for (std::size_t i = 0; i < scene_.figures.size(); ++i)
            if (!name.empty() && name_of(scene_.figures[i]) == name) return FigureIndex(i);
        return no_figure;
    }

    void bounds() {
        if (!scene_.world.bounds) return;
        const auto& bounds = *scene_.world.bounds;
        const Real bounce = Real(bounds.bounce), friction = Real(bounds.friction);
        if (bounds.box)
            for (int i = 0; i < D; ++i) {
                const Real low = Real(std::min((*bounds.box)[0][i], (*bounds.box)[1][i]));
                const Real high = Real(std::max((*bounds.box)[0][i], (*bounds.box)[1][i]));
                world_.bounds.push_back({Vector::axis(i), low, bounce, friction});
                world_.bounds.push_back({-Vector::axis(i), -high, bounce, friction});
            }
        for (const auto& plane : bounds.planes) {
            const auto normal = direction(vector(plane.normal));
            world_.bounds.push_back({normal, dot(normal, vector(plane.through)),
                                     Real(plane.bounce.value_or(bounds.bounce)),
                                     Real(plane.friction.value_or(bounds.friction))});
        }
    }

    void colliders() {
        for (std::size_t i = 0; i < scene_.colliders.size(); ++i)
            for (const auto& collider : colliders_of<D, Real>(scene_.colliders[i], i, up_of(scene_)))
                add_collider(world_, collider);
    }
};

} // namespace sinew
