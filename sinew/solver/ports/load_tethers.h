#pragma once

#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <span>

/// Tethers of ports: a port of a tethered mesh is never further from the pins of the mesh than the threads reach.
/// Tethers in the sweep would hold the port alone; links of the block carry all loads that hang on the port.
namespace sinew::detail {

/// The component of a particle in the plan, or none.
template <class Real> const Component* sheet_at(const Plan<Real>& plan, Row slot) {
    const auto after = std::upper_bound(plan.components.begin(), plan.components.end(), slot,
                                        [](Row s, const Component& component) { return s < component.begin.slot; });
    return after == plan.components.begin() ? nullptr : &*(after - 1);
}

template <int D, class Real> class LoadTethers {
  public:
    LoadTethers(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), solver_(solver), swept_(solver.sweep_state), plan_(solver.sweep_state.plan) {}

    /// Sets the load tethers of one port. Tethers without a maximum hold nothing.
    void set_anchors(std::span<DistanceRow<D>> links) const {
        auto& nodes = solver_.blocks.nodes;
        const auto slot = swept_.slot_of[nodes[links.front().a].row];
        const auto* component = sheet_at(plan_, slot);
        for (std::uint32_t t = 0; t < links.size(); ++t) {
            auto& node = nodes[links[t].b];
            const double max_length = component && t < component->tethers ? max_length_of(*component, t, slot) : 0;
            if (max_length > 0) {
                node.row = swept_.row_of[plan_.tethers[component->first_tether + t].at + component->begin.slot];
                node.slot = world_.particles.handles.index_of(node.row);
            }
            set_max_length(links[t], max_length);
        }
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    const SweepState<D, Real>& swept_;
    const Plan<Real>& plan_;

    /// Maximum length in metres, 0 if unlimited.
    double max_length_of(const Component& component, std::uint32_t t, Row slot) const {
        constexpr double far = double(limit::coordinate<Real>);
        const auto& tether = plan_.tethers[component.first_tether + t];
        const double half = double(plan_.half_per_max_length_square[tether.first + slot - component.begin.slot]);
        const double max_length = square_root(inverse_or_zero(2 * half));
        return max_length < far ? max_length : 0;
    }
    static void set_max_length(DistanceRow<D>& link, double max_length) {
        constexpr double nowhere = 1e12;
        link.high = max_length > 0 ? max_length : nowhere;
        link.length = max_length;
        link.per_length2 = inverse_or_zero(square(max_length));
    }
};

} // namespace sinew::detail
