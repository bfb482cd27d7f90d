#pragma once

#include "sinew/math/moments.h"

namespace sinew::detail {

/// Rigid-body motion of some nodes, each with a mass and a velocity: momenta, changed by external forces only.
template <int D> struct RigidMotion {
    using Vector = Vec<D, double>;
    using Spin = Vec<spins<D>, double>;

    double mass = 0;
    Vector center{}, momentum{};
    Spin spin{}; ///< angular momentum about the centre

    template <class Nodes, class At> static RigidMotion of(const Nodes& nodes, At&& at) {
        RigidMotion motion;
        for (const auto& node : nodes) {
            motion.mass += node.mass;
            motion.center += at(node) * node.mass;
            motion.momentum += node.velocity * node.mass;
        }
        motion.center *= inverse_or_zero(motion.mass);
        for (const auto& node : nodes) motion.spin += moment(at(node) - motion.center, node.velocity * node.mass);
        return motion;
    }

    /// Angular velocity of nodes with this spin at the given positions; zero if all are collinear (3D).
    template <class Nodes, class At> Spin rate_of(const Nodes& nodes, At&& at) const {
        if constexpr (D == 2) {
            double inertia = 0;
            for (const auto& node : nodes) inertia += node.mass * dot(at(node) - center, at(node) - center);
            return {{spin[0] * inverse_or_zero(inertia)}};
        } else {
            Matrix<3, double> inertia;
            double size = 0;
            for (const auto& node : nodes) {
                const auto arm = at(node) - center;
                size += node.mass * dot(arm, arm);
                inertia += Matrix<3, double>::diagonal(node.mass * dot(arm, arm));
                inertia -= outer(arm * node.mass, arm);
            }
            const auto& [x, y, z] = inertia.column;
            if (dot(x, cross(y, z)) <= 1e-9 * size * size * size) return {};
            return inverse(inertia) * spin;
        }
    }
};

} // namespace sinew::detail
