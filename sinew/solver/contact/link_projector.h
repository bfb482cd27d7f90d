#pragma once

#include "sinew/solver/contact/link_factor.h"
#include "sinew/solver/contact/link_motion.h"
#include "sinew/solver/contact/link_response.h"
#include "sinew/solver/workers.h"

namespace sinew::detail {

/// Exact lengths of the rigid links of colliding figures (RATTLE: Andersen 1983), in the metric of the masses: with G
/// the gradients of the lengths of a component at the place of the factorisation,
///
///     velocities    d <- d - M^-1 G^T (G M^-1 G^T)^-1 G d
///     lengths       d <- d - M^-1 G^T (G M^-1 G^T)^-1 (|x + d| - L),    until the lengths are right
///
/// A rope takes part while it pulls: an active set, kept from substep to substep. A projection of velocities never adds
/// energy. One of lengths may, where links lie in line: energy above that before is taken back once the particles have
/// moved.
template <int D, class Real> class LinkProjector {
  public:
    using Vector = Vec<D, double>;
    using Component = LinkComponent;

    void find(const World<D, Real>& world, const Solver<D, Real>& solver, std::span<const char> takes_part,
              std::vector<char>& is_exact) {
        const auto& state = solver.sweep_state;
        links_.find(world, solver, takes_part, is_exact);
        factor_.resize(links_);
        right_.resize(links_.list.size());
        before_.resize(links_.slots.size());
        change_.resize(state.size());
        is_current_ = false;
    }
    const RigidLinks<D, Real>& links() const { return links_; }

    /// Factorises at the present places, unless that has been done. `mobilities_change`: drag changes them.
    void begin(const SweepState<D, Real>& state, bool mobilities_change) {
        for (auto& link : links_.list) link.tension = 0;
        if (!is_current_ || mobilities_change) factorise(state);
    }

    void project_velocities(SweepState<D, Real>& state, int threads) {
        each_component(threads, [&](Component& component) { project_velocities(state, component); });
    }

    /// Right lengths at the end of the displacements.
    void project_lengths(SweepState<D, Real>& state, int threads) {
        each_component(threads, [&](Component& component) {
            note(state, component);
            project_lengths(state, component);
        });
    }

    /// After the particles have moved: velocities that keep the lengths there, with no more energy than before the
    /// lengths were projected.
    void restore_energy(SweepState<D, Real>& state, int threads) {
        is_current_ = true;
        each_component(threads, [&](Component& component) {
            if (links_.measure(state, component, taut, slightly_turned)) factorise_measured(state, component);
            restore_energy(state, component);
        });
    }

    /// Displacements for impulses, with the lengths held.
    LinkResponse<D, Real> response(const SweepState<D, Real>& state) { return {links_, factor_, right_, state}; }
    /// Projects the velocities of the component of a particle.
    void project_velocities(SweepState<D, Real>& state, Row slot) {
        if (links_.component_of[slot] != none) project_velocities(state, links_.components[links_.component_of[slot]]);
    }

  private:
    using Link = RigidLink<D>;
    static constexpr auto none = RigidLinks<D, Real>::none;

    RigidLinks<D, Real> links_;
    LinkFactor<D> factor_;
    std::vector<double> right_;  ///< per link: right side, then solution
    std::vector<Vector> before_; ///< per RigidLinks::slots: displacement before the lengths
    std::vector<Vector> change_; ///< per slot: room
    bool is_current_ = false;    ///< factorised at the present places

    static Vector displacement(const SweepState<D, Real>& state, Row slot) {
        return cast<double>(state.displacement_at(slot));
    }
    std::span<const Row> slots_of(const Component& component) const {
        return std::span(links_.slots).subspan(component.first_slot, component.last_slot - component.first_slot);
    }
    template <class Visit> void each(const Component& component, Visit&& visit) {
        for (auto k = component.first_link; k < component.last_link; ++k) visit(links_.list[k], right_[k]);
    }

    // --- projections -------------------------------------------------------------------------------------------------

    void project_velocities(SweepState<D, Real>& state, const Component& component) {
        for (int i = 0; i < max_rounds; ++i) {
            each(component, [&](auto& link, double& right) {
                right = link.is_active ? dot(link.along, displacement(state, link.b) - displacement(state, link.a)) : 0;
            });
            factor_.solve(links_.list, component, right_);
            if (!component.has_ropes) return apply(state, component, 1);
            if (i + 1 < max_rounds && release(component)) continue;
            apply(state, component, 1);
            if (!activate_taut(component, [&](const Link& link) {
                    return norm(link.edge) >= taut * link.length &&
                           dot(link.along, displacement(state, link.b) - displacement(state, link.a)) >
                               slight * link.length;
                }))
                return;
        }
    }

    /// One step along the gradients at the start leaves an error of second order, the next of third. Where a few do not
    /// suffice, the gradients are those at the end: they always correct. Steps far beyond the linear model are cut
    /// short.
    void project_lengths(SweepState<D, Real>& state, const Component& component) {
        constexpr double exact = std::is_same_v<Real, float> ? 1e-6 : 1e-9, max_change = 0.2;
        constexpr int usual_rounds = 4, all_rounds = 24;
        for (int i = 0; i < all_rounds; ++i) {
            if (i >= usual_rounds) turn_gradients(state, component);
            const auto excess = [&](const Link& link) {
                return norm(link.edge + displacement(state, link.b) - displacement(state, link.a)) - link.length;
            };
            activate_taut(component, [&](const Link& link) { return excess(link) > exact * link.length; });
            double worst = 0;
            each(component, [&](auto& link, double& right) {
                right = link.is_active ? excess(link) : 0;
                worst = max(worst, absolute(right) * inverse_or_zero(link.length));
            });
            if (!(worst > exact)) return;
            factor_.solve(links_.list, component, right_);
            if (i + 1 < all_rounds && release(component)) continue;
            const double change = largest_change(component);
            apply(state, component, change > max_change ? max_change / change : 1);
        }
    }

    // --- ropes -------------------------------------------------------------------------------------------------------

    static constexpr int max_rounds = 8;
    static constexpr double taut = 1 - 1e-4; ///< share of its length at which a rope may begin to pull
    static constexpr double slight = 1e-9;   ///< change of a link that counts as none, as a share of its length

    /// Lets go what would push. True if anything did.
    bool release(const Component& component) {
        bool any = false;
        each(component, [&](auto& link, double& right) {
            if (!link.is_rope || !link.is_active || link.tension + right * (1 + slight) >= 0) return;
            link.is_active = false;
            any = true;
        });
        if (any) factor_.factorise(links_.list, component);
        return any;
    }
    /// Takes hold of the ropes that `pulls` says are taut. True if there are any.
    template <class Pulls> bool activate_taut(const Component& component, Pulls&& pulls) {
        if (!component.has_ropes) return false;
        bool any = false;
        each(component, [&](auto& link, double&) {
            if (!link.is_active && pulls(link)) link.is_active = any = true;
        });
        if (any) factor_.factorise(links_.list, component);
        return any;
    }

    void turn_gradients(const SweepState<D, Real>& state, const Component& component) {
        each(component, [&](auto& link, double&) {
            link.along = direction(link.edge + displacement(state, link.b) - displacement(state, link.a));
        });
        factor_.factorise(links_.list, component);
    }

    /// Largest change of a link by the solution, relative to its length.
    double largest_change(const Component& component) {
        for (const Row slot : slots_of(component)) change_[slot] = {};
        each(component, [&](auto& link, double& right) {
            change_[link.a] += link.along * (right * link.weight_a);
            change_[link.b] -= link.along * (right * link.weight_b);
        });
        double largest = 0;
        each(component, [&](auto& link, double&) {
            largest = max(largest, norm(change_[link.b] - change_[link.a]) * inverse_or_zero(link.length));
        });
        return largest;
    }

    void apply(SweepState<D, Real>& state, const Component& component, double share) {
        each(component, [&](auto& link, double& right) {
            const auto push = link.along * (right * share);
            link.tension += right * share;
            if (link.weight_a > 0)
                state.set_displacement(link.a, cast<Real>(displacement(state, link.a) + push * link.weight_a));
            if (link.weight_b > 0)
                state.set_displacement(link.b, cast<Real>(displacement(state, link.b) - push * link.weight_b));
        });
    }

    // --- energy ------------------------------------------------------------------------------------------------------

    LinkMotion<D, Real> motion_of(SweepState<D, Real>& state, const Component& component) const {
        return {state, slots_of(component)};
    }
    std::span<Vector> before(const Component& component) {
        return std::span(before_).subspan(component.first_slot, component.last_slot - component.first_slot);
    }
    void note(SweepState<D, Real>& state, Component& component) {
        const auto motion = motion_of(state, component);
        component.energy = motion.energy(motion.frame());
        motion.save(before(component));
    }
    void restore_energy(SweepState<D, Real>& state, const Component& component) {
        constexpr double much = 1.001;
        project_velocities(state, component);
        const auto motion = motion_of(state, component);
        const auto frame = motion.frame();
        const double energy = motion.energy(frame);
        if (!(energy > component.energy)) return;
        if (energy <= much * component.energy) return motion.slow_down(frame, square_root(component.energy / energy));
        motion.restore(before(component));
        project_velocities(state, component);
    }

    /// Links that have turned by less, radians, since the last factorisation in the step are not factorised again: the
    /// velocities left along them are that share of those across.
    static constexpr double slightly_turned = 3e-4;

    // --- factorisation -----------------------------------------------------------------------------------------------

    /// Components share no movable particle; one chunk of them a part of the work.
    template <class Work> void each_component(int threads, const Work& work) {
        constexpr int chunks = 32;
        const auto count = links_.components.size();
        Workers::run(threads, chunks, [&](int chunk) {
            const auto last = count * std::size_t(chunk + 1) / chunks;
            for (auto i = count * std::size_t(chunk) / chunks; i < last; ++i) work(links_.components[i]);
        });
    }

    void factorise(const SweepState<D, Real>& state) {
        for (const auto& component : links_.components) factorise(state, component);
    }
    void factorise(const SweepState<D, Real>& state, const Component& component) {
        links_.measure(state, component, taut, slightly_turned);
        factorise_measured(state, component);
    }
    void factorise_measured(const SweepState<D, Real>& state, const Component& component) {
        links_.take_directions(state, component);
        factor_.factorise(links_.list, component);
    }
};

} // namespace sinew::detail
