#pragma once

#include "sinew/scene/scene.h"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

namespace sinew::play {

/// Interpolates particle positions between the last two steps, for motion that looks even at any display rate.
class Interpolator {
  public:
    /// Stores the positions; called before each step.
    void remember(const AnyWorld& world) {
        std::visit(
            [&]<class WorldT>(const WorldT& any) {
                if (!std::holds_alternative<Positions<WorldT>>(before_)) before_ = Positions<WorldT>{};
                auto& positions = std::get<Positions<WorldT>>(before_);
                positions.assign(any.particles.position.begin(), any.particles.position.end());
            },
            world);
    }

    /// Drops the stored positions; called when the state jumps and must not be interpolated.
    void forget() { before_ = std::monostate{}; }

    /// Calls draw() with positions interpolated linearly from the stored ones (share 0) to the current ones (share 1).
    /// Particles added since are drawn at their current positions.
    template <class Draw> void show(AnyWorld& world, double share, Draw&& draw) {
        std::visit(
            [&]<class WorldT>(WorldT& any) {
                using Real = typename WorldT::Real;
                auto* before = std::get_if<Positions<WorldT>>(&before_);
                if (!before || share >= 1) return draw();
                auto shown = any.particles.position;
                for (std::size_t i = 0; i < std::min(before->size(), shown.size()); ++i)
                    shown[i] = (*before)[i] + (shown[i] - (*before)[i]) * Real(share);
                std::swap(shown, any.particles.position);
                draw();
                std::swap(shown, any.particles.position);
            },
            world);
    }

  private:
    template <class WorldT> using Positions = std::vector<typename WorldT::Vector>;

    std::variant<std::monostate, std::vector<Vec<2, float>>, std::vector<Vec<2, double>>, std::vector<Vec<3, float>>,
                 std::vector<Vec<3, double>>>
        before_;
};

} // namespace sinew::play
