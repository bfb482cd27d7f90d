#pragma once

#include "sinew/math/matrix.h"
#include "sinew/solver/contact/rigid_links.h"
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
    using Matrix = sinew::Matrix<D, double>;
    using Component = LinkComponent;

    void find(const World<D, Real>& world, const Solver<D, Real>& solver, std::span<const char> takes_part,
              std::vector<char>& is_exact) {
        const auto& state = solver.sweep_state;
        links_.find(world, solver, takes_part, is_exact);
        entries_.resize(links_.entries);
        pivots_.resize(links_.list.size());
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
    void settle(SweepState<D, Real>& state, int threads) {
        is_current_ = true;
        each_component(threads, [&](Component& component) {
            factorise(state, component);
            settle(state, component);
        });
    }

    /// Displacement of a particle for an impulse on it, with the lengths held: a symmetric matrix, 1 / kg.
    Matrix response(const SweepState<D, Real>& state, Row slot) {
        auto matrix = Matrix::diagonal(double(state.mobility[slot]));
        if (links_.component_of[slot] == none) return matrix;
        const auto& component = links_.components[links_.component_of[slot]];
        for (int i = 0; i < D; ++i) {
            each(component, [&](auto& link, double& right) {
                right = ((link.b == slot ? link.weight_b : 0) - (link.a == slot ? link.weight_a : 0)) * link.along[i];
            });
            solve(component);
            each(component, [&](auto& link, double& right) {
                const double pull = (link.a == slot ? link.weight_a : 0) - (link.b == slot ? link.weight_b : 0);
                matrix.column[std::size_t(i)] += link.along * (pull * right);
            });
        }
        return matrix;
    }
    /// Projects the velocities of the component of a particle.
    void project_velocities(SweepState<D, Real>& state, Row slot) {
        if (links_.component_of[slot] != none) project_velocities(state, links_.components[links_.component_of[slot]]);
    }

    /// Multipliers of the links, as of constraints of the sweep.
    void store(World<D, Real>& world) const {
        auto& table = std::get<kind_number<Distance, D>>(world.constraints);
        for (const auto& link : links_.list)
            table.multiplier[link.row] = clamp(Real(-link.tension), -limit::multiplier<Real>, limit::multiplier<Real>);
    }

  private:
    using Link = RigidLink<D>;
    static constexpr auto none = RigidLinks<D, Real>::none;

    RigidLinks<D, Real> links_;
    std::vector<double> entries_, pivots_, right_; ///< strict lower triangle by rows; 1 / pivot
    std::vector<Vector> before_;                   ///< per RigidLinks::slots: displacement before the lengths
    std::vector<Vector> change_;                   ///< per slot: room
    bool is_current_ = false;                      ///< factorised at the present places

    static Vector move(const SweepState<D, Real>& state, Row slot) { return cast<double>(state.move_at(slot)); }
    std::span<const Row> slots_of(const Component& component) const {
        return std::span(links_.slots).subspan(component.first_slot, component.last_slot - component.first_slot);
    }
    template <class Visit> void each(const Component& component, Visit&& visit) {
        for (auto k = component.first_link; k < component.last_link; ++k) visit(links_.list[k], right_[k]);
    }

    // --- projections -------------------------------------------------------------------------------------------------

    void project_velocities(SweepState<D, Real>& state, const Component& component) {
        for (int i = 0; i < most_rounds; ++i) {
            each(component, [&](auto& link, double& right) {
                right = link.is_active ? dot(link.along, move(state, link.b) - move(state, link.a)) : 0;
            });
            solve(component);
            if (!component.has_ropes) return apply(state, component, 1);
            if (i + 1 < most_rounds && release(component)) continue;
            apply(state, component, 1);
            if (!tighten(component, [&](const Link& link) {
                    return norm(link.edge) >= taut * link.length &&
                           dot(link.along, move(state, link.b) - move(state, link.a)) > slight * link.length;
                }))
                return;
        }
    }

    /// One step along the gradients at the start leaves an error of second order, the next of third. Where a few do not
    /// suffice, the gradients are those at the end: they always correct. Steps far beyond the linear model are cut
    /// short.
    void project_lengths(SweepState<D, Real>& state, const Component& component) {
        constexpr double exact = std::is_same_v<Real, float> ? 1e-6 : 1e-9, most_change = 0.2;
        constexpr int usual_rounds = 4, all_rounds = 24;
        for (int i = 0; i < all_rounds; ++i) {
            if (i >= usual_rounds) turn_gradients(state, component);
            const auto excess = [&](const Link& link) {
                return norm(link.edge + move(state, link.b) - move(state, link.a)) - link.length;
            };
            tighten(component, [&](const Link& link) { return excess(link) > exact * link.length; });
            double worst = 0;
            each(component, [&](auto& link, double& right) {
                right = link.is_active ? excess(link) : 0;
                worst = maximum(worst, absolute(right) * inverse_or_zero(link.length));
            });
            if (!(worst > exact)) return;
            solve(component);
            if (i + 1 < all_rounds && release(component)) continue;
            const double change = largest_change(component);
            apply(state, component, change > most_change ? most_change / change : 1);
        }
    }

    // --- ropes -------------------------------------------------------------------------------------------------------

    static constexpr int most_rounds = 8;
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
        if (any) factorise(component);
        return any;
    }
    /// Takes hold of the ropes that `pulls` says are taut. True if there are any.
    template <class Pulls> bool tighten(const Component& component, Pulls&& pulls) {
        if (!component.has_ropes) return false;
        bool any = false;
        each(component, [&](auto& link, double&) {
            if (!link.is_active && pulls(link)) link.is_active = any = true;
        });
        if (any) factorise(component);
        return any;
    }

    void turn_gradients(const SweepState<D, Real>& state, const Component& component) {
        each(component, [&](auto& link, double&) {
            link.along = direction(link.edge + move(state, link.b) - move(state, link.a));
        });
        factorise(component);
    }

    /// Largest change of a link by the solution, relative to its length.
    double largest_change(const Component& component) {
        for (const Row slot : slots_of(component)) change_[slot] = {};
        each(component, [&](auto& link, double& right) {
            change_[link.a] += link.along * (right * link.weight_a);
            change_[link.b] -= link.along * (right * link.weight_b);
        });
        double most = 0;
        each(component, [&](auto& link, double&) {
            most = maximum(most, norm(change_[link.b] - change_[link.a]) * inverse_or_zero(link.length));
        });
        return most;
    }

    void apply(SweepState<D, Real>& state, const Component& component, double share) {
        each(component, [&](auto& link, double& right) {
            const auto push = link.along * (right * share);
            link.tension += right * share;
            if (link.weight_a > 0) state.set_move(link.a, cast<Real>(move(state, link.a) + push * link.weight_a));
            if (link.weight_b > 0) state.set_move(link.b, cast<Real>(move(state, link.b) - push * link.weight_b));
        });
    }

    // --- energy ------------------------------------------------------------------------------------------------------

    /// Displacement in which the energy of a component is measured: of the first particle that cannot move, or the
    /// mean.
    Vector frame_of(const SweepState<D, Real>& state, const Component& component) const {
        Vector momentum{};
        double mass = 0;
        for (const Row slot : slots_of(component)) {
            if (state.mobility[slot] == Real(0)) return move(state, slot);
            const double m = 1 / double(state.mobility[slot]);
            mass += m, momentum += move(state, slot) * m;
        }
        return momentum * inverse_or_zero(mass);
    }
    double energy_of(const SweepState<D, Real>& state, const Component& component, const Vector& frame) const {
        double sum = 0;
        for (const Row slot : slots_of(component)) {
            const auto own = move(state, slot) - frame;
            sum += inverse_or_zero(double(state.mobility[slot])) * dot(own, own);
        }
        return sum;
    }

    void note(const SweepState<D, Real>& state, Component& component) {
        component.energy = energy_of(state, component, frame_of(state, component));
        for (auto i = component.first_slot; i < component.last_slot; ++i) before_[i] = move(state, links_.slots[i]);
    }
    void settle(SweepState<D, Real>& state, const Component& component) {
        constexpr double much = 1.001;
        project_velocities(state, component);
        const auto frame = frame_of(state, component);
        const double energy = energy_of(state, component, frame);
        if (!(energy > component.energy)) return;
        if (energy <= much * component.energy)
            return slow_down(state, component, frame, square_root(component.energy / energy));
        for (auto i = component.first_slot; i < component.last_slot; ++i)
            state.set_move(links_.slots[i], cast<Real>(before_[i]));
        project_velocities(state, component);
    }
    void slow_down(SweepState<D, Real>& state, const Component& component, const Vector& frame, double share) {
        for (const Row slot : slots_of(component))
            state.set_move(slot, cast<Real>(frame + (move(state, slot) - frame) * share));
    }

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
        each(component, [&](auto& link, double&) {
            link.edge = cast<double>(state.place_at(link.b)) - cast<double>(state.place_at(link.a));
            link.along = direction(link.edge);
            if (link.is_rope && norm(link.edge) < taut * link.length) link.is_active = false;
            link.weight_a = double(state.mobility[link.a]), link.weight_b = double(state.mobility[link.b]);
        });
        factorise(component);
    }
    void factorise(const Component& component) {
        for (auto k = component.first_link; k < component.last_link; ++k) factorise_row(k);
    }

    static double coupling(const Link& k, const Link& m) {
        if (!k.is_active || !m.is_active) return 0;
        double sum = 0;
        if (k.a == m.a) sum += k.weight_a;
        if (k.b == m.b) sum += k.weight_b;
        if (k.a == m.b) sum -= k.weight_a;
        if (k.b == m.a) sum -= k.weight_b;
        return sum == 0 ? 0 : sum * dot(k.along, m.along);
    }

    /// The diagonal is raised by a little: redundant links share their load.
    void factorise_row(std::uint32_t k) {
        constexpr double softness = 1e-7;
        const auto& link = links_.list[k];
        double* const row = entries_.data() + link.start;
        double pivot = (link.weight_a + link.weight_b) * (1 + softness);
        for (auto m = link.first; m < k; ++m) {
            const auto& other = links_.list[m];
            const double* const above = entries_.data() + other.start;
            double sum = coupling(link, other);
            for (auto j = std::max(link.first, other.first); j < m; ++j)
                sum -= row[j - link.first] * above[j - other.first];
            row[m - link.first] = sum; // times the pivot, for now
        }
        for (auto m = link.first; m < k; ++m) {
            const double scaled = row[m - link.first] * pivots_[m];
            pivot -= row[m - link.first] * scaled;
            row[m - link.first] = scaled;
        }
        pivots_[k] = link.is_active ? inverse_or_zero(maximum(pivot, 0.0)) : 0;
    }

    void solve(const Component& component) {
        const auto begin = component.first_link, end = component.last_link;
        for (auto k = begin; k < end; ++k)
            for (auto m = links_.list[k].first; m < k; ++m) right_[k] -= entry(k, m) * right_[m];
        for (auto k = begin; k < end; ++k) right_[k] *= pivots_[k];
        for (auto k = end; k-- > begin;)
            for (auto m = links_.list[k].first; m < k; ++m) right_[m] -= entry(k, m) * right_[k];
    }
    double entry(std::uint32_t k, std::uint32_t m) const {
        return entries_[links_.list[k].start + m - links_.list[k].first];
    }
};

} // namespace sinew::detail
