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
        left = minimum(left, corner[0]), right = maximum(right, corner[0]);
        top = minimum(top, corner[1]), bottom = maximum(bottom, corner[1]);
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
} // namespace

void draw_floors(const Scene& scene, const View& view, const Theme& theme, Picture& picture) {
    Pixels outline;
    if (!scene.world.bounds) return;
    for (const auto& plane : scene.world.bounds->planes) {
        const auto normal = direction(plane.normal.template as<3, double>());
        const auto through = plane.through.template as<3, double>();
        const auto onto = [&](const Vec3<double>& place) { return place - normal * dot(place - through, normal); };
        const auto& camera = scene.view.camera;
        if (dot(camera.eye - through, normal) <= 0) continue;
        const auto middle = onto(camera.target);
        const auto below_eye = onto(camera.eye);
        const double reach = maximum(0.93 * distance(below_eye, middle), 1.2 * distance(below_eye, camera.eye));
        const auto across = direction(cross(normal, view.towards_eye())), along = cross(across, normal);
        constexpr int rings = 64, corners = 64; // fewer show as bands: red, green and blue change at different rings
        for (int ring = 0; ring < rings; ++ring) {
            const double t = double(ring + 1) / rings, radius = reach * (1 - double(ring) / rings);
            outline.clear();
            for (int i = 0; i < corners; ++i) {
                const double angle = 2 * pi<double> * i / corners;
                const auto place = middle + (across * cosine(angle) + along * sine(angle)) * radius;
                if (const auto seen = view.see(place)) outline.push_back(seen->pixel);
            }
            const auto blend = float(t * t * (3 - 2 * t));
            picture.add(Shape::polygon, outline, 0, mix(theme.background, theme.ground, blend));
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
            const auto place = through + along * way - normal * below;
            return view.see({{place[0], place[1], 0}})->pixel;
        };
        outline = {corner(-far, 0), corner(far, 0), corner(far, far), corner(-far, far)};
        picture.add(Shape::polygon, outline, 0, theme.ground);
        outline.resize(2);
        picture.add(Shape::polyline, outline, thickness, theme.wall);
    }
}

} // namespace sinew
