#pragma once

#include "sinew/math/vec.h"
#include "sinew/solver/id.h"
#include "sinew/solver/plan.h"

#include <algorithm>
#include <array>
#include <vector>

namespace sinew {

/// The particles of the sweep while a step lasts: column by column, and in slots that put side by side what is solved
/// side by side. It follows from the rest of the world: a copy begins without.
template <int D, class Real> struct Swept {
    static constexpr Row none = ~Row(0);

    std::vector<Row> row_of;  ///< by slot
    std::vector<Row> slot_of; ///< by row; none of what a block moves
    std::array<Real*, D> place{}, move{},
        residual{};           ///< move: where it will be when the substep ends, less where it is
    Real* mobility = nullptr; ///< less by drag; 0 while nothing moves it
    Real per_h = 0;
    bool any_force = false;      ///< acts on a single particle in this step
    bool everyone_alike = false; ///< in this step only gravity acts, which is
    Vec<D, Real> gravity{};
    Real largest_radius = 0;
    bool any_pin_moves = false, any_pin_soft = false; ///< in this step
    Plan<Real> plan;
    PlanRoom room;
    Plan<Real> spare; ///< sheets that are taken out while others are laid out before them
    std::vector<Row> spare_rows;

    Swept() = default;
    Swept(const Swept&) {}
    Swept& operator=(const Swept&) { return *this; }
    Swept(Swept&&) = default;
    Swept& operator=(Swept&&) = default;
    ~Swept() = default;

    std::uint32_t size() const { return std::uint32_t(row_of.size()); }

    void give_slot(Row row) {
        slot_of[row] = size();
        row_of.push_back(row);
    }

    void reserve(std::size_t particles) {
        row_of.reserve(particles);
        slot_of.reserve(particles);
        spare_rows.reserve(particles);
        columns_.clear(); // which moves
        columns_.reserve((particles + 2048) * (3 * D + 1));
    }

    /// Room for all slots, behind which there is nothing.
    void make_room() {
        if (has_room()) return;
        constexpr std::size_t columns = 3 * D + 1, line = 64;
        stride_ = stride();
        used_ = row_of.size();
        columns_.assign(stride_ * columns + line / sizeof(Real), Real(0));
        Real* next =
            columns_.data() + (line - reinterpret_cast<std::uintptr_t>(columns_.data()) % line) % line / sizeof(Real);
        for (auto* kind : {&place, &move, &residual})
            for (auto& column : *kind) column = next, next += stride_;
        mobility = next;
    }

    /// From one component of a column to the next.
    std::size_t apart() const { return std::size_t(place[1] - place[0]); }

    Vec<D, Real> place_at(Row slot) const { return get(place, slot); }
    Vec<D, Real> move_at(Row slot) const { return get(move, slot); }
    Vec<D, Real> velocity_at(Row slot) const { return get(move, slot) * per_h; }
    void set_move(Row slot, const Vec<D, Real>& to) { put(move, slot, to); }
    Vec<D, Real> residual_at(Row slot) const { return get(residual, slot); }

    static Vec<D, Real> get(const std::array<Real*, D>& columns, Row slot) {
        return Vec<D, Real>::map([&](int i) { return columns[std::size_t(i)][slot]; });
    }
    static void put(const std::array<Real*, D>& columns, Row slot, const Vec<D, Real>& numbers) {
        for (int i = 0; i < D; ++i) columns[std::size_t(i)][slot] = numbers[i];
    }

    LinkColumns<D, Real> link_columns(Real* multiplier) const {
        LinkColumns<D, Real> columns{};
        columns.place = place[0], columns.move = move[0], columns.apart = apart();
        columns.mobility = mobility;
        columns.low = plan.parameters.low();
        columns.high = plan.parameters.high();
        columns.quarter_per_square = plan.parameters.quarter_per_square();
        columns.compliance = plan.parameters.compliance();
        columns.ends_a = plan.ends_a.data();
        columns.ends_b = plan.ends_b.data();
        columns.rows = plan.rows.data();
        columns.multiplier = multiplier;
        return columns;
    }

  private:
    std::vector<Real> columns_;
    std::size_t stride_ = 0, used_ = 0;

    /// Columns a whole number of pages apart would fight for the same lines of the cache; each begins with a line.
    std::size_t stride() const {
        constexpr std::size_t page = 4096 / sizeof(Real), apart = 576 / sizeof(Real);
        return (row_of.size() + page - 1) / page * page + apart;
    }
    bool has_room() {
        if (columns_.empty() || stride() != stride_) return false;
        const auto clear = [&](Real* column) {
            std::fill(column + std::min(row_of.size(), used_), column + used_, Real(0));
        };
        for (auto* kind : {&place, &move, &residual}) std::for_each(kind->begin(), kind->end(), clear);
        clear(mobility);
        used_ = row_of.size();
        return true;
    }
};

} // namespace sinew
