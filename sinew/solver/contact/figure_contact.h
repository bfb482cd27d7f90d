#pragma once

#include "sinew/solver/contact/row_builder.h"

/// Contacts of colliding figures in a substep of the sweep: soft rows on displacements, whose multipliers are kept from
/// substep to substep (Catto 2011; small steps: Macklin et al. 2019); after each pass over the rows the links of the
/// figures are made exact.
namespace sinew::detail {

template <int D, class Real> class FigureContact {
  public:
    using Vector = Vec<D, Real>;

    FigureContact(World<D, Real>& world, Solver<D, Real>& solver, Real h, Real from_share, Real to_share, Real left)
        : world_(world), solver_(solver), state_(solver.sweep_state), is_active_(has_figure_contacts(solver)), h_(h),
          from_(from_share), to_(to_share), left_(left) {}

    /// After the prediction: rows, and the impulses of the last substep.
    void begin() {
        if (!is_active_) return;
        auto& room = contact_room(solver_);
        scale_kept();
        find_contact_candidates(world_, solver_, left_, h_);
        RowBuilder<D, Real>(world_, solver_, h_, from_, to_).run();
        room.projector.factorise(state_);
        for (auto& row : room.rows) {
            if (!row.keeps) row.multiplier = 0, row.tangent = {};
            push(row, row.normal * row.multiplier + row.tangent);
        }
        room.projector.project(state_, Target::lengths);
    }

    /// After the sweep.
    void solve() {
        if (!is_active_) return;
        auto& room = contact_room(solver_);
        for (auto& row : room.rows) solve(row, row.keeps ? Softness::contact() : Softness::hard());
        room.projector.project(state_, Target::lengths);
        for (auto& row : room.rows) row.gap += change(row);
    }

    /// After the particles have moved: velocities without the push out of overlaps, then rebounds.
    void relax() {
        if (!is_active_) return;
        auto& room = contact_room(solver_);
        for (auto& row : room.rows) solve(row, Softness::none());
        room.projector.project(state_, Target::velocities);
        bool any = false;
        for (auto& row : room.rows) any = rebound(row) || any;
        if (any) room.projector.project(state_, Target::velocities);
        keep();
    }

  private:
    using ContactRowT = ContactRow<D, Real>;
    using Target = typename LinkProjector<D, Real>::Target;

    /// Share of an overlap removed in a substep, and of the multiplier applied and taken back: a damped spring, by
    /// implicit Euler. Stiffer than 1/12 of the substeps' frequency a stack never rests.
    struct Softness {
        Real rate = 0, mass = 1, impulse = 0;

        static Softness contact() {
            constexpr Real turn = Real(2) * pi<Real> / Real(12), damping = Real(10);
            constexpr Real a1 = Real(2) * damping + turn, a2 = turn * a1, a3 = Real(1) / (Real(1) + a2);
            return {turn / a1, a2 * a3, a3};
        }
        static Softness hard() { return {1, 1, 0}; }
        static Softness none() { return {0, 1, 0}; }
    };

    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    SweepState<D, Real>& state_;
    bool is_active_;
    Real h_, from_, to_, left_;

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

    void solve(ContactRowT& row, const Softness& soft) {
        const auto moved = relative_move(row);
        const Real along = dot(row.normal, moved);
        const bool is_open = row.gap > Real(0);
        const Real bias = is_open ? row.gap : soft.rate * row.gap;
        const Real mass = row.mass * (is_open ? Real(1) : soft.mass), back = is_open ? Real(0) : soft.impulse;
        const Real next =
            clamp(row.multiplier - mass * (along + bias) - back * row.multiplier, Real(0), limit::multiplier<Real>);
        const auto slip = moved - row.normal * along;
        auto tangent = row.tangent - slip * row.mass;
        const Real size = norm(tangent), most = row.friction * next;
        if (size > most) tangent *= most * inverse_or_zero(size);
        push(row, row.normal * (next - row.multiplier) + (tangent - row.tangent));
        row.multiplier = next;
        row.tangent = tangent;
        row.most = maximum(row.most, next);
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

    /// Multipliers scale with the square of the substep.
    void scale_kept() {
        auto& contacts = world_.contacts;
        const Real scale = square(h_) * inverse_or_zero(square(contacts.kept_substep));
        if (contacts.kept_substep != h_)
            for (auto& kept : contacts.kept) kept.multiplier *= scale, kept.friction *= scale;
        contacts.kept_substep = h_;
    }

    void keep() {
        auto& contacts = world_.contacts;
        contacts.kept.clear();
        for (const auto& row : contact_room(solver_).rows) {
            if (row.most > Real(0) && row.collider != ~std::uint32_t(0)) note(row);
            if (row.keeps && row.multiplier > Real(0)) contacts.kept.push_back({row.key, row.multiplier, row.tangent});
        }
        const auto by_key = [](const auto& a, const auto& b) { return a.key < b.key; };
        std::sort(contacts.kept.begin(), contacts.kept.end(), by_key);
    }
    void note(const ContactRowT& row) {
        note_touch(world_.contacts, row.collider, state_.row_of[row.slot[0]], row.most / h_);
    }
};

} // namespace sinew::detail
