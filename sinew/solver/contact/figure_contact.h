#pragma once

#include "sinew/solver/contact/pin_rows.h"
#include "sinew/solver/contact/row_builder.h"
#include "sinew/world/asleep.h"

/// Contacts of colliding figures in a substep of the sweep: soft rows on displacements, whose multipliers are kept from
/// substep to substep (Catto 2011; small steps: Macklin et al. 2019); after each pass over the rows the links of the
/// figures are made exact.
namespace sinew::detail {

template <int D, class Real> class FigureContact {
  public:
    using Vector = Vec<D, Real>;

    /// `number`: substep, counted from 1.
    FigureContact(World<D, Real>& world, Solver<D, Real>& solver, Real h, int number, int substeps)
        : world_(world), solver_(solver), state_(solver.sweep_state), is_active_(has_figure_contacts(solver)), h_(h),
          from_(Real(number - 1) / Real(substeps)), to_(Real(number) / Real(substeps)),
          left_(h * Real(substeps - number + 1)), drag_changes_(number <= 2) {}

    /// After the prediction: rows, and the impulses of the last substep.
    void begin() {
        if (!is_active_) return;
        const Real scale = scale_kept();
        find_contact_candidates(world_, solver_, left_, h_);
        RowBuilder<D, Real>(world_, solver_, h_, from_, to_).run();
        room().projector.begin(state_, drag_changes_);
        for (auto& row : room().rows) {
            if (!row.keeps) row.multiplier = 0, row.tangent = {};
            push(row, row.normal * row.multiplier + row.tangent);
        }
        room().joints.begin(world_, state_, scale);
        room().projector.project_velocities(state_);
    }

    /// After the sweep.
    void solve() {
        if (!is_active_) return;
        PinRows<D, Real>(world_, solver_, h_, from_, to_).solve();
        room().joints.solve(state_, Soft::contact());
        for (auto& row : room().rows) solve(row, row.keeps ? Soft::contact() : Soft::hard());
        room().projector.project_velocities(state_);
        hold_at_walls();
        room().projector.project_lengths(state_);
        for (auto& row : room().rows) row.gap += change(row);
        room().joints.advance(state_);
    }

    /// After the particles have moved: velocities without the push out of overlaps, then rebounds.
    void relax() {
        if (!is_active_) return;
        room().projector.restore_energy(state_);
        room().joints.solve(state_, Soft::none());
        for (auto& row : room().rows) solve(row, Soft::none());
        room().projector.project_velocities(state_);
        bool any = false;
        for (auto& row : room().rows) any = rebound(row) || any;
        if (any) room().projector.project_velocities(state_);
        keep();
    }

  private:
    using ContactRowT = ContactRow<D, Real>;
    using Soft = Softness<Real>;

    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    SweepState<D, Real>& state_;
    bool is_active_;
    Real h_, from_, to_, left_; ///< substep; shares of the step at its ends; rest of the step
    bool drag_changes_;

    auto& room() { return contact_room(solver_); }

    void push(const ContactRowT& row, const Vector& impulse) {
        for (int i = 0; i < row.members; ++i) {
            const auto slot = row.slot[std::size_t(i)];
            const Real share = row.weight[std::size_t(i)] * state_.mobility[slot];
            state_.set_move(slot, clamp_components(state_.move_at(slot) + impulse * share, furthest_move(h_)));
        }
    }
    Vector relative_move(const ContactRowT& row) const {
        Vector sum = -row.surface_move;
        for (int i = 0; i < row.members; ++i)
            sum += state_.move_at(row.slot[std::size_t(i)]) * row.weight[std::size_t(i)];
        return sum;
    }
    Real change(const ContactRowT& row) const { return dot(row.normal, relative_move(row)); }

    void solve(ContactRowT& row, const Soft& soft) {
        const auto moved = relative_move(row);
        const Real along = dot(row.normal, moved);
        const Real next =
            minimum(one_sided_multiplier(row.multiplier, row.mass, along, row.gap, soft), limit::multiplier<Real>);
        const auto slip = moved - row.normal * along;
        auto tangent = row.tangent - slip * row.mass;
        const Real size = norm(tangent), most = row.friction * next;
        if (size > most) tangent *= most * inverse_or_zero(size);
        push(row, row.normal * (next - row.multiplier) + (tangent - row.tangent));
        row.multiplier = next;
        row.tangent = tangent;
        row.most = maximum(row.most, next);
    }

    /// A soft row of a light limb gives way where the whole figure is pressed against a wall. Beyond half a radius the
    /// row is solved as the figure answers with its links held.
    void hold_at_walls() {
        constexpr int rounds = 3;
        for (int i = 0; i < rounds; ++i) {
            bool any = false;
            for (auto& row : room().rows)
                if (row.members == 1 && room().is_exact[row.slot[0]]) any = hold_at_wall(row) || any;
            if (!any) return;
        }
    }
    bool hold_at_wall(ContactRowT& row) {
        const Row slot = row.slot[0];
        const Real deep = Real(0.5) * world_.particles.radius[state_.row_of[slot]], beyond = -row.gap - deep;
        const Real missing = (beyond > Real(0) ? Soft::contact().rate * beyond : beyond) - change(row);
        if (!(missing > Real(0))) return false;
        const auto normal = cast<double>(row.normal);
        const double response = dot(normal, room().projector.response(state_, slot) * normal);
        const Real impulse = minimum(missing * Real(inverse_or_zero(response)), limit::multiplier<Real>);
        push(row, row.normal * impulse);
        row.most = maximum(row.most, row.multiplier + impulse);
        room().projector.project_velocities(state_, slot);
        return impulse > Real(0);
    }

    /// A blow faster than resting contact leaves with its share of the approach.
    bool rebound(ContactRowT& row) {
        const Real resting = Real(4) * square(h_) * norm(state_.gravity);
        if (row.restitution == Real(0) || row.most == Real(0) || row.approach <= resting) return false;
        const Real missing = row.restitution * row.approach - change(row);
        if (!(missing > Real(0))) return false;
        push(row, row.normal * (missing * row.mass));
        row.multiplier += missing * row.mass;
        return true;
    }

    /// Scales the kept multipliers, with the square of the substep; returns the factor.
    Real scale_kept() {
        auto& contacts = world_.contacts;
        const bool is_same = contacts.kept_substep == h_;
        const Real scale = is_same ? Real(1) : square(h_) * inverse_or_zero(square(contacts.kept_substep));
        if (!is_same)
            for (auto& kept : contacts.kept) kept.multiplier *= scale, kept.friction *= scale;
        contacts.kept_substep = h_;
        return scale;
    }

    void keep() {
        auto& contacts = world_.contacts;
        std::erase_if(contacts.kept,
                      [&](const auto& kept) { return !is_asleep(world_.particles, kept.key.particle[0]); });
        for (const auto& row : room().rows) {
            if (row.most > Real(0) && row.collider != ~std::uint32_t(0)) note(row);
            if (row.keeps && row.multiplier > Real(0)) contacts.kept.push_back({row.key, row.multiplier, row.tangent});
        }
        const auto by_key = [](const auto& a, const auto& b) { return a.key < b.key; };
        std::sort(contacts.kept.begin(), contacts.kept.end(), by_key);
        room().joints.store(world_);
        room().projector.links().store(world_);
    }
    void note(const ContactRowT& row) { solver_.touches.add(state_.row_of[row.slot[0]], row.collider, row.most / h_); }
};

} // namespace sinew::detail
