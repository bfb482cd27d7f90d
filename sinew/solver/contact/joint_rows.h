#pragma once

#include "sinew/solver/contact/rigid_links.h"
#include "sinew/solver/contact/softness.h"
#include "sinew/solver/project.h"
#include "sinew/solver/solver.h"

/// Joint limits of colliding figures (angles, folds, ranges of distances) as rows beside the contacts: soft, with
/// multipliers kept from substep to substep. A sweep that corrects limits while contacts hold the limbs never comes to
/// rest.
namespace sinew::detail {

/// Limit between particles whose links are exact.
struct JointSource {
    int kind = 0;
    Row row = 0;
};

/// Row of a limit in a substep: low <= measure + sum of dot(gradient_i, displacement_i) <= high.
template <int D, class Real> struct JointRow {
    static constexpr std::size_t max_members = 4;
    JointSource source{};
    std::array<Row, max_members> slot{};
    std::array<Vec<D, Real>, max_members> gradient{};
    std::size_t members = 0;
    bool is_equality = false;
    Real mass = 0;       ///< 1 / sum of inverse mass gradient^2
    Real above_low = 0;  ///< measure above the low limit at the start of the substep, radians or metres
    Real below_high = 0; ///< measure below the high limit
    Real multiplier = 0; ///< positive at the low limit, negative at the high one
};

template <class Kind> constexpr bool makes_joint_rows = Kind::length_power <= 1 && Kind::arity > 0 && Kind::arity <= 4;

template <int D, class Real> class JointRows {
  public:
    /// Lists the plain limits among particles for which `is_exact(slot)`.
    template <class IsExact> void find(const World<D, Real>& world, const Solver<D, Real>& solver, IsExact&& is_exact) {
        sources_.clear();
        int kind = 0;
        for_each_table(world, [&](const auto& table) {
            list(table, kind, solver, is_exact);
            ++kind;
        });
    }
    bool takes(int kind, Row row) const {
        return kind < Kinds<D>::size && row < is_taken_[std::size_t(kind)].size() && is_taken_[std::size_t(kind)][row];
    }

    /// Rows at the present places, with the multipliers of the last substep times `scale`.
    void begin(World<D, Real>& world, SweepState<D, Real>& state, Real scale) {
        rows_.clear();
        for (const auto& source : sources_)
            visit_table(world, source.kind, [&]<class Table>(const Table& table) {
                if constexpr (makes_joint_rows<typename Table::Kind>) add(table, source, state, scale);
            });
        for (auto& row : rows_) apply(state, row, row.multiplier);
    }
    /// Scales the multipliers of the bodies of particles.
    template <class Share> void scale(const Share& share_of) {
        for (auto& row : rows_) {
            const auto members = std::span(row.slot).first(row.members);
            Real share = 1;
            for (const Row slot : members) share = min(share, share_of(slot));
            row.multiplier *= share;
        }
    }
    void solve(SweepState<D, Real>& state, const Softness<Real>& soft) {
        for (auto& row : rows_) solve(state, row, soft);
    }
    /// Measures at the end of the displacements.
    void advance(const SweepState<D, Real>& state) {
        for (auto& row : rows_) {
            const Real change = change_of(state, row);
            row.above_low += change, row.below_high -= change;
        }
    }
    void store(World<D, Real>& world) const {
        for (const auto& row : rows_)
            visit_table(world, row.source.kind,
                        [&](auto& table) { table.multiplier[row.source.row] = row.multiplier; });
    }

  private:
    using RowT = JointRow<D, Real>;
    std::vector<JointSource> sources_;
    std::vector<RowT> rows_;
    std::array<std::vector<char>, std::size_t(Kinds<D>::size)> is_taken_;

    template <class Table, class IsExact>
    void list(const Table& table, int kind, const Solver<D, Real>& solver, IsExact&& is_exact) {
        using Kind = typename Table::Kind;
        auto& taken = is_taken_[std::size_t(kind)];
        taken.clear();
        if constexpr (makes_joint_rows<Kind>) {
            taken.assign(table.size(), 0);
            for (Row row = 0; row < table.size(); ++row) {
                const auto members = table.members[row];
                bool is_link = Kind::length_power > 0 && table.low(row) == table.high(row);
                if constexpr (std::is_same_v<Kind, Distance<D>>) is_link = sinew::detail::is_link(table, row);
                if (is_link || solver.blocks.holds(table, row) || !is_plain(table, row) ||
                    !std::all_of(members.begin(), members.end(),
                                 [&](Row member) { return is_exact(solver.sweep_state.slot_of[member]); }))
                    continue;
                taken[row] = 1;
                sources_.push_back({kind, row});
            }
        }
    }

    template <class Table>
    void add(const Table& table, const JointSource& source, const SweepState<D, Real>& state, Real scale) {
        using Kind = typename Table::Kind;
        const auto members = table.members[source.row];
        Stencil<Kind, D, Real> stencil({}, members.size());
        stencil.each([&](std::size_t i) { stencil.points[i] = state.position_at(state.slot_of[members[i]]); });
        const Real low = table.low(source.row), high = table.high(source.row);
        const Real measure = unwrap<Kind>(stencil.evaluate(stencil.points, stencil.gradient), low, high);
        RowT row{.source = source,
                 .members = members.size(),
                 .is_equality = low == high,
                 .above_low = measure - low,
                 .below_high = high - measure};
        Real response = 0;
        stencil.each([&](std::size_t i) {
            row.slot[i] = state.slot_of[members[i]];
            row.gradient[i] = stencil.gradient[i];
            response += state.mobility[row.slot[i]] * dot(row.gradient[i], row.gradient[i]);
        });
        if (response == Real(0)) return;
        row.mass = Real(1) / response;
        row.multiplier = table.multiplier[source.row] * scale;
        rows_.push_back(row);
    }

    static void apply(SweepState<D, Real>& state, const RowT& row, Real multiplier) {
        const Real furthest = max_displacement(Real(1) / state.per_h);
        for (std::size_t i = 0; i < row.members; ++i) {
            const auto moved = row.gradient[i] * (multiplier * state.mobility[row.slot[i]]);
            state.set_displacement(row.slot[i], clamp_components(state.displacement_at(row.slot[i]) + moved, furthest));
        }
    }
    static Real change_of(const SweepState<D, Real>& state, const RowT& row) {
        Real sum = 0;
        for (std::size_t i = 0; i < row.members; ++i) sum += dot(row.gradient[i], state.displacement_at(row.slot[i]));
        return sum;
    }
    static Real next_multiplier(const RowT& row, Real change, const Softness<Real>& soft) {
        if (row.is_equality) return two_sided_multiplier(row.multiplier, row.mass, change, row.above_low, soft);
        return one_sided_multiplier(max(row.multiplier, Real(0)), row.mass, change, row.above_low, soft) -
               one_sided_multiplier(max(-row.multiplier, Real(0)), row.mass, -change, row.below_high, soft);
    }
    static void solve(SweepState<D, Real>& state, RowT& row, const Softness<Real>& soft) {
        const Real next =
            clamp(next_multiplier(row, change_of(state, row), soft), -limit::multiplier<Real>, limit::multiplier<Real>);
        apply(state, row, next - row.multiplier);
        row.multiplier = next;
    }
};

} // namespace sinew::detail
