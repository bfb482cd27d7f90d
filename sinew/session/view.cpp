#include "sinew/session/view.h"

#include "sinew/math/trig.h"

#include <algorithm>

namespace sinew {

View::View(const Scene& scene, const ViewSection& view, const std::array<Point, 2>& focus, int width, int height)
    : flat_(scene.dimension == 2), orthographic_(!flat_ && view.camera.projection == "orthographic"),
      up_(scene.units.up == "-y" ? -1 : 1), middle_pixel_{{width * 0.5, height * 0.5}} {
    if (flat_) {
        above_ = Vec3<double>{{0, up_, 0}};
        const double nominal_width = view.size[0], nominal_height = view.size[1];
        const bool screen = scene.units.length == "px";
        constexpr double margin = 1.15;
        const double wide = std::max((focus[1][0] - focus[0][0]) * margin, 1e-6);
        const double high = std::max((focus[1][1] - focus[0][1]) * margin, 1e-6);
        const double fitting = std::max(high, wide * nominal_height / nominal_width);
        const double shown = view.height.value_or(screen ? nominal_height : fitting);
        scale_ = std::min(height / shown, width / (shown * nominal_width / nominal_height));
        for (int i = 0; i < 2; ++i)
            center_[i] = view.center ? (*view.center)[i]
                         : screen    ? view.size[std::size_t(i)] * 0.5
                                     : (focus[0][i] + focus[1][i]) * 0.5;
    } else {
        const auto& camera = view.camera;
        eye_ = camera.eye;
        target_depth_ = std::max(distance(camera.eye, camera.target), 1e-6);
        back_ = direction(camera.eye - camera.target);
        if (back_ == Vec3<double>{}) back_ = Vec3<double>::axis(2);
        const auto sky = Vec3<double>::axis(absolute(back_[1]) < 0.999 ? 1 : 2) * up_;
        right_ = direction(cross(sky, back_));
        above_ = cross(back_, right_);
        const double half = camera.field_of_view * 0.5;
        scale_ = height * 0.5 * cosine(half) / sine(half);
    }
}

std::optional<View::Seen> View::see(const Vec3<double>& position) const {
    if (flat_) {
        const double x = middle_pixel_[0] + (position[0] - center_[0]) * scale_;
        const double y = middle_pixel_[1] - up_ * (position[1] - center_[1]) * scale_;
        return Seen{{{float(x), float(y)}}, float(scale_), 0};
    }
    const auto from_eye = position - eye_;
    const double depth = -dot(from_eye, back_);
    constexpr double nearest = 1e-3;
    if (depth < nearest && !orthographic_) return std::nullopt;
    const double scale = scale_at(depth);
    const double x = middle_pixel_[0] + dot(from_eye, right_) * scale;
    const double y = middle_pixel_[1] - dot(from_eye, above_) * scale;
    return Seen{{{float(x), float(y)}}, float(scale), float(depth)};
}

double View::scale_at(double depth) const {
    return scale_ / (orthographic_ ? target_depth_ : depth);
}

Vec2<double> View::position_of(Vec2<double> pixel) const {
    const auto offset = (pixel - middle_pixel_) * (1 / scale_);
    return {{center_[0] + offset[0], center_[1] - up_ * offset[1]}};
}

Point View::position_of(Vec2<double> pixel, double depth) const {
    Point position;
    if (flat_) {
        const auto flat = position_of(pixel);
        position[0] = flat[0], position[1] = flat[1];
        return position;
    }
    const auto offset = (pixel - middle_pixel_) * (1 / scale_at(depth));
    const auto wide = eye_ - back_ * depth + right_ * offset[0] - above_ * offset[1];
    for (int i = 0; i < 3; ++i) position[i] = wide[i];
    return position;
}

} // namespace sinew
