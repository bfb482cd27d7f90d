#pragma once

#include "sinew/math/format.h"
#include "sinew/scene/check.h"

#include <limits>
#include <optional>

/// Warnings of floats that are too coarse for their place.
namespace sinew {

/// Particles of a world of floats so far out that their rounding is more than a share of their radius.
template <int D> class FloatCheck {
  public:
    FloatCheck(const Scene& scene, const World<D, float>& world, Document& document)
        : scene_(scene), world_(world), document_(document) {}

    void run() const {
        const auto& p = world_.particles;
        std::optional<Row> worst;
        for (Row row = 0; row < p.size(); ++row)
            if (p.radius[row] > 0 && rounding(row) > share * p.radius[row] &&
                (!worst || rounding(row) * p.radius[*worst] > rounding(*worst) * p.radius[row]))
                worst = row;
        if (worst) warn(*worst);
    }

  private:
    static constexpr float share = 1e-3F;
    static constexpr float half_a_step = std::numeric_limits<float>::epsilon() / 2; ///< relative
    const Scene& scene_;
    const World<D, float>& world_;
    Document& document_;

    /// Largest coordinate of a particle, which is rounded most.
    float far(Row row) const {
        float most = 0;
        for (int i = 0; i < D; ++i) most = max(most, absolute(world_.particles.position[row][i]));
        return most;
    }
    float rounding(Row row) const { return far(row) * half_a_step; }

    void warn(Row row) const {
        const auto i = world_.particles.figure[row];
        const double radius = world_.particles.radius[row];
        const bool is_known = i < scene_.figures.size();
        document_.warn(
            is_known ? under("figures", i) : "",
            format_text(
                "{} is {:3} from the origin, where floats are rounded by {:3}: more than 1e-3 of its radius, {:3}",
                is_known ? in_quotes(world_.figures[i].name) : "a particle", far(row), rounding(row), radius),
            format_text("give \"solver\" the precision \"double\", or stay within {:3} of the origin",
                        double(share) * radius / double(half_a_step)));
    }
};

} // namespace sinew
