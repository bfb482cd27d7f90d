#include "sinew/math/format.h"
#include "sinew/scene/check.h"
#include "sinew/scene/types.h"

#include <algorithm>
#include <map>
#include <span>

namespace sinew {
namespace {

/// True if one of the names ends in a star and so stands for many particles.
bool has_star(std::span<const std::string> names) {
    return std::ranges::any_of(names, [](const std::string& name) { return name.ends_with('*'); });
}

Sizes sizes_of(const FigureSection& figure) {
    Sizes sizes;
    detail::visit_held(figure.made, [&](const auto& made) {
        if constexpr (requires { made.sizes(); })
            sizes = made.sizes();
        else
            for (sizes.particles = made.particles.size(); const auto& constraint : made.constraints)
                sizes.constraints += has_star(constraint.between) ? sizes.particles : 1;
    });
    return sizes;
}

/// Compares the sizes that a scene would have with the limits.
class SizeCheck {
  public:
    SizeCheck(const Scene& scene, Document& document) : scene_(scene), document_(document) {}

    void run() {
        const auto& limits = document_.limits;
        count(std::int64_t(scene_.figures.size()), limits.figures, "figures", "/figures");
        count(std::int64_t(scene_.events.size()), limits.events, "events", "/events");
        Sizes sum;
        std::map<std::string_view, std::size_t> particles; // upper bound on the particles a star can stand for
        for (const auto& figure : scene_.figures)
            particles[name_of(figure)] = std::min(sizes_of(figure).particles, std::size_t(1e12));
        const auto max = [&](const std::string_view name) {
            const auto found = particles.find(name.substr(0, name.find('/')));
            return name.ends_with('*') && found != particles.end() ? found->second : 1;
        };
        for (const auto& constraint : scene_.constraints) {
            std::size_t many = 1;
            for (const auto& name : constraint.between) many = std::max(many, max(name));
            sum.constraints += many;
        }
        for (const auto& pin : scene_.pins)
            if (pin.particle.ends_with('*')) sum.constraints += max(pin.particle);
        for (std::size_t i = 0; i < scene_.figures.size(); ++i) {
            const auto sizes = sizes_of(scene_.figures[i]);
            sum.particles += sizes.particles;
            sum.constraints += sizes.constraints;
            if (count(std::int64_t(sum.particles), limits.particles, "particles", under("figures", i)) ||
                count(std::int64_t(sum.constraints), limits.constraints, "constraints", under("figures", i)))
                return;
        }
    }

  private:
    const Scene& scene_;
    Document& document_;

    /// Reports a count above its limit; true if the count is above.
    bool count(std::int64_t found, std::int64_t allowed, std::string_view what, std::string place) {
        if (found <= allowed) return false;
        document_.error(std::move(place),
                        format_text("the scene would have {} {}, at most {} are allowed", found, what, allowed),
                        format_text("if you trust the file, raise the limit: limits.{}={}", what, found));
        return true;
    }
};

} // namespace

void check_sizes(const Scene& scene, Document& document) {
    SizeCheck(scene, document).run();
}

} // namespace sinew
