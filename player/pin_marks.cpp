#include "player/pin_marks.h"

#include "sinew/world/edit.h"

namespace sinew::play {

void draw_pin_marks(const AnyWorld& world, const View& view, const Theme& theme, Picture& picture) {
    constexpr float size = 7; // nominal pixels at the nominal height of a picture
    const auto unit = float(picture.height / Picture::nominal_height);
    std::visit(
        [&]<class WorldT>(const WorldT& any) {
            for (const auto& pin : any.pins) {
                const auto position = position_of(any, pin.particle);
                if (!position) continue;
                Vec3<double> wide{};
                for (int i = 0; i < WorldT::dimension; ++i) wide[i] = double((*position)[i]);
                const auto seen = view.see(wide);
                if (!seen) continue;
                picture.add(Shape::disc, std::span(&seen->pixel, 1), size * unit, theme.background);
                picture.add(Shape::disc, std::span(&seen->pixel, 1), 0.65F * size * unit, theme.pen);
            }
        },
        world);
}

} // namespace sinew::play
