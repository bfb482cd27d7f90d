#pragma once

#include "sinew/solver/block.h"
#include "sinew/world/world.h"

/// Tensions of a block's links and angles, between steps: the multipliers of the world's constraints.
namespace sinew::detail {

template <int D, class Real> class BlockTensions {
  public:
    BlockTensions(World<D, Real>& world, Blocks<D>& blocks, const Block& block)
        : world_(world), distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          links_(std::span(blocks.links).subspan(block.first_link, block.links)),
          bends_(std::span(blocks.bends).subspan(block.first_bend, block.bends)) {}

    /// Sets `before` of every row. `per`: 1 / squared length of the substep that multipliers were reported for.
    void load(double per) {
        for (auto& link : links_) link.before = -double(distances_.multiplier[link.constraint]) * per / link.length;
        for (auto& bend : bends_) bend.before = bend.replaces_link ? 0 : -double(multiplier_of(bend)) * per * bend.unit;
    }

    /// Stores `before` of every row as multipliers of a substep of the given length. Which stress a flat square has is
    /// not determined: the replaced link has none.
    void report(double substep) {
        for (const auto& link : links_)
            distances_.multiplier[link.constraint] = multiplier(link.before * link.length, substep);
        for (const auto& bend : bends_)
            multiplier_of(bend) = bend.replaces_link ? Real(0) : multiplier(bend.before / bend.unit, substep);
    }

    /// Multiplier of a tension.
    static Real multiplier(double tension, double substep) {
        constexpr double max = double(limit::multiplier<Real>);
        return Real(clamp(-tension * square(substep), -max, max));
    }

  private:
    World<D, Real>& world_;
    Constraints<Distance<D>, Real>& distances_;
    std::span<DistanceRow<D>> links_;
    std::span<AngleRow<D>> bends_;

    Real& multiplier_of(const AngleRow<D>& bend) {
        if (bend.replaces_link) return distances_.multiplier[bend.constraint];
        if constexpr (D == 3)
            if (bend.is_fold()) return std::get<kind_number<Volume, D>>(world_.constraints).multiplier[bend.constraint];
        return std::get<kind_number<Angle, D>>(world_.constraints).multiplier[bend.constraint];
    }
};

} // namespace sinew::detail
