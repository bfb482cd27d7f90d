#pragma once

#include "sinew/math/random.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <utility>

/// Cloth that is gathered, pins nearer to each other than the cloth between them; or pulled, further than it reaches.
namespace sinew::detail {

/// Before a step, finds the tethered components that cannot give way. Their links push against each other, and tethers
/// and repairs, which only pull, would work against them for ever; or two pins pull them apart, and the tethers of one
/// would work against those of the other. Cloth that lies exactly in a plane of two axes has
/// no rounding errors across it and cannot buckle: it is given a velocity far below what can be seen.
template <int D, class Real> class Crumpling {
  public:
    Crumpling(World<D, Real>& world, SweepState<D, Real>& state) : world_(world), state_(state), plan_(state.plan) {}

    void find() {
        for (auto& component : plan_.components) {
            component.is_crushed = component.is_gathered = false;
            if (component.tethers == 0) continue;
            const auto [nearest, furthest] = spans(component);
            component.is_crushed = furthest > 1 + slight || is_overstretched(component);
            component.is_gathered = nearest <= gathered;
            if (!component.is_gathered) continue;
            component.is_crushed = component.is_crushed || is_crushed(component);
            if constexpr (D == 3) leave_plane(component);
        }
    }

  private:
    using Vector = Vec<D, Real>;

    World<D, Real>& world_;
    SweepState<D, Real>& state_;
    Plan<Real>& plan_;

    const Vector& position(Row slot) const { return world_.particles.position[state_.row_of[slot]]; }
    const Vector& velocity(Row slot) const { return world_.particles.velocity[state_.row_of[slot]]; }

    static constexpr Real gathered = Real(0.95), slight = Real(1e-3);

    /// Smallest and largest distance between two pins, as a fraction of the way along the cloth.
    std::pair<Real, Real> spans(const Component& component) const {
        const auto tethers = std::span(plan_.tethers).subspan(component.first_tether, component.tethers);
        constexpr Real unreachable = Real(0.5) / square(limit::coordinate<Real>); // no way of links joins the pins
        Real least = limit::measure<Real>, most = 0;
        for (const auto& from : tethers)
            for (const auto& to : tethers) {
                const auto apart = position(component.begin.slot + to.at) - position(component.begin.slot + from.at);
                const Real half_per_square = plan_.half_per_max_length_square[from.first + to.at];
                if (from.at == to.at || !(half_per_square > unreachable)) continue;
                const Real square_of_span = Real(2) * dot(apart, apart) * half_per_square;
                least = min(least, square_of_span), most = max(most, square_of_span);
            }
        return {square_root(least), square_root(most)};
    }

    /// True if a particle is further from a pin than the cloth reaches, as after such a pull: tethers would bring it
    /// back at once. The links do so slowly.
    bool is_overstretched(const Component& component) const {
        constexpr Real much = Real(1.05);
        const Row first = component.begin.slot, last = plan_.end_of(component).slot;
        for (const auto& from : std::span(plan_.tethers).subspan(component.first_tether, component.tethers)) {
            const auto* half_per_square = plan_.half_per_max_length_square.data() + from.first;
            for (Row slot = first; slot < last; ++slot) {
                const auto apart = position(slot) - position(first + from.at);
                if (Real(2) * dot(apart, apart) * half_per_square[slot - first] > square(much)) return true;
            }
        }
        return false;
    }

    /// True if a rigid link has lost a quarter of its length.
    bool is_crushed(const Component& component) const {
        constexpr Real share = Real(0.75);
        const auto& table = std::get<kind_number<Distance, D>>(world_.constraints);
        bool found = false;
        for (auto i = component.begin.run; i < plan_.end_of(component).run && !found; ++i)
            plan_.each_link(plan_.runs[i], [&](Row row, Row a, Row b) {
                const auto link = position(b) - position(a);
                const Real shortest = share * table.low(row);
                found = found || (shortest > Real(0) && table.is_rigid(row) && dot(link, link) < shortest * shortest);
            });
        return found;
    }

    void leave_plane(const Component& component) {
        const Row first = component.begin.slot, last = plan_.end_of(component).slot;
        for (int k = 0; k < D; ++k) {
            Real size = 0;
            bool is_flat = true;
            for (Row slot = first; slot < last && is_flat; ++slot) {
                is_flat = position(slot)[k] == position(first)[k] && velocity(slot)[k] == Real(0);
                size = max(size, norm(position(slot) - position(first)));
            }
            if (is_flat) stir(first, last, k, size);
        }
    }
    void stir(Row first, Row last, int axis, Real size) {
        constexpr Real rate = Real(1e-6); // of the size, 1 / time
        for (Row slot = first; slot < last; ++slot) {
            const Row row = state_.row_of[slot];
            if (world_.particles.mobility[row] > Real(0))
                world_.particles.velocity[row][axis] =
                    rate * size * random::symmetric<Real>(slot - first, std::uint64_t(axis), 0);
        }
    }
};

} // namespace sinew::detail
