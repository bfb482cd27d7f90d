#pragma once

#include "sinew/assert/assert.h"
#include "sinew/math/vec.h"
#include "sinew/solver/free_bodies.h"
#include "sinew/solver/plan.h"
#include "sinew/solver/rolling.h"
#include "sinew/table/id.h"

#include <algorithm>
#include <array>
#include <vector>

namespace sinew {

/// Blow of a wall on a particle of the sweep in a substep.
template <int D, class Real> struct WallBlow {
    Vec<D, Real> normal{};      ///< of the wall
    Real away = 0;              ///< speed along the normal afterwards, at least
    Real stopped = 0;           ///< speed along the normal that the contact has given already
    Vec<D, Real> surface{};     ///< velocity of the wall
    Real friction = 0;          ///< Coulomb's coefficient
    std::uint32_t collider = 0; ///< 1 + index of the collider; 0 for a plane of the world
};

/// Blows on a particle in a substep, at most one for each direction: a corner has D walls.
template <int D, class Real> struct WallBlows {
    std::array<WallBlow<D, Real>, std::size_t(D)> list{};
    std::size_t count = 0;
    Vec<D, Real> displacement{}; ///< of the particle in the substep, before the first blow

    void add(const WallBlow<D, Real>& blow) {
        constexpr Real alike = Real(1) - Real(1e-5); // cosine of the angle between walls that are one
        for (std::size_t i = 0; i < count; ++i)
            if (dot(list[i].normal, blow.normal) > alike) {
                list[i].stopped += blow.stopped;
                return;
            }
        if (count < list.size()) list[count++] = blow;
    }
};

/// Particles of the sweep during a step: one column per component, in slots arranged so that particles solved together
/// are adjacent. Derived from the rest of the world: copies start empty.
template <int D, class Real> struct SweepState {
    static constexpr Row none = ~Row(0);

    std::vector<Row> row_of;                                     ///< by slot
    std::vector<Row> slot_of;                                    ///< by row; `none` for particles in direct blocks
    std::array<Real*, D> position{}, displacement{}, residual{}; ///< move: displacement to the end of the substep
    Real* mobility = nullptr;                                    ///< inverse mass, scaled by drag; 0: immovable
    Real per_h = 0;
    bool any_force = false;      ///< some swept particle has an external force in this step
    bool everyone_alike = false; ///< only gravity acts in this step, equally on all
    Vec<D, Real> gravity{};
    Real largest_radius = 0;
    std::vector<WallBlows<D, Real>> blows; ///< by slot, in this substep
    RollingRows rolling;
    std::vector<Roller<D, Real>> rollers;             ///< by slot; none where nothing rolls
    bool any_pin_moves = false, any_pin_soft = false; ///< in this step
    Plan<Real> plan;
    std::vector<std::array<Real, 2>>
        bend_legs; ///< by row of a bend: lengths below which it fades, in this step; or none
    FreeBodies<D> bodies;
    PlanRoom room;
    Plan<Real> spare; ///< components set aside while others are laid out before
    std::vector<Row> spare_rows;

    std::uint32_t size() const { return std::uint32_t(row_of.size()); }

    void give_slot(Row row) {
        SINEW_ASSERT(slot_of[row] == none, "a particle has one slot");
        slot_of[row] = size();
        row_of.push_back(row);
    }

    void reserve(std::size_t particles) {
        row_of.reserve(particles);
        slot_of.reserve(particles);
        spare_rows.reserve(particles);
        blows.reserve(particles);
        bodies.reserve(particles);
        columns_.clear(); // reallocation moves the columns
        columns_.reserve((particles + 2048) * (3 * D + 1));
    }

    /// Sizes the columns to the slots; the padding is zero.
    void make_room() {
        if (has_room()) return;
        constexpr std::size_t columns = 3 * D + 1, line = 64;
        stride_ = padded_stride();
        used_ = row_of.size();
        columns_.assign(stride_ * columns + line / sizeof(Real), Real(0));
        Real* next =
            columns_.data() + (line - reinterpret_cast<std::uintptr_t>(columns_.data()) % line) % line / sizeof(Real);
        for (auto* kind : {&position, &displacement, &residual})
            for (auto& column : *kind) column = next, next += stride_;
        mobility = next;
    }

    /// Stride between the components of a column.
    std::size_t stride() const {
        SINEW_ASSERT(std::size_t(position[1] - position[0]) >= row_of.size(), "a column has room for every slot");
        return std::size_t(position[1] - position[0]);
    }

    Vec<D, Real> position_at(Row slot) const { return get(position, slot); }
    Vec<D, Real> displacement_at(Row slot) const { return get(displacement, slot); }
    Vec<D, Real> velocity_at(Row slot) const { return get(displacement, slot) * per_h; }
    bool rolls(Row slot) const { return !rollers.empty() && rollers[slot].per_inertia > Real(0); }
    /// Rim displaced per impulse, 1 / kg.
    Real rim_mobility(Row slot) const { return mobility[slot] * rollers[slot].per_inertia; }
    void set_displacement(Row slot, const Vec<D, Real>& to) { put(displacement, slot, to); }
    Vec<D, Real> residual_at(Row slot) const { return get(residual, slot); }

    static Vec<D, Real> get(const std::array<Real*, D>& columns, Row slot) {
        return Vec<D, Real>::map([&](int i) { return columns[std::size_t(i)][slot]; });
    }
    static void put(const std::array<Real*, D>& columns, Row slot, const Vec<D, Real>& numbers) {
        for (int i = 0; i < D; ++i) columns[std::size_t(i)][slot] = numbers[i];
    }

    DistanceColumns<D, Real> link_columns(Real* multiplier) const {
        DistanceColumns<D, Real> columns{};
        columns.position = position[0], columns.displacement = displacement[0], columns.stride = stride();
        columns.mobility = mobility;
        plan.parameters.show(columns);
        columns.ends_a = plan.ends_a.data();
        columns.ends_b = plan.ends_b.data();
        columns.rows = plan.rows.data();
        columns.multiplier = multiplier;
        return columns;
    }

  private:
    std::vector<Real> columns_;
    std::size_t stride_ = 0, used_ = 0;

    /// Stride of the columns. Columns a multiple of the page size apart would compete for the same cache lines; each
    /// starts on a cache line.
    std::size_t padded_stride() const {
        constexpr std::size_t page = 4096 / sizeof(Real), padding = 576 / sizeof(Real);
        return (row_of.size() + page - 1) / page * page + padding;
    }
    bool has_room() {
        if (columns_.empty() || padded_stride() != stride_) return false;
        const auto clear = [&](Real* column) {
            std::fill(column + std::min(row_of.size(), used_), column + used_, Real(0));
        };
        for (auto* kind : {&position, &displacement, &residual}) std::for_each(kind->begin(), kind->end(), clear);
        clear(mobility);
        used_ = row_of.size();
        return true;
    }
};

} // namespace sinew
