#pragma once

#include "sinew/constraint/angle.h"
#include "sinew/constraint/volume.h"
#include "sinew/solver/block.h"
#include "sinew/solver/direct/rule.h"
#include "sinew/solver/project.h"

namespace sinew::detail {

/// Angles and folds at the positions of the nodes: values, gradients, and directions of the force.
template <int D> class AngleGeometry {
  public:
    explicit AngleGeometry(Blocks<D>& blocks) : blocks_(blocks) {}

    double angle_of(const AngleRow<D>& bend, bool at_start) const {
        const auto position = [&](std::size_t k) {
            const auto& at = node(bend.nodes[k]);
            return at_start ? at.start : at.position;
        };
        if constexpr (D == 3)
            if (bend.is_fold())
                return Volume<3>::evaluate(Points<4, 3, double>{position(0), position(1), position(2), position(3)})
                           .value /
                       bend.unit;
        const Points<3, D, double> points{position(0), position(1), position(2)};
        return unwrap<Angle<D>>(Angle<D>::evaluate(points).value, bend.low, bend.high);
    }

    /// Sets the gradient at the present positions; returns the angle.
    double measure(AngleRow<D>& bend) const {
        if constexpr (D == 3)
            if (bend.is_fold()) return measure_fold(bend);
        const Points<3, D, double> points{node(bend.nodes[0]).position, node(bend.nodes[1]).position,
                                          node(bend.nodes[2]).position};
        const auto evaluated = Angle<D>::evaluate(points);
        for (std::size_t k = 0; k < 3; ++k) bend.gradient[k] = gentle<Angle<D>>(evaluated.gradient[k]);
        return unwrap<Angle<D>>(evaluated.value, bend.low, bend.high);
    }

    /// Direction of the force. In a midpoint step, the discrete gradient: the work over the substep is torque times
    /// turn. The angle is that of (u . v, u x v), both bilinear, with discrete gradients at the means of u and v;
    /// between two points of a circle of radius r, turned by t about the middle angle m, the discrete gradient is
    ///
    ///     (-sin m, cos m)  (t/2) / (r sin(t/2))
    ///
    /// In space u x v has no sign, and u . v alone will do.
    void point(AngleRow<D>& bend, Rule rule, double angle) const {
        bend.along = bend.gradient;
        if (rule != Rule::midpoint || bend.is_compliant()) return;
        if constexpr (D == 3)
            if (bend.is_fold()) return point_fold(bend);
        const auto &a = node(bend.nodes[0]), &b = node(bend.nodes[1]), &c = node(bend.nodes[2]);
        const auto u0 = b.start - a.start, v0 = c.start - b.start, u1 = b.position - a.position,
                   v1 = c.position - b.position;
        const auto u = (u0 + u1) * 0.5, v = (v0 + v1) * 0.5;
        const double r2 = square_root(dot(u0, u0) * dot(v0, v0)) * square_root(dot(u1, u1) * dot(v1, v1));
        const double half = 0.5 * (angle - bend.begun), middle = bend.begun + half;
        constexpr double small = 1e-4, large = 1;
        if (!(r2 > 0) || absolute(half) > large) return;
        const double scale = (absolute(half) < small ? 1 : half / sine(half)) / square_root(r2);
        if constexpr (D == 2) {
            const double along = -sine(middle) * scale, across = cosine(middle) * scale;
            const auto du = v * along - perpendicular(v) * across, dv = u * along + perpendicular(u) * across;
            bend.along = {-du, du - dv, dv};
        } else {
            constexpr double straight = 1e-3;
            const double s = sine(middle);
            if (!(s > straight)) return;
            const auto du = v * (-scale / s), dv = u * (-scale / s);
            bend.along = {-du, du - dv, dv};
        }
    }

    /// Torque times the second derivative of an angle by its arms u and v: (u, u), (v, v) and (u, v). Within the plane
    /// an angle is the difference of two directions; out of it, along the normal n,
    ///
    ///     cot(angle) n n^T / |u|^2,    - n n^T / (|u| |v| sin(angle))
    ///
    /// where torque / sin(angle) is kept within the spring's stiffness `k`, which it is near the straight angle.
    std::array<Matrix<D, double>, 3> curvature(const AngleRow<D>& bend, double torque, double k) const {
        const auto u = node(bend.nodes[1]).position - node(bend.nodes[0]).position;
        const auto v = node(bend.nodes[2]).position - node(bend.nodes[1]).position;
        const double per_u2 = inverse_or_zero(dot(u, u)), per_v2 = inverse_or_zero(dot(v, v));
        const auto turn = [](const Vec<D, double>& arm, const Vec<D, double>& across, double by) {
            auto both = outer(arm * by, across);
            both += outer(across * by, arm);
            return both;
        };
        if constexpr (D == 2) {
            const auto across_u = perpendicular(u), across_v = perpendicular(v);
            return {turn(u, across_u, torque * per_u2 * per_u2), turn(v, across_v, -torque * per_v2 * per_v2), {}};
        } else {
            const auto normal = cross(u, v);
            const double sine2 = dot(normal, normal) * per_u2 * per_v2;
            if (!(sine2 > 1e-24)) return {};
            const double per_sine = 1 / square_root(sine2), cosine = dot(u, v) * square_root(per_u2 * per_v2);
            const auto across_u = v - u * (dot(u, v) * per_u2), across_v = u - v * (dot(u, v) * per_v2);
            const double out = clamp(torque * per_sine, -k, k), in = torque * per_sine * square_root(per_u2 * per_v2);
            const auto n = normal * (per_sine * square_root(per_u2 * per_v2));
            auto uu = turn(u, across_u, in * per_u2), vv = turn(v, across_v, in * per_v2);
            uu += outer(n * (out * cosine * per_u2), n), vv += outer(n * (out * cosine * per_v2), n);
            return {uu, vv, outer(n * (-out * square_root(per_u2 * per_v2)), n)};
        }
    }

    /// First-order change of the angle in the last move.
    double change(const AngleRow<D>& bend) const {
        double turn = 0;
        for (std::size_t k = 0; k < bend.arity; ++k) turn += dot(bend.gradient[k], node(bend.nodes[k]).displacement);
        return turn;
    }

    /// Rate of change of an angle, relative to the limits.
    double rate_of(const AngleRow<D>& bend) const {
        double rate = -bend.motor_speed;
        for (std::size_t k = 0; k < bend.arity; ++k) rate += dot(bend.gradient[k], node(bend.nodes[k]).velocity);
        return rate;
    }
    double rate_at_end(AngleRow<D>& bend) const {
        measure(bend);
        return rate_of(bend);
    }

    /// Fraction of a spring's stiffness that acts, 0..1: springs bend taut arms only, since an arm of no length could
    /// be turned by nothing.
    double tautness(const AngleRow<D>& bend, bool at_start) const {
        double share = 1;
        for (std::size_t i = 0; i < 2; ++i) {
            if (bend.arms[i] == 0) continue;
            const auto &a = node(bend.nodes[i]), &b = node(bend.nodes[i + 1]);
            const auto arm = at_start ? b.start - a.start : b.position - a.position;
            share *= min(dot(arm, arm) / bend.arms[i], 1.0);
        }
        return share;
    }

    /// Angle of a spring, continued past half a turn within a substep, where the torque must not change sign.
    static double turned_on(const AngleRow<D>& bend, double angle) {
        return bend.begun + unwrap<Angle<D>>(angle - bend.begun, 0.0, 0.0);
    }

    /// Squared lever arm of an angle, m^2: makes an angle as stiff as a link of that length.
    static double arm2(const AngleRow<D>& bend) {
        double steepest = 0;
        for (std::size_t k = 0; k < bend.arity; ++k) steepest = max(steepest, dot(bend.gradient[k], bend.gradient[k]));
        return inverse_or_zero(steepest);
    }

  private:
    Blocks<D>& blocks_;

    BlockNode<D>& node(std::uint32_t i) const { return blocks_.nodes[i]; }

    double measure_fold(AngleRow<D>& bend) const requires(D == 3) {
        const auto position = [&](std::size_t k) { return node(bend.nodes[k]).position; };
        const auto evaluated =
            Volume<3>::evaluate(Points<4, 3, double>{position(0), position(1), position(2), position(3)});
        for (std::size_t k = 0; k < 4; ++k) bend.gradient[k] = evaluated.gradient[k] * (1 / bend.unit);
        return evaluated.value / bend.unit;
    }

    /// Discrete gradient of a volume: the mean over the substep, exact since a volume is linear in each edge u, v, w:
    ///
    ///     du = (2 v0 x w0 + v0 x w1 + v1 x w0 + 2 v1 x w1) / 36
    void point_fold(AngleRow<D>& bend) const requires(D == 3) {
        const auto& a = node(bend.nodes[0]);
        const auto mean = [&](std::size_t i, std::size_t j) {
            const auto &b = node(bend.nodes[i]), &c = node(bend.nodes[j]);
            const auto v0 = b.start - a.start, w0 = c.start - a.start, v1 = b.position - a.position,
                       w1 = c.position - a.position;
            return (cross(v0 * 2 + v1, w0) + cross(v1 * 2 + v0, w1)) * (1 / (36 * bend.unit));
        };
        const auto db = mean(2, 3), dc = mean(3, 1), dd = mean(1, 2);
        bend.along = {-(db + dc + dd), db, dc, dd};
    }
};

} // namespace sinew::detail
