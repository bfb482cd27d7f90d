#include "sinew/session/trails.h"

#include "sinew/session/wardrobe.h"
#include "sinew/solver/edit.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

constexpr std::size_t most_places = 4096;
constexpr float width = 2.5F;     // nominal pixels
constexpr std::size_t tones = 24; // from the background to the dot's colour

/// Steps in a time of the scene, or as many as are kept.
std::size_t steps_in(double time, const Scene& scene) {
    return std::size_t(std::clamp(std::ceil(time / step_length(scene)), 2.0, double(most_places)));
}

} // namespace

Trails::Trails(const Scene& scene, const AnyWorld& world) {
    const auto& theme = theme_called(scene.view.theme);
    std::visit(
        [&](const auto& any) {
            for (std::size_t i = 0; i < any.figures.size(); ++i) {
                Wardrobe wardrobe(scene, theme, i, any.figures[i].name);
                for (const auto& piece : any.figures[i].pieces) {
                    if (piece.mark != Mark::dot) continue;
                    const double lasts = wardrobe.of(piece.part).trail.value_or(0);
                    if (!(lasts > 0)) continue;
                    for (const auto id : piece.particles)
                        trails_.push_back(
                            {id, i, any.figures[i].name, piece.part, std::vector<Point>(steps_in(lasts, scene))});
                }
            }
        },
        world);
    note(world);
}

void Trails::note(const AnyWorld& world) {
    std::visit(
        [&]<class WorldT>(const WorldT& any) {
            for (auto& trail : trails_) {
                const auto position = position_of(any, trail.particle);
                if (!position) continue;
                auto& place = trail.places[trail.noted++ % trail.places.size()];
                for (int i = 0; i < WorldT::dimension; ++i) place[i] = double((*position)[i]);
            }
        },
        world);
}

void Trails::draw(const Scene& scene, const View& view, float unit, Picture& picture) const {
    for (const auto& trail : trails_) draw(trail, scene, view, unit, picture);
}

void Trails::draw(const Trail& trail, const Scene& scene, const View& view, float unit, Picture& picture) {
    const auto& theme = theme_called(scene.view.theme);
    const auto color = Wardrobe(scene, theme, trail.figure, trail.figure_name).of(trail.part).color;
    const auto count = std::min(trail.noted, trail.places.size());
    if (count < 2) return;
    std::vector<Vec2<float>> pixels;
    for (std::size_t tone = 0; tone < tones; ++tone) {
        pixels.clear();
        const auto first = tone * (count - 1) / tones, last = (tone + 1) * (count - 1) / tones;
        for (auto i = first; i <= last; ++i) {
            const auto& place = trail.places[(trail.noted - count + i) % trail.places.size()];
            const auto seen = view.see(place.as<3, double>());
            if (seen) pixels.push_back(seen->pixel);
        }
        const float share = float(tone + 1) / float(tones);
        if (pixels.size() > 1)
            picture.add(Shape::polyline, pixels, width * unit, mix(theme.background, color, 0.85F * share));
    }
}

} // namespace sinew
