#pragma once

#include "sinew/scene/scene.h"

#include <optional>

namespace sinew {

/// From the places of a scene to the pixels of a picture.
class View {
  public:
    /// `focus` is what a 2D scene that does not say is looked at: two corners around all it shows.
    View(const Scene& scene, const std::array<Point, 2>& focus, int width, int height)
        : View(scene, scene.view, focus, width, height) {}
    /// Looks at it in another way than the scene says.
    View(const Scene& scene, const ViewSection& view, const std::array<Point, 2>& focus, int width, int height);

    struct Seen {
        Vec2<float> pixel{};
        float scale = 0; ///< pixels a unit of length has there
        float depth = 0; ///< distance from the eye; 0 in 2D
    };

    /// Nothing for what is behind the eye.
    std::optional<Seen> see(const Vec3<double>& place) const;

    /// Where a pixel is in the plane of a 2D scene.
    Vec2<double> place_of(Vec2<double> pixel) const;
    /// Where a pixel is in the plane across the view at that depth; in 2D there is only one.
    Point place_of(Vec2<double> pixel, double depth) const;

    /// 2D: what is in the middle of the picture, and how many pixels a unit of length has.
    const Vec2<double>& center() const { return center_; }
    double scale() const { return scale_; }

    /// Unit vector from what is looked at to the eye; towards the reader in 2D.
    const Vec3<double>& towards_eye() const { return back_; }
    /// Unit vectors to the right and to the top of the picture.
    const Vec3<double>& right() const { return right_; }
    const Vec3<double>& above() const { return above_; }

  private:
    double scale_at(double depth) const;

    bool flat_, orthographic_;
    double scale_ = 1;        ///< 2D: pixels a unit; 3D: pixels a unit at unit depth
    double target_depth_ = 1; ///< 3D: from the eye to what it looks at
    double up_ = 1;
    Vec2<double> middle_pixel_;
    Vec2<double> center_{}; // 2D
    Vec3<double> eye_{};    // 3D
    Vec3<double> right_{{1, 0, 0}}, above_{{0, 1, 0}};
    Vec3<double> back_{{0, 0, 1}};
};

} // namespace sinew
