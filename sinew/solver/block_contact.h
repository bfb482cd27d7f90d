#pragma once

#include "sinew/solver/block_state.h"

/// What acts on a block from outside: soft pins and planes, as terms on the diagonal of its equations.
namespace sinew::detail {

template <int D, class Real> class BlockContact {
  public:
    using Vector = Vec<D, double>;

    explicit BlockContact(BlockState<D, Real>& state) : state_(state), world_(state.world) {}

    /// When a substep begins: whether it may come to a plane. What has touched one is near it for the rest of the step.
    void look() {
        near_ = touched_;
        if (world_.bounds.empty() || near_) return;
        const double h = state_.substep();
        for (const auto& node : state_.unknowns()) {
            const double reach = h * (norm(node.velocity) + h * norm(node.push)) * 2;
            for (const auto& plane : world_.bounds) near_ = near_ || depth(node, plane) > -reach;
        }
    }
    bool near() const { return near_; }

    /// Whether something has come to a plane: also what was far from it, and was drawn there by the rest.
    bool struck() {
        for (const auto& plane : world_.bounds)
            for (const auto& node : state_.unknowns())
                if (depth(node, plane) > 0) return touched_ = true;
        return false;
    }

    /// Adds all to the equations. `hardest` is as stiff as a link.
    void hold(double hardest) {
        if (state_.driven())
            for (auto& node : state_.unknowns())
                for (auto i = state_.blocks.pin_of[node.row]; i != Blocks<D>::none; i = state_.blocks.next_pin[i])
                    pull(node, world_.pins[i], hardest);
        if (near_)
            for (auto& node : state_.unknowns())
                for (const auto& plane : world_.bounds) press(node, plane, hardest);
    }

    /// What is beyond a plane after all is put on it.
    void lift() {
        for (const auto& plane : world_.bounds)
            for (auto& node : state_.unknowns())
                node.place += cast<double>(plane.normal) * maximum(depth(node, plane), 0.0);
    }

    /// As `hold`, for velocities: what struck a plane leaves it with its restitution; what rests on it stays.
    void rebound(double k) {
        if (!near_) return;
        for (auto& node : state_.unknowns())
            for (const auto& plane : world_.bounds) rebound(node, plane, k);
    }

  private:
    BlockState<D, Real>& state_;
    World<D, Real>& world_;
    bool near_ = false, touched_ = false;

    double depth(const BlockNode<D>& node, const HalfSpace<D, Real>& plane) const {
        return double(plane.offset) + double(world_.particles.radius[node.row]) -
               dot(cast<double>(plane.normal), node.place);
    }

    /// A damped spring to its goal, whose force has an end.
    void pull(BlockNode<D>& node, Pin<D, Real>& pin, double hardest) const {
        const double h = state_.substep();
        const double per_compliance = inverse_or_zero(double(pin.compliance));
        const double k = per_compliance > 0 ? minimum(per_compliance, hardest) : hardest;
        const double damper = double(pin.damping) * 2 * square_root(k * node.mass) / h;
        const auto error = node.place - state_.goal(pin, true), before = node.start - state_.goal(pin, false);
        auto force = error * k + (error - before) * damper;
        double stiffness = k + damper;
        if (const double most = double(pin.max_force); most > 0 && norm(force) > most) {
            const double share = most / norm(force);
            force *= share;
            stiffness *= share;
        }
        node.diagonal += Matrix<D, double>::diagonal(stiffness);
        node.residual -= force;
        pin.multiplier = cast<Real>(clamp_components(force * -square(h), double(limit::multiplier<Real>)));
    }

    /// A plane pushes back and rubs (Coulomb): both so stiff that nothing sinks or creeps visibly.
    void press(BlockNode<D>& node, const HalfSpace<D, Real>& plane, double k) const {
        const auto normal = cast<double>(plane.normal);
        const double pressure = k * depth(node, plane);
        if (!(pressure > 0)) return;
        node.diagonal += outer(normal * k, normal);
        node.residual += normal * pressure;
        if (!(plane.friction > Real(0))) return;
        const auto move = node.place - node.start;
        const auto slip = move - normal * dot(normal, move);
        const double most = double(plane.friction) * pressure, grip = k * norm(slip);
        const double stiffness = grip > most ? k * (most / grip) : k;
        node.diagonal += Matrix<D, double>::diagonal(stiffness);
        node.diagonal -= outer(normal * stiffness, normal);
        node.residual -= slip * stiffness;
    }

    void rebound(BlockNode<D>& node, const HalfSpace<D, Real>& plane, double k) const {
        if (!(depth(node, plane) > 0)) return;
        const double h = state_.substep();
        const auto normal = cast<double>(plane.normal);
        const auto struck = cast<double>(world_.particles.velocity[node.row]) + node.push * h;
        const double approach = -dot(normal, struck), resting = 4 * h * norm(node.push);
        const double away = approach > resting ? double(plane.restitution) * approach : 0;
        const double missing = away - dot(normal, node.velocity);
        if (!(missing > 0)) return;
        node.diagonal += outer(normal * k, normal);
        node.residual += normal * (k * missing);
    }
};

} // namespace sinew::detail
