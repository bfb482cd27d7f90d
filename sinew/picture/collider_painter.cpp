#include "sinew/picture/collider_painter.h"

#include "sinew/math/sort.h"
#include "sinew/math/trig.h"
#include "sinew/picture/collider_colors.h"
#include "sinew/picture/outline.h"
#include "sinew/picture/solid_faces.h"
#include "sinew/picture/surface.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace sinew {
namespace {

using solid::circle_corners;
using solid::placed_in_space;
using solid::Position;
using solid::SolidFace;

/// Outlines of the shapes of the plane, in their own frame.
struct ShapeOutline {
    std::vector<Position> corners;
    bool is_solid = true; ///< else the outline is a line only
};

template <class Real> ShapeOutline outline_of(const collide::Sphere<2, Real>& sphere) {
    ShapeOutline outline;
    for (int i = 0; i < 2 * circle_corners; ++i) {
        const double angle = pi<double> * i / circle_corners;
        outline.corners.push_back({{double(sphere.radius) * cosine(angle), double(sphere.radius) * sine(angle), 0}});
    }
    return outline;
}
template <class Real> ShapeOutline outline_of(const collide::Capsule<2, Real>& capsule) {
    ShapeOutline outline;
    const auto along = direction(placed_in_space(capsule.b) - placed_in_space(capsule.a));
    const Position axis = along == Position{} ? Position::axis(0) : along, side{{-axis[1], axis[0], 0}};
    for (int end = 0; end < 2; ++end)
        for (int i = 0; i <= circle_corners; ++i) {
            const double angle = pi<double> * (double(i) / circle_corners - 0.5) + (end ? pi<double> : 0);
            const auto center = placed_in_space(end ? capsule.a : capsule.b);
            outline.corners.push_back(center + (axis * cosine(angle) + side * sine(angle)) * double(capsule.radius));
        }
    return outline;
}
template <class Real> ShapeOutline outline_of(const collide::Box<2, Real>& box) {
    const double x = double(box.half()[0]), y = double(box.half()[1]);
    return {{{{-x, -y, 0}}, {{x, -y, 0}}, {{x, y, 0}}, {{-x, y, 0}}}};
}
template <class Real> ShapeOutline outline_of(const collide::Polygon<2, Real>& polygon) {
    ShapeOutline outline;
    for (const auto& corner : polygon.corners) outline.corners.push_back(placed_in_space(corner));
    return outline;
}
template <class Real> ShapeOutline outline_of(const collide::HalfSpace<2, Real>& plane) {
    constexpr double far = 1e4;
    const auto normal = placed_in_space(plane.normal);
    const Position along{{normal[1], -normal[0], 0}}, foot = normal * double(plane.offset);
    return {
        {foot - along * far, foot + along * far, foot + along * far - normal * far, foot - along * far - normal * far}};
}
/// Terrain is filled on its solid side; a closed chain is a line.
template <class Real> ShapeOutline outline_of(const collide::Chain<2, Real>& chain) {
    ShapeOutline outline;
    for (const auto& point : chain.points) outline.corners.push_back(placed_in_space(point));
    outline.is_solid = !chain.is_closed;
    if (chain.is_closed || outline.corners.size() < 2) return outline;
    constexpr double depth = 100;
    const auto along = outline.corners.back() - outline.corners.front();
    const auto below = Position{{along[1], -along[0], 0}} * depth;
    const auto first = outline.corners.front(), last = outline.corners.back();
    outline.corners.push_back(last + below);
    outline.corners.push_back(first + below);
    return outline;
}

template <class WorldT> class ColliderPainter {
  public:
    static constexpr int D = WorldT::dimension;
    using Pose = collide::Pose<D, typename WorldT::Real>;

    ColliderPainter(const Scene& scene, const View& view, const Theme& theme, float thickness, Picture& picture)
        : scene_(scene), view_(view), theme_(theme), thickness_(thickness), picture_(picture) {}

    void draw(const WorldT& world) {
        if constexpr (D == 2)
            draw_outlines(world.colliders);
        else
            draw_solids(world.colliders);
    }

  private:
    const Scene& scene_;
    const View& view_;
    const Theme& theme_;
    float thickness_;
    Picture& picture_;
    Pixels pixels_;

    static Position position(const Pose& pose, const Position& local) {
        Vec<D, typename WorldT::Real> narrow{};
        for (int i = 0; i < D; ++i) narrow[i] = typename WorldT::Real(local[i]);
        return placed_in_space(pose.to_world(narrow));
    }

    template <class Colliders> void draw_solids(const Colliders& colliders) {
        const Light light(view_, theme_.ink);
        std::vector<SeenFace> faces;
        for (const auto& collider : colliders) {
            if (collider.is_sensor || !collider.is_enabled()) continue;
            const auto colors = colors_of(collider.name, scene_, theme_);
            if (!colors.hidden)
                std::visit([&](const auto& shape) { collect(faces, shape, collider.target, colors.fill, light); },
                           collider.shape);
        }
        draw_faces(faces);
    }

    template <class Colliders> void draw_outlines(const Colliders& colliders) {
        for (std::size_t begin = 0, end = 0; begin < colliders.size(); begin = end) {
            while (end < colliders.size() && (end == begin || are_parts(colliders[begin], colliders[end]))) ++end;
            if (!colliders[begin].is_sensor && colliders[begin].is_enabled())
                draw_section(std::span(colliders).subspan(begin, end - begin));
        }
    }

    /// Parts of one section of a scene; colliders of code have none.
    template <class ColliderT> static bool are_parts(const ColliderT& one, const ColliderT& other) {
        return one.tag != ColliderT{}.tag && one.tag == other.tag;
    }

    /// Parts of a shape: all lines, of which their fills then hide the inner half, and so the seams.
    template <class Parts> void draw_section(const Parts& parts) {
        const auto [fill, line, hidden] = colors_of(parts.front().name, scene_, theme_);
        if (hidden) return;
        const bool is_one = parts.size() == 1 || !outline(parts.front()).is_solid;
        for (const auto& part : parts) {
            const auto shape = outline(part);
            see(shape, part.target);
            if (is_one && shape.is_solid) picture_.add(sinew::Shape::polygon, pixels_, 0, fill);
            picture_.add(sinew::Shape::loop, pixels_, is_one ? thickness_ : 2 * thickness_, line);
        }
        if (is_one) return;
        for (const auto& part : parts) {
            see(outline(part), part.target);
            picture_.add(sinew::Shape::polygon, pixels_, 0, fill);
            picture_.add(sinew::Shape::loop, pixels_, 1, fill); // closes the seam
        }
    }

    template <class ColliderT> static ShapeOutline outline(const ColliderT& collider) {
        return std::visit([](const auto& shape) { return outline_of(shape); }, collider.shape);
    }
    void see(const ShapeOutline& outline, const Pose& pose) {
        pixels_.clear();
        for (const auto& corner : outline.corners)
            if (const auto seen = view_.see(position(pose, corner))) pixels_.push_back(seen->pixel);
    }

    /// A face that is turned to the camera.
    struct SeenFace {
        std::array<Vec2<float>, 4> pixels{};
        int count = 0;
        Color shade{};
        double depth = 0;
    };

    template <class ShapeT>
    void collect(std::vector<SeenFace>& faces, const ShapeT& shape, const Pose& pose, const Color& color,
                 const Light& light) {
        solid::each_face(shape, [&](SolidFace face) {
            for (int i = 0; i < face.count; ++i)
                face.places[std::size_t(i)] = position(pose, face.places[std::size_t(i)]);
            if (!see(face)) return;
            auto& seen = faces.emplace_back();
            std::copy(pixels_.begin(), pixels_.end(), seen.pixels.begin());
            seen.count = face.count;
            seen.depth = depth_of(face);
            seen.shade = shade_of(position({{}, pose.rotation}, face.normal), color, light);
        });
    }

    /// Pixels of a face; false for one that is turned away, or not wholly before the camera.
    bool see(const SolidFace& face) {
        pixels_.clear();
        for (const auto& corner : face.corners())
            if (const auto seen = view_.see(corner)) pixels_.push_back(seen->pixel);
        return pixels_.size() == face.corners().size() && faces_viewer();
    }

    double depth_of(const SolidFace& face) const {
        Position sum{};
        for (const auto& corner : face.corners()) sum += corner * (1.0 / double(face.count));
        const auto seen = view_.see(sum);
        return seen ? double(seen->depth) : 0;
    }

    Color shade_of(const Position& normal, const Color& color, const Light& light) const {
        const double lit = 0.5 + 0.5 * dot(normal, light.towards_light);
        const Color dark = mix(color, theme_.ink, 0.45F), pale = mix(color, {1, 1, 1, 1}, 0.5F);
        return mix(dark, pale, float(lit));
    }

    /// Farthest first. Seams between faces are closed by a thin line of the same colour.
    void draw_faces(const std::vector<SeenFace>& faces) {
        std::vector<std::pair<double, std::size_t>> order;
        order.reserve(faces.size());
        for (std::size_t i = 0; i < faces.size(); ++i) order.emplace_back(faces[i].depth, i);
        sinew::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
        for (const auto& [depth, i] : order) {
            const auto& face = faces[i];
            pixels_.assign(face.pixels.begin(), face.pixels.begin() + face.count);
            picture_.add(sinew::Shape::polygon, pixels_, 0, face.shade);
            picture_.add(sinew::Shape::loop, pixels_, 1, face.shade);
        }
    }

    /// Corners seen from outside run counter-clockwise: clockwise where y points down.
    bool faces_viewer() const {
        float area = 0;
        for (std::size_t i = 1; i + 1 < pixels_.size(); ++i)
            area += cross(pixels_[i] - pixels_[0], pixels_[i + 1] - pixels_[0]);
        return area < 0;
    }
};

} // namespace

template <int D, class Real>
void draw_colliders(const Scene& scene, const World<D, Real>& world, const View& view, const Theme& theme,
                    float thickness, Picture& picture) {
    if (!world.colliders.empty()) ColliderPainter<World<D, Real>>(scene, view, theme, thickness, picture).draw(world);
}

#define SINEW_DRAW_COLLIDERS(D, Real)                                                                                  \
    template void draw_colliders(const Scene&, const World<D, Real>&, const View&, const Theme&, float, Picture&);
SINEW_INSTANTIATE(SINEW_DRAW_COLLIDERS)

} // namespace sinew
