#pragma once

#include "sinew/solver/batch/component_finder.h"

#include <algorithm>

namespace sinew::detail {

/// Links of a mesh by the slots of their ends, and the set of colours in use at each particle.
template <int D, class Real> class MeshLinks {
  public:
    using Link = PlanRoom::Link;
    static constexpr std::uint32_t max_colors = 63;

    MeshLinks(Solver<D, Real>& solver, const ComponentFinder<D, Real>& parts)
        : swept_(solver.sweep_state), used_(solver.sweep_state.room.used), parts_(parts) {}

    /// Begins a component whose particles have the slots from `first` on, without colours.
    void begin(Row first, std::size_t particles) {
        begin_ = first;
        used_.assign(particles, 0);
    }

    Link at(Row row) const {
        const auto [a, b] = std::minmax({swept_.slot_of[parts_.end(row, 0)], swept_.slot_of[parts_.end(row, 1)]});
        return {.offset = b - a, .lower = a, .row = row};
    }
    static std::uint32_t upper(const Link& link) { return link.lower + link.offset; }

    /// Colours in use at either end, as bits.
    std::uint64_t used(const Link& link) const { return used_[link.lower - begin_] | used_[upper(link) - begin_]; }
    void use(std::span<const Link> links, std::uint64_t colors) {
        for (const auto& link : links) {
            used_[link.lower - begin_] |= colors;
            used_[upper(link) - begin_] |= colors;
        }
    }
    /// Removes all colours at the ends.
    void clear(std::span<const Link> links) {
        for (const auto& link : links) used_[link.lower - begin_] = used_[upper(link) - begin_] = 0;
    }

  private:
    const SweepState<D, Real>& swept_;
    std::vector<std::uint64_t>& used_; ///< by particle of the component, as bits
    const ComponentFinder<D, Real>& parts_;
    Row begin_ = 0; ///< first slot of the component
};

} // namespace sinew::detail
