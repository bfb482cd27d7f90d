#pragma once

#include "sinew/scene/scene.h"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

namespace sinew::play {

/// Shows a world between two steps, so that it moves evenly whatever the display's rate.
class Between {
  public:
    /// Called before a step.
    void remember(const AnyWorld& world) {
        std::visit(
            [&]<class WorldT>(const WorldT& any) {
                if (!std::holds_alternative<Places<WorldT>>(before_)) before_ = Places<WorldT>{};
                auto& places = std::get<Places<WorldT>>(before_);
                places.assign(any.particles.position.begin(), any.particles.position.end());
            },
            world);
    }

    /// Called when things leap: nothing is shown on the way.
    void forget() { before_ = std::monostate{}; }

    /// Calls draw() while all particles are where they were at `share` of the last step. Those that came since are
    /// where they are.
    template <class Draw> void show(AnyWorld& world, double share, Draw&& draw) {
        std::visit(
            [&]<class WorldT>(WorldT& any) {
                using Real = typename WorldT::Real;
                auto* before = std::get_if<Places<WorldT>>(&before_);
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
    template <class WorldT> using Places = std::vector<typename WorldT::Vector>;

    std::variant<std::monostate, std::vector<Vec<2, float>>, std::vector<Vec<2, double>>, std::vector<Vec<3, float>>,
                 std::vector<Vec<3, double>>>
        before_;
};

} // namespace sinew::play
