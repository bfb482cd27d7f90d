#pragma once

#include "sinew/solver/contact/deep_rows.h"
#include "sinew/solver/contact/kept_contacts.h"
#include "sinew/solver/contact/merge_touches.h"
#include "sinew/solver/contact/pin_rows.h"
#include "sinew/solver/contact/rebounds.h"
#include "sinew/solver/contact/row_builder.h"
#include "sinew/solver/contact/row_islands.h"
#include "sinew/solver/contact/row_solver.h"
#include "sinew/solver/contact/warm_start.h"

#include <algorithm>

/// Contacts of colliding figures in a substep of the sweep: soft rows on displacements, whose multipliers are kept from
/// substep to substep (Catto 2011; small steps: Macklin et al. 2019); after each pass over the rows the links of the
/// figures are made exact.
namespace sinew::detail {

template <int D, class Real> class FigureContact {
  public:
    using Vector = Vec<D, Real>;
    using RowT = ContactRow<D, Real>;
    using Origin = ContactOrigin<D, Real>;
    using Part = ContactPart<D, Real>;
    using Soft = Softness<Real>;

    /// `number`: substep, counted from 1.
    FigureContact(World<D, Real>& world, Solver<D, Real>& solver, Real h, int number, int substeps)
        : world_(world), solver_(solver), state_(solver.sweep_state), is_active_(has_figure_contacts(solver)), h_(h),
          from_(Real(number - 1) / Real(substeps)), to_(Real(number) / Real(substeps)),
          left_(h * Real(substeps - number + 1)), is_first_(number == 1), is_last_(number == substeps),
          drag_changes_(number <= 2), threads_(threads_for(state_.size(), solver.options.threads_wanted())) {}

    /// After the prediction: rows, the impulses of the last substep, and rebounds.
    void begin() {
        if (!is_active_) return;
        const Real scale = scale_kept();
        list_candidates();
        room().parts.run_all(threads_, [&](Part& part) { build_rows(world_, solver_, part, h_, from_, to_); });
        RowIslands<D, Real>(room(), state_).find();
        room().projector.begin(state_, drag_changes_, is_last_, threads_);
        WarmStart<D, Real> warm_start(room(), state_);
        warm_start.note();
        each_part([&](Part& part) {
            for (auto& row : part.rows) apply_again(row);
        });
        room().joints.begin(world_, state_, scale);
        room().projector.project_velocities(state_, threads_);
        warm_start.bound();
        Rebounds<D, Real>(room(), state_, rows_, h_).run();
        note_loads();
    }

    /// After the sweep.
    void solve() {
        if (!is_active_) return;
        PinRows<D, Real>(world_, solver_, h_, from_, to_).solve();
        room().joints.solve(state_, Soft::contact());
        solve_rows(&Soft::contact, Soft::hard(), [](const Origin&, const auto&) { return true; });
        deep_.hold();
        room().projector.project_lengths(state_, threads_);
        if constexpr (D == 3) deep_.hold_again();
        each_part([&](Part& part) {
            rows_.each(part,
                       [&](RowT& row, const Origin&, const Vector& surface) { row.gap += rows_.change(row, surface); });
        });
        room().joints.advance(state_);
        note_sensed();
    }

    /// After the particles have moved: velocities without the push out of overlaps.
    void relax() {
        if (!is_active_) return;
        room().projector.restore_energy(state_, threads_);
        each_part([&](Part& part) { rows_.follow_centres(part); });
        room().joints.solve(state_, Soft::none());
        Rebounds<D, Real> rebounds(room(), state_, rows_, h_);
        solve_rows(
            [](Real) { return Soft::none(); }, Soft::none(),
            [&](const Origin& origin, const auto& change_of) { return !rebounds.awaits_blow(origin, change_of); });
        rebounds.forget_blows();
        keep();
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    SweepState<D, Real>& state_;
    bool is_active_;
    Real h_, from_, to_, left_; ///< substep; shares of the step at its ends; rest of the step
    RowSolver<D, Real> rows_{state_, max_displacement(h_)};
    DeepRows<D, Real> deep_{solver_, rows_, h_};
    bool is_first_, is_last_, drag_changes_;
    int threads_;

    auto& room() { return *solver_.contacts; }

    /// A pass over all rows for which acts(origin, change of the gap), those kept with softness for the mass they
    /// carry; then the links are held.
    template <class Soften, class Acts> void solve_rows(const Soften& soften, const Soft& others, const Acts& acts) {
        const auto soft_of = [&, kept = soften(Real(1))](const RowT& row) {
            return row.load > Real(1) ? soften(row.load) : kept;
        };
        room().projector.begin_rows(state_, threads_);
        const auto rows = rows_on_clusters();
        each_part([&](Part& part) {
            rows.each(part, [&](RowT& row, const Origin& origin, const Vector& surface) {
                if (!row.is_held && !row.is_repeated && acts(origin, [&] { return rows.change(row, surface); }))
                    rows.solve(row, row.keeps ? soft_of(row) : others, surface);
            });
        });
        RowIslands<D, Real>(room(), state_).solve(rows, soften, [&](const RowT& row, const Origin& origin) {
            return acts(origin, [&] { return rows.change(row, origin.surface_displacement); });
        });
        room().projector.end_rows(state_, threads_);
        solve_held(soft_of, acts);
    }
    /// Rows beside heavy loads, until the impulses on each figure agree: friction along a rope adds up from post to
    /// post.
    template <class SoftOf, class Acts> void solve_held(const SoftOf& soft_of, const Acts& acts) {
        constexpr int most = 32;
        constexpr Real exact = Real(0.02);
        Delassus<D, Real> figures(room(), state_, rows_);
        const auto all = std::span(room().held_rows);
        for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
            while (last < all.size() && all[last].island == all[first].island) ++last;
            const auto island = all.subspan(first, last - first);
            figures.begin([&](const auto& add) {
                for (const auto& one : island) add(room().parts.list[one.part].rows[one.row]);
            });
            const auto nodes_of = [&](std::size_t i) { return DelassusNodes<D, Real>{figures, i}; };
            settle_rows(
                room(), island, {.most = most, .exact = exact},
                [&](std::size_t i, RowT& row, const Origin& origin) {
                    const auto& surface = origin.surface_displacement;
                    const auto change = [&] { return dot(row.normal, nodes_of(i).displacement() - surface); };
                    if (acts(origin, change)) rows_.solve(row, nodes_of(i), soft_of(row), surface);
                },
                [&](std::size_t i, RowT& row, const Vector& impulse) { rows_.add(row, nodes_of(i), impulse); });
            figures.finish();
        }
    }
    RowSolver<D, Real> rows_on_clusters() { return {state_, max_displacement(h_), room().projector.motions()}; }
    template <class Work> void each_part(const Work& work) { room().parts.run(threads_, work); }

    void list_candidates() {
        if (is_first_) set_margin(), find_nested_solids(world_, solver_);
        const bool is_new = find_contact_candidates(world_, solver_, left_, h_);
        if (is_first_ || is_new)
            find_near_planes(world_, room(), WallRows<D, Real>::margin(0, norm(state_.gravity), h_), is_first_);
        KeptContacts<D, Real> kept(world_, solver_);
        if (is_first_)
            kept.take_from_world(is_new);
        else if (is_new)
            kept.take_from_last_list();
    }
    /// Margin of the list: small ones list few pairs in vain, and large ones are listed seldom.
    void set_margin() {
        constexpr Real share_of_radius = Real(0.1);
        auto& list = room().list;
        Real widest = 0;
        for (const auto& particle : room().particles) widest = max(widest, particle.radius);
        const Real gravity = norm(state_.gravity);
        const Real margin = max(share_of_radius * widest, gravity * square(left_)) + std::numeric_limits<Real>::min();
        const Real near_by = gravity * square(h_) * Real(4);
        list.is_valid = list.is_valid && list.margin == margin && list.near_by == near_by && list.widest == widest;
        list.margin = margin, list.near_by = near_by, list.widest = widest;
    }

    /// Elastic links begin every substep without multipliers: so do rows on them.
    bool is_elastic(Row slot) const {
        const auto& components = state_.plan.components;
        const auto after = std::upper_bound(components.begin(), components.end(), slot,
                                            [](Row s, const Component& component) { return s < component.begin.slot; });
        return (after - 1)->is_elastic;
    }
    /// Loads work against links.
    void note_loads() {
        for (const auto& part : room().parts.list)
            for (const auto& row : part.rows)
                if (row.multiplier > Real(0))
                    for (const Row slot : row.slots()) room().projector.note_load(slot);
    }
    void apply_again(RowT& row) {
        if (!row.keeps || is_elastic(row.slot[0]) || !(row.multiplier > Real(0)))
            row.multiplier = 0, row.tangent = {};
        else
            rows_.apply_again(row);
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
        KeptContacts<D, Real> kept(world_, solver_);
        for (const auto& part : room().parts.list)
            for (auto i = part.first_wall; i < part.rows.size(); ++i)
                if (part.rows[i].max > Real(0) && part.origins[i].collider != ~std::uint32_t(0))
                    note(part.rows[i], part.origins[i]);
        if (world_.contacts.lists_figures) note_figures();
        kept.keep();
        room().joints.store(world_);
        if (!is_last_) return;
        kept.give_to_world();
        room().projector.store(world_, state_);
    }
    /// Lists the figures that press, and those so near that a touch goes on without a force.
    void note_figures() {
        const Real near = Real(0.01) * room().list.widest;
        for (const auto& part : room().parts.list)
            for (std::size_t i = 0; i < part.first_wall; ++i)
                if (const auto& row = part.rows[i]; row.max > Real(0) || row.gap <= near)
                    solver_.touches.figures.push_back(
                        touch_of(row, part.origins[i], room().list.candidates[part.origins[i].source]));
        merge_touches(solver_.touches.figures);
    }
    /// Sensors touch the links that a solid collider would stop.
    void note_sensed() {
        for (const auto& part : room().parts.list)
            for (std::size_t i = 0; i < part.sensed.size(); ++i) {
                const auto& row = part.sensed[i];
                const auto& origin = part.sensed_origins[i];
                if (row.gap + rows_.change(row, origin.surface_displacement) < Real(0))
                    solver_.touches.add(state_.row_of[row.slot[0]], origin.collider, Real(0));
            }
    }
    /// Impulse of a row in the substep, newton seconds.
    Real impulse_of(const RowT& row, const Origin& origin) const { return (row.multiplier + origin.pushed) / h_; }
    FigureTouch touch_of(const RowT& row, const Origin& origin, const ContactCandidate& pair) {
        auto [first, one] = side_of(pair.first);
        auto [second, other] = side_of(pair.second);
        auto place = place_of(row, origin);
        if (second < first) {
            std::swap(first, second), std::swap(one, other);
            for (auto& number : place.normal) number = -number;
        }
        const double impulse = double(impulse_of(row, origin));
        return {first, second, {one, other}, impulse, {.impulse = impulse}, place};
    }
    /// Between the nearest points of both features.
    TouchPlace place_of(const RowT& row, const Origin& origin) const {
        TouchPlace place{.speed = double(origin.approach / h_)};
        Vector point{};
        for (std::size_t i = 0; i < std::size_t(row.members); ++i)
            point += state_.position_at(row.slot[i]) * (Real(0.5) * absolute(row.weight[i]));
        for (int k = 0; k < D; ++k)
            place.point[std::size_t(k)] = double(point[k]), place.normal[std::size_t(k)] = double(row.normal[k]);
        return place;
    }
    /// Figure of a feature, and slot of its particle or of its first end.
    std::pair<FigureIndex, std::uint32_t> side_of(std::uint32_t feature) {
        const auto count = room().particles.size();
        const Row row = feature < count            ? room().particles[feature].row
                        : room().is_solid(feature) ? room().particles[room().first_corner_of(feature)].row
                                                   : room().segments[feature - count].a;
        return {world_.particles.figure[row], world_.particles.handles.index_of(row)};
    }
    void note(const RowT& row, const Origin& origin) {
        const Row first = state_.row_of[row.slot[0]];
        Vector point{};
        for (std::size_t i = 0; i < std::size_t(row.members); ++i)
            point += state_.position_at(row.slot[i]) * row.weight[i];
        point -= row.normal * (row.gap + world_.particles.radius[first]);
        solver_.touches.add(first, origin.collider, impulse_of(row, origin), {point, row.normal, origin.approach / h_});
    }
};

} // namespace sinew::detail
