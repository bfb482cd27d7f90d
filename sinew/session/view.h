#pragma once

#include "sinew/scene/scene.h"

#include <optional>

namespace sinew {

/// Projection from positions of a scene to pixels of a picture.
class View {
  public:
    /// `focus`: two corners around everything shown, fitted to a 2D picture where the scene gives no centre or height.
    View(const Scene& scene, const std::array<Point, 2>& focus, int width, int height)
        : View(scene, scene.view, focus, width, height) {}
    /// Replaces the scene's own view section.
    View(const Scene& scene, const ViewSection& view, const std::array<Point, 2>& focus, int width, int height);

    struct Seen {
        Vec2<float> pixel{};
        float scale = 0; ///< pixels per unit of length at this depth
        float depth = 0; ///< distance from the eye along the view axis; 0 in 2D
    };

    /// Pixel, scale and depth of a position; empty behind the eye.
    std::optional<Seen> see(const Vec3<double>& position) const;

    /// Position of a pixel in the plane of a 2D scene.
    Vec2<double> position_of(Vec2<double> pixel) const;
    /// Position of a pixel in the plane at `depth` parallel to the picture; 2D ignores the depth.
    Point position_of(Vec2<double> pixel, double depth) const;

    /// 2D: position at the middle of the picture, and pixels per unit of length.
    const Vec2<double>& center() const { return center_; }
    double scale() const { return scale_; }

    /// Unit vector from the camera's target to the eye; towards the viewer in 2D.
    const Vec3<double>& towards_eye() const { return back_; }
    /// Unit vectors to the right and to the top of the picture.
    const Vec3<double>& right() const { return right_; }
    const Vec3<double>& above() const { return above_; }

  private:
    double scale_at(double depth) const;

    bool flat_, orthographic_;
    double scale_ = 1;        ///< 2D: pixels per unit; 3D: pixels per unit at unit depth
    double target_depth_ = 1; ///< 3D: depth of the target
    double up_ = 1;
    Vec2<double> middle_pixel_;
    Vec2<double> center_{}; // 2D
    Vec3<double> eye_{};    // 3D
    Vec3<double> right_{{1, 0, 0}}, above_{{0, 1, 0}};
    Vec3<double> back_{{0, 0, 1}};
};

} // namespace sinew
