#pragma once

#include "sinew/math/random.h"
#include "sinew/solver/contact/contact_law.h"
#include "sinew/solver/direct/newton.h"
#include "sinew/solver/direct/plane_rows.h"
#include "sinew/solver/direct/state.h"
#include "sinew/solver/pin_spring.h"

#include <utility>

/// External terms of a block: soft pins and planes, on the diagonal of the equations.
namespace sinew::detail {

template <int D, class Real> class BlockContact {
  public:
    using Vector = Vec<D, double>;
    using Matrix = sinew::Matrix<D, double>;

    explicit BlockContact(BlockState<D, Real>& state) : state_(state), world_(state.world), planes_(state) {}

    /// Decides at the start of a substep whether the block may reach a plane. After a touch the block counts as near
    /// for the rest of the step.
    void find_near() {
        near_ = touched_;
        if (!planes_.any() || (near_ && world_.colliders.empty())) return;
        const double h = state_.substep();
        for (const auto& node : state_.unknowns()) {
            const double margin = h * (norm(node.velocity) + h * norm(node.acceleration)) * 2;
            for (const auto& plane : world_.bounds) near_ = near_ || depth(node, plane.template as<double>()) > -margin;
            if (planes_.is_any_collider_near(node, margin)) near_ = true;
        }
    }
    bool near() const { return near_; }

    /// True if a node is beyond a plane, even if `find_near` found all planes far away.
    bool struck() {
        if (!planes_.any()) return false;
        bool any = false;
        for (const auto& node : state_.unknowns())
            planes_.each(node, [&](const Plane& plane) { any = any || planes_.depth(node, plane) > 0; });
        touched_ = touched_ || any;
        return any;
    }

    /// Adds all terms to the equations. `hardest` is the penalty stiffness of a link. True if all terms able to release
    /// or saturate do as in the equations before.
    bool add_external_terms(double hardest, const SolveProgress& progress) {
        progress_ = progress;
        const auto before = std::exchange(decisions_, 0);
        if (state_.motorized())
            for (auto& node : state_.unknowns())
                for (auto i = state_.blocks.pin_of[node.row]; i != Blocks<D>::none; i = state_.blocks.next_pin[i])
                    pull(node, world_.pins[i], hardest);
        if (near_)
            for (auto& node : state_.unknowns())
                planes_.each(node, [&](const Plane& plane) { add_contact(node, plane, hardest); });
        return decisions_ == before;
    }

    /// Moves nodes beyond a plane onto the plane.
    void push_out() {
        for (auto& node : state_.unknowns())
            planes_.each(node, [&](const Plane& plane) {
                node.position += plane.normal * max(planes_.depth(node, plane), 0.0);
            });
    }

    /// Scales the multipliers of pins to a substep of the given length, as pins of the sweep report them.
    void report_pins(double substep) {
        if (!state_.motorized()) return;
        const auto longer = Real(square(substep / state_.substep()));
        for (const auto& node : state_.unknowns())
            for (auto i = state_.blocks.pin_of[node.row]; i != Blocks<D>::none; i = state_.blocks.next_pin[i])
                world_.pins[i].multiplier =
                    clamp_components(world_.pins[i].multiplier * longer, limit::multiplier<Real>);
    }

    /// Same as `add_external_terms`, for velocities: a node leaves a plane with the restitution after a blow; a resting
    /// node stays.
    void rebound(double k) {
        if (!near_) return;
        for (auto& node : state_.unknowns()) planes_.each(node, [&](const Plane& plane) { rebound(node, plane, k); });
    }

    /// Reports the impulses of colliders in a substep that is solved: of the pressure, with the stiffness `k` of the
    /// positions, and of the rebounds, with that of the velocities.
    void report_pressures(double k) {
        report([&](const BlockNode<D>& node, const Plane& plane) { return k * depth(node, plane) * state_.substep(); });
    }
    void report_rebounds(double k) {
        report([&](const BlockNode<D>& node, const Plane& plane) { return k * lacking(node, plane); });
    }

  private:
    using Plane = BlockPlane<D>;
    BlockState<D, Real>& state_;
    World<D, Real>& world_;
    BlockPlanes<D, Real> planes_;
    bool near_ = false, touched_ = false;
    SolveProgress progress_{};
    std::uint64_t decisions_ = 0; ///< hash of all decisions: contact, sliding, saturation

    double depth(const BlockNode<D>& node, const HalfSpace<D, double>& plane) const {
        return planes_.depth(node, plane);
    }

    void decide(int choice) { decisions_ = random::mix(decisions_ + std::uint64_t(choice)); }

    /// A damped spring to the goal, with a maximum force.
    void pull(BlockNode<D>& node, Pin<D, Real>& pin, double hardest) {
        const double h = state_.substep();
        const double k = pin_stiffness(pin, hardest), damper = pin_damper(pin, k, node.mass) / h;
        const auto error = node.position - pin.template target_at<double>(state_.to());
        const auto before = node.start - pin.template target_at<double>(state_.from());
        auto force = error * k + (error - before) * damper;
        auto growth = Matrix::diagonal(k + damper);
        if (const double max = double(pin.max_force); max > 0)
            decide(bound(force, growth, k + damper, max, led_across(error, last_displacement(node))));
        node.diagonal += growth;
        node.residual -= force;
        pin.multiplier = cast<Real>(clamp_components(force * -square(h), double(limit::multiplier<Real>)));
    }

    /// Contact with Coulomb friction, both so stiff that nothing sinks or creeps visibly.
    void add_contact(BlockNode<D>& node, const Plane& plane, double k) {
        const auto& normal = plane.normal;
        const double pressure = k * depth(node, plane);
        decide(pressure > 0);
        if (!(pressure > 0)) return;
        node.diagonal += outer(normal * k, normal);
        node.residual += normal * pressure;
        if (!(plane.friction > 0)) return;
        const auto slip =
            RelativeMotion<D, double>(normal, node.position - node.start - plane.surface_displacement).along;
        const auto last = RelativeMotion<D, double>(normal, last_displacement(node)).along;
        const bool across = led_across(slip, last);
        const double pressing = pressing_depth(node, plane), friction = plane.friction;
        auto force = slip * k;
        Matrix growth;
        const bool slides = bound(force, growth, k, friction * k * pressing, across);
        decide(slides ? 1 + (pressing > 0) : 0);
        if (slides && pressing > 0 && !cautious())
            node.diagonal -= outer(direction(slip) * (friction * k), normal); // friction grows with depth
        growth -= outer(normal * dot(normal, growth * normal), normal);
        node.diagonal += growth;
        node.residual -= force;
    }

    /// Depth whose pressure bounds the friction, m. The depth of a node just behind the plane tells little of the final
    /// pressure: a cautious iteration lets such a node slide without friction.
    double pressing_depth(const BlockNode<D>& node, const Plane& plane) const {
        const double now = depth(node, plane);
        const bool knew = progress_.share > 0 && now + dot(plane.normal, last_displacement(node)) > 0;
        return knew || !cautious() ? now : 0;
    }

    /// True for iterations that linearise friction at the pressure of the iteration before. Every few iterations the
    /// full linearisation takes turns, which converges fast but may be singular where a limb jams; either converges
    /// where the other does not.
    bool cautious() const {
        constexpr int tries = 4;
        return progress_.iteration / tries % 2 == 1;
    }

    /// Move of a node in the last iteration, m.
    Vector last_displacement(const BlockNode<D>& node) const { return node.displacement * progress_.share; }

    /// Clamps the force of a spring to `max`, and sets the derivative `growth`. True if saturated. A force led
    /// `across` to the other side by the last move stays unsaturated for an iteration, so as not to jump from one bound
    /// to the other.
    static bool bound(Vector& force, Matrix& growth, double stiffness, double max, bool across) {
        const double size = norm(force);
        growth = Matrix::diagonal(stiffness);
        if (max > 0 && (size <= max || across)) return false;
        const double share = coulomb_share(max, size);
        const auto along = force * inverse_or_zero(size);
        force *= share;
        growth = Matrix::diagonal(stiffness * share);
        growth -= outer(along * (stiffness * share), along);
        return true;
    }
    /// True if a move led from one side to the other.
    static bool led_across(const Vector& now, const Vector& moved) { return dot(now, now - moved) < 0; }

    template <class Impulse> void report(Impulse&& impulse) {
        if (!near_ || (world_.colliders.empty() && !lists_planes(world_))) return;
        for (const auto& node : state_.unknowns())
            planes_.each(node, [&](const Plane& plane) {
                if (plane.collider != planes_.none && depth(node, plane) > 0)
                    planes_.note(node, plane, max(impulse(node, plane), 0.0));
            });
    }

    /// Speed away from a plane that is missing after a blow, or to rest.
    double lacking(const BlockNode<D>& node, const Plane& plane) const {
        const double h = state_.substep();
        const auto& normal = plane.normal;
        const auto struck = cast<double>(world_.particles.velocity[node.row]) + node.acceleration * h;
        const double carried = dot(normal, plane.surface_displacement) / h;
        const auto away = rebound_after(carried - dot(normal, struck), plane.restitution, h * norm(node.acceleration));
        return away.value_or(0) + carried - dot(normal, node.velocity);
    }
    void rebound(BlockNode<D>& node, const Plane& plane, double k) const {
        if (!(depth(node, plane) > 0)) return;
        const double missing = lacking(node, plane);
        if (!(missing > 0)) return;
        node.diagonal += outer(plane.normal * k, plane.normal);
        node.residual += plane.normal * (k * missing);
    }
};

} // namespace sinew::detail
