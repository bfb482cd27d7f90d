#pragma once

#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/pin_spring.h"

/// Soft pins on figures whose links are exact. A pin acts on the particle as the whole figure answers: its links are
/// held, whatever the pin's force.
namespace sinew::detail {

template <int D, class Real> class PinRows {
  public:
    using Vector = Vec<D, double>;

    /// `from`, `to`: shares of the step at the ends of the substep.
    PinRows(World<D, Real>& world, Solver<D, Real>& solver, Real h, Real from, Real to)
        : world_(world), solver_(solver), state_(solver.sweep_state), h_(double(h)), from_(from), to_(to) {}

    void solve() {
        for (const auto& pinned : state_.plan.pins) {
            auto& pin = world_.pins[pinned.pin];
            if (pin.hard() || !is_held_exactly(solver_, pinned.slot) || state_.mobility[pinned.slot] == Real(0))
                continue;
            solve(pin, pinned.slot);
        }
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    SweepState<D, Real>& state_;
    double h_;
    Real from_, to_;

    /// dlambda = -(R (1 + gamma) + alpha)^-1 (e + gamma u), as in the sweep, with the response R of the figure for the
    /// particle's inverse mass.
    void solve(Pin<D, Real>& pin, Row slot) {
        auto& projector = solver_.contacts->projector;
        projector.project_velocities(state_, slot);
        auto response = projector.response(state_).of(slot);
        double mean = 0;
        for (int i = 0; i < D; ++i) mean += response.column[std::size_t(i)][i] / D;
        const double alpha = double(pin.compliance) / square(h_);
        const double gamma = pin_gamma(pin, mean, 1.0) / h_;
        const auto goal = cast<double>(pin.target_at(to_)), last_goal = cast<double>(pin.target_at(from_));
        const auto position = cast<double>(state_.position_at(slot)),
                   displacement = cast<double>(state_.displacement_at(slot));
        const auto error = position + displacement - goal, drift = error - (position - last_goal);
        for (auto& column : response.column) column *= 1 + gamma;
        response += Matrix<D, double>::diagonal(alpha);
        const auto multiplier =
            bounded_solution(response, -(error + drift * gamma), double(pin.max_force) * square(h_));
        pin.multiplier = cast<Real>(clamp_components(multiplier, double(limit::multiplier<Real>)));
        const auto pushed = state_.displacement_at(slot) + pin.multiplier * state_.mobility[slot];
        state_.set_displacement(slot, clamp_components(pushed, max_displacement(Real(h_))));
        projector.project_velocities(state_, slot);
    }
    /// R^-1 e; where that is larger than `max_size`, (R + mu)^-1 e with the mu at which it is as large: a weak hand
    /// pulls towards its target.
    static Vector bounded_solution(const Matrix<D, double>& response, const Vector& error, double max_size) {
        const auto solution = [&](double mu) {
            auto raised = response;
            raised += Matrix<D, double>::diagonal(mu);
            return inverse(raised) * error;
        };
        const auto whole = solution(0);
        if (max_size <= 0 || norm(whole) <= max_size) return whole;
        constexpr int halvings = 30;
        double trace = 0, high = norm(error) / max_size;
        for (int i = 0; i < D; ++i) trace += response.column[std::size_t(i)][i];
        double low = max(high - trace, 0.0);
        for (int i = 0; i < halvings; ++i) {
            const double middle = 0.5 * (low + high);
            (norm(solution(middle)) > max_size ? low : high) = middle;
        }
        return solution(high);
    }
};

} // namespace sinew::detail
