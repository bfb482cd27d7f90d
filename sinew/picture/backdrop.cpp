#include "sinew/picture/backdrop.h"

#include "sinew/math/trig.h"
#include "sinew/picture/outline.h"

namespace sinew {
namespace {

/// The complement of a rectangle as four bars, which overlap at the corners: abutting edges would leave a seam.
void around(std::span<const Vec2<float>> rectangle, const Color& color, Picture& picture) {
    const auto w = float(picture.width), h = float(picture.height);
    float left = w, right = 0, top = h, bottom = 0;
    for (const auto& corner : rectangle) {
        left = min(left, corner[0]), right = max(right, corner[0]);
        top = min(top, corner[1]), bottom = max(bottom, corner[1]);
    }
    const auto bar = [&](float x0, float y0, float x1, float y1) {
        const std::array<Vec2<float>, 4> corners = {{{{x0, y0}}, {{x1, y0}}, {{x1, y1}}, {{x0, y1}}}};
        if (x0 < x1 && y0 < y1) picture.add(Shape::polygon, corners, 0, color);
    };
    bar(0, 0, w, top);
    bar(0, bottom, w, h);
    bar(0, 0, left, h);
    bar(right, 0, w, h);
}

/// A pool of light on a plane: discs one upon another, ever smaller, the last one at the middle.
class Pool {
  public:
    static constexpr int rings = 64; ///< fewer show as bands: red, green and blue change at different rings

    Pool(const CameraSection& camera, const View& view, const Vec3<double>& normal, const Vec3<double>& through)
        : view_(view) {
        const auto onto = [&](const Vec3<double>& position) {
            return position - normal * dot(position - through, normal);
        };
        const auto below_eye = onto(camera.eye);
        middle_ = onto(camera.target);
        radius_ = max(0.93 * distance(below_eye, middle_), 1.2 * distance(below_eye, camera.eye));
        const auto across = direction(cross(normal, view.towards_eye())), along = cross(across, normal);
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * pi<double> * i / corners;
            circle_[std::size_t(i)] = across * cosine(angle) + along * sine(angle);
        }
    }

    /// Pixels of a disc's rim, those before the eye.
    void trace(int ring, Pixels& rim) const {
        const double radius = radius_ * (1 - double(ring) / rings);
        rim.clear();
        for (const auto& way : circle_)
            if (const auto seen = view_.see(middle_ + way * radius)) rim.push_back(seen->pixel);
    }

    /// First disc of which anything is seen: a disc that fills the picture hides those below.
    int first_visible(const Picture& picture) const {
        Pixels rim;
        for (int ring = 1; ring < rings; ++ring) {
            trace(ring, rim);
            if (!fills(rim, picture)) return ring - 1;
        }
        return rings - 1;
    }

  private:
    static constexpr int corners = 64;

    const View& view_;
    Vec3<double> middle_{};
    double radius_ = 0; ///< of the first disc
    std::array<Vec3<double>, corners> circle_{};

    /// True if every corner of the picture is inside a rim that lies before the eye as a whole, which is convex then.
    static bool fills(const Pixels& rim, const Picture& picture) {
        if (rim.size() < corners) return false;
        const auto w = float(picture.width), h = float(picture.height);
        bool left = false, right = false;
        for (std::size_t i = 0; i < rim.size(); ++i)
            for (const auto& corner :
                 {Vec2<float>{{0, 0}}, Vec2<float>{{w, 0}}, Vec2<float>{{w, h}}, Vec2<float>{{0, h}}}) {
                const auto& from = rim[i];
                const float side = cross(rim[i + 1 < rim.size() ? i + 1 : 0] - from, corner - from);
                left |= side >= 0;
                right |= side <= 0;
            }
        return left != right;
    }
};

} // namespace

void draw_floors(const Scene& scene, const View& view, const Theme& theme, Picture& picture) {
    Pixels rim;
    if (!scene.world.bounds) return;
    for (const auto& plane : scene.world.bounds->planes) {
        const auto normal = direction(plane.normal.template as<3, double>());
        const auto through = plane.through.template as<3, double>();
        if (dot(scene.view.camera.eye - through, normal) <= 0) continue;
        const Pool pool(scene.view.camera, view, normal, through);
        const int first = pool.first_visible(picture);
        if (first > 0) picture.clear(); // of the floors before
        for (int ring = first; ring < Pool::rings; ++ring) {
            const double t = double(ring + 1) / Pool::rings;
            const auto blend = float(t * t * (3 - 2 * t));
            pool.trace(ring, rim);
            picture.add(Shape::polygon, rim, 0, mix(theme.background, theme.ground, blend));
        }
    }
}

void draw_walls(const Scene& scene, const View& view, const Theme& theme, float thickness, Picture& picture) {
    Pixels outline;
    if (!scene.world.bounds) return;
    if (const auto& box = scene.world.bounds->box) {
        outline.clear();
        const auto& [a, b] = *box;
        for (const auto& corner : {Vec3<double>{{a[0], a[1], 0}}, Vec3<double>{{b[0], a[1], 0}},
                                   Vec3<double>{{b[0], b[1], 0}}, Vec3<double>{{a[0], b[1], 0}}})
            if (const auto seen = view.see(corner)) outline.push_back(seen->pixel);
        around(outline, theme.ground, picture);
        picture.add(Shape::loop, outline, thickness, theme.wall);
    }
    for (const auto& plane : scene.world.bounds->planes) {
        const auto normal = direction(plane.normal.template as<2, double>());
        const auto along = perpendicular(normal), through = plane.through.template as<2, double>();
        const double far = 10 * (absolute(through[0]) + absolute(through[1]) + double(picture.width + picture.height));
        const auto corner = [&](double way, double below) {
            const auto position = through + along * way - normal * below;
            return view.see({{position[0], position[1], 0}})->pixel;
        };
        outline = {corner(-far, 0), corner(far, 0), corner(far, far), corner(-far, far)};
        picture.add(Shape::polygon, outline, 0, theme.ground);
        outline.resize(2);
        picture.add(Shape::polyline, outline, thickness, theme.wall);
    }
}

} // namespace sinew
