#pragma once

#include "sinew/solver/sweep_state.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <span>
#include <vector>

namespace sinew::detail {

/// Projection of displacements onto those that change no rigid length of colliding figures, in the metric of the
/// masses: G M^-1 G^T y = G d, d -= M^-1 G^T y, by a factorisation within the skyline of each connected component.
/// Redundant links have no pivot and are left out. Components whose skyline is too wide (meshes) are left to the sweep.
template <int D, class Real> class LinkProjector {
  public:
    using Vector = Vec<D, double>;

    /// Finds the links among the particles, and their components. `is_exact` receives 1 per slot of the sweep held
    /// exactly, or not held by links at all.
    void find(const World<D, Real>& world, const SweepState<D, Real>& state, std::span<const char> takes_part,
              std::vector<char>& is_exact) {
        collect(world, state, takes_part);
        order_by_component();
        set_skyline(world, state, is_exact);
    }

    /// Factorises at the present positions.
    void factorise(const SweepState<D, Real>& state) {
        for (auto& link : links_) {
            link.edge = cast<double>(state.place_at(link.b)) - cast<double>(state.place_at(link.a));
            link.along = direction(link.edge);
            link.weight_a = double(state.mobility[link.a]), link.weight_b = double(state.mobility[link.b]);
        }
        for (std::uint32_t k = 0; k < links_.size(); ++k) factorise_row(k);
    }

    enum class Target : bool {
        lengths,   ///< right lengths at the end of the displacement
        velocities ///< no change of length: displacements are velocities, of which no length error may be a part
    };
    void project(SweepState<D, Real>& state, Target target) {
        const auto move = [&](Row slot) { return cast<double>(state.move_at(slot)); };
        for (std::uint32_t k = 0; k < links_.size(); ++k) {
            const auto& link = links_[k];
            const auto change = move(link.b) - move(link.a);
            right_[k] = target == Target::lengths ? norm(link.edge + change) - link.length : dot(link.along, change);
        }
        solve();
        for (std::uint32_t k = 0; k < links_.size(); ++k) {
            const auto& link = links_[k];
            const auto push = link.along * right_[k];
            state.set_move(link.a, cast<Real>(move(link.a) + push * link.weight_a));
            state.set_move(link.b, cast<Real>(move(link.b) - push * link.weight_b));
        }
    }

  private:
    struct Link {
        Row a = 0, b = 0; ///< slots of the sweep
        Row root = 0;     ///< component
        std::uint32_t order = 0;
        std::uint32_t first = 0; ///< first column of the skyline
        std::size_t start = 0;   ///< of the row's entries
        double length = 0, weight_a = 0, weight_b = 0;
        Vector edge{}, along{}; ///< at the start of the substep
    };
    std::vector<Link> links_;
    std::vector<double> entries_, pivots_, right_; ///< strict lower triangle by rows; 1 / pivot, or 0
    std::vector<Row> parent_;
    std::vector<std::uint32_t> first_at_; ///< per slot: the first link there

    static constexpr std::uint32_t none = ~std::uint32_t(0);

    Row root(Row slot) {
        while (parent_[slot] != slot) slot = parent_[slot] = parent_[parent_[slot]];
        return slot;
    }

    static bool is_rigid(const Constraints<Distance<D>, Real>& table, Row row) {
        return table.compliance[row] == Real(0) && table.low(row) == table.high(row) &&
               table.relaxation[row] == Real(1) && table.split[row] == Real(0.5) && !table.gives(row);
    }

    void collect(const World<D, Real>& world, const SweepState<D, Real>& state, std::span<const char> takes_part) {
        const auto& table = std::get<kind_number<Distance, D>>(world.constraints);
        links_.clear();
        parent_.resize(state.size());
        for (Row slot = 0; slot < parent_.size(); ++slot) parent_[slot] = slot;
        for (Row row = 0; row < table.size(); ++row) {
            if (table.in_block[row] || !is_rigid(table, row)) continue;
            const auto ends = table.members[row];
            const Row a = state.slot_of[ends[0]], b = state.slot_of[ends[1]];
            if (a >= state.size() || b >= state.size() || !(takes_part[a] || takes_part[b])) continue;
            const bool moves_a = world.particles.mobility[ends[0]] > Real(0),
                       moves_b = world.particles.mobility[ends[1]] > Real(0);
            if (!moves_a && !moves_b) continue;
            if (moves_a && moves_b) parent_[std::max(root(a), root(b))] = std::min(root(a), root(b));
            links_.push_back({.a = a,
                              .b = b,
                              .root = moves_a ? a : b,
                              .order = std::uint32_t(links_.size()),
                              .length = double(table.low(row))});
        }
    }
    void order_by_component() {
        for (auto& link : links_) link.root = root(link.root);
        std::sort(links_.begin(), links_.end(),
                  [](const Link& x, const Link& y) { return x.root != y.root ? x.root < y.root : x.order < y.order; });
    }

    void set_skyline(const World<D, Real>& world, const SweepState<D, Real>& state, std::vector<char>& is_exact) {
        constexpr std::size_t most_per_link = 100;
        is_exact.assign(state.size(), 1);
        first_at_.assign(state.size(), none);
        std::size_t kept = 0, entries = 0;
        for (std::size_t begin = 0, end = 0; begin < links_.size(); begin = end) {
            while (end < links_.size() && links_[end].root == links_[begin].root) ++end;
            const auto kept_before = kept;
            std::size_t size = 0;
            for (auto i = begin; i < end; ++i, ++kept) {
                links_[kept] = links_[i];
                size += set_first(world, state, std::uint32_t(kept));
            }
            if (size > most_per_link * (end - begin)) {
                for (auto i = kept_before; i < kept; ++i) is_exact[links_[i].a] = is_exact[links_[i].b] = 0;
                kept = kept_before;
                continue;
            }
            for (auto i = kept_before; i < kept; ++i) {
                links_[i].start = entries;
                entries += i - links_[i].first;
            }
        }
        links_.resize(kept);
        entries_.resize(entries);
        pivots_.resize(kept);
        right_.resize(kept);
    }
    /// First column that couples with a link, through a movable end; returns the number of entries.
    std::size_t set_first(const World<D, Real>& world, const SweepState<D, Real>& state, std::uint32_t k) {
        auto& link = links_[k];
        link.first = k;
        for (const Row slot : {link.a, link.b}) {
            if (!(world.particles.mobility[state.row_of[slot]] > Real(0))) continue;
            if (first_at_[slot] == none) first_at_[slot] = k;
            link.first = std::min(link.first, first_at_[slot]);
        }
        return k - link.first;
    }

    double coupling(const Link& k, const Link& m) const {
        double sum = 0;
        if (k.a == m.a) sum += k.weight_a;
        if (k.b == m.b) sum += k.weight_b;
        if (k.a == m.b) sum -= k.weight_a;
        if (k.b == m.a) sum -= k.weight_b;
        return sum == 0 ? 0 : sum * dot(k.along, m.along);
    }

    void factorise_row(std::uint32_t k) {
        constexpr double least = 1e-7; // share of the diagonal; a redundant link has no more than rounding
        const auto& link = links_[k];
        double* const row = entries_.data() + link.start;
        const double whole = link.weight_a + link.weight_b;
        double pivot = whole;
        for (auto m = link.first; m < k; ++m) {
            const auto& other = links_[m];
            const double* const before = entries_.data() + other.start;
            double sum = coupling(link, other);
            for (auto j = std::max(link.first, other.first); j < m; ++j)
                sum -= row[j - link.first] * before[j - other.first];
            row[m - link.first] = sum; // times the pivot, for now
        }
        for (auto m = link.first; m < k; ++m) {
            const double scaled = row[m - link.first] * pivots_[m];
            pivot -= row[m - link.first] * scaled;
            row[m - link.first] = scaled;
        }
        pivots_[k] = pivot > least * whole ? 1 / pivot : 0;
    }

    void solve() {
        for (std::uint32_t k = 0; k < links_.size(); ++k)
            for (auto m = links_[k].first; m < k; ++m)
                right_[k] -= entries_[links_[k].start + m - links_[k].first] * right_[m];
        for (std::uint32_t k = 0; k < links_.size(); ++k) right_[k] *= pivots_[k];
        for (auto k = std::uint32_t(links_.size()); k-- > 0;)
            for (auto m = links_[k].first; m < k; ++m)
                right_[m] -= entries_[links_[k].start + m - links_[k].first] * right_[k];
    }
};

} // namespace sinew::detail
