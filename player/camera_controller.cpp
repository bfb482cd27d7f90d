#include "player/camera_controller.h"

#include "sinew/math/trig.h"

#include <algorithm>
#include <cmath>

namespace sinew::play {
namespace {

/// Range of the shown height, as multiples of the height in the scene's own view.
constexpr double nearest = 1e-3, farthest = 1e3;

/// Shown height in scene units, for a picture with the aspect ratio of the view's own size.
double shown_height(const View& view, const ViewSection& section, int width, int height) {
    const double ratio = double(section.size[0]) / section.size[1];
    return std::min(double(height) / view.scale(), double(width) / (view.scale() * ratio));
}

/// Rotation about a unit axis, angle in radians (Rodrigues 1840).
Vec3<double> turned(const Vec3<double>& v, const Vec3<double>& axis, double angle) {
    const double c = cosine(angle), s = sine(angle);
    return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
}

/// Bounding box of all particles in the xy plane.
std::array<Vec2<double>, 2> extent_of(const AnyWorld& world) {
    std::array<Vec2<double>, 2> corners{};
    std::visit(
        [&](const auto& any) {
            bool first = true;
            for (const auto& position : any.particles.position)
                for (int i = 0; i < 2; ++i) {
                    corners[0][i] = first ? double(position[i]) : std::min(corners[0][i], double(position[i]));
                    corners[1][i] = first ? double(position[i]) : std::max(corners[1][i], double(position[i]));
                    if (i == 1) first = false;
                }
        },
        world);
    return corners;
}

} // namespace

Look CameraController::look(const Session& session) const {
    return {moved_ ? *moved_ : session.scene().view, session.focus(), width_, height_};
}

ViewSection& CameraController::hold(const Session& session) {
    if (moved_) return *moved_;
    const auto seen = view(session);
    moved_ = session.scene().view;
    if (session.scene().dimension == 2) {
        moved_->center = Point{{seen.center()[0], seen.center()[1], 0}};
        moved_->height = shown_height(seen, *moved_, width_, height_);
    }
    return *moved_;
}

void CameraController::pan(const Session& session, Vec2<double> by) {
    auto& section = hold(session);
    const auto seen = view(session);
    if (session.scene().dimension == 2) {
        const Vec2<double> middle{{width_ * 0.5, height_ * 0.5}};
        const auto offset = seen.position_of(middle) - seen.position_of(middle + by);
        for (int i = 0; i < 2; ++i) (*section.center)[i] += offset[i];
        return;
    }
    auto& camera = section.camera;
    const double depth = norm(camera.eye - camera.target);
    const auto offset = (seen.above() * by[1] - seen.right() * by[0]) * (depth / seen.scale());
    camera.eye += offset;
    camera.target += offset;
}

void CameraController::zoom(const Session& session, Vec2<double> about, double factor) {
    if (!(factor > 0) || !std::isfinite(factor)) return;
    auto& section = hold(session);
    if (session.scene().dimension == 3) {
        const auto away = (section.camera.eye - section.camera.target) * (1 / factor);
        if (const double length = norm(away); length > 1e-3 && length < 1e6)
            section.camera.eye = section.camera.target + away;
        return;
    }
    const double usual = shown_height(session.view(width_, height_), section, width_, height_);
    const auto before = view(session).position_of(about);
    section.height = std::clamp(*section.height / factor, usual * nearest, usual * farthest);
    const auto offset = before - view(session).position_of(about);
    for (int i = 0; i < 2; ++i) (*section.center)[i] += offset[i];
}

void CameraController::orbit(const Session& session, Vec2<double> by) {
    if (session.scene().dimension == 2) return pan(session, by);
    constexpr double a_pixel = 0.006; // radians per pixel
    constexpr double steepest = 0.985;
    auto& camera = hold(session).camera;
    const auto seen = view(session);
    const double up = session.scene().units.up == "-y" ? -1 : 1;
    auto away = turned(camera.eye - camera.target, Vec3<double>::axis(1), -by[0] * a_pixel * up);
    const auto right = turned(seen.right(), Vec3<double>::axis(1), -by[0] * a_pixel * up);
    const auto tilted = turned(away, right, -by[1] * a_pixel);
    if (std::fabs(direction(tilted)[1]) < steepest) away = tilted;
    camera.eye = camera.target + away;
}

void CameraController::switch_projection(const Session& session) {
    if (session.scene().dimension == 2) return;
    auto& projection = hold(session).camera.projection;
    projection = projection == "perspective" ? "orthographic" : "perspective";
}

void CameraController::home(const Session& session) {
    moved_.reset();
    if (session.scene().dimension == 3) return;
    const auto seen = view(session);
    const auto corners = extent_of(session.world());
    const auto inside = [&](const Vec2<double>& corner) {
        const auto at = seen.see({{corner[0], corner[1], 0}});
        return at && at->pixel[0] >= 0 && at->pixel[1] >= 0 && at->pixel[0] <= float(width_) &&
               at->pixel[1] <= float(height_);
    };
    if (inside(corners[0]) && inside(corners[1])) return;
    auto& section = hold(session);
    constexpr double margin = 1.2;
    const auto size = (corners[1] - corners[0]) * margin;
    const double ratio = double(section.size[0]) / section.size[1];
    section.height = std::max({size[1], size[0] / ratio, *section.height * nearest});
    for (int i = 0; i < 2; ++i) (*section.center)[i] = (corners[0][i] + corners[1][i]) / 2;
}

} // namespace sinew::play
