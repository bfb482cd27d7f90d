#include "sinew/picture/collider_painter.h"

#include "sinew/math/sort.h"
#include "sinew/math/trig.h"
#include "sinew/picture/collider_colors.h"
#include "sinew/picture/outline.h"
#include "sinew/picture/surface.h"

#include <algorithm>
#include <span>

namespace sinew {
namespace {

using Position = Vec3<double>;

/// A face of a solid: corners counter-clockwise seen from outside.
struct SolidFace {
    std::vector<Position> corners;
    Position normal{};
    Color color{};
};

template <int D, class Real> Position placed_in_space(const Vec<D, Real>& vector) {
    Position wide{};
    for (int i = 0; i < D; ++i) wide[i] = double(vector[i]);
    return wide;
}

constexpr int circle_corners = 32; ///< corners of a circle

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

// --- faces of solids in space ---------------------------------------------------------------------------------------

using Faces = std::vector<SolidFace>;

void add_face(Faces& faces, std::vector<Position> corners) {
    const auto normal = direction(cross(corners[1] - corners[0], corners[2] - corners[0]));
    faces.push_back({std::move(corners), normal, {}});
}

/// Capsule of a given axis; a sphere for an axis of no length.
void add_capsule(Faces& faces, const Position& a, const Position& b, double radius) {
    const auto along = direction(b - a);
    const Position axis = along == Position{} ? Position::axis(1) : along;
    const auto side = direction(cross(axis, absolute(axis[0]) < 0.8 ? Position::axis(0) : Position::axis(2)));
    const auto other = cross(axis, side);
    const auto at = [&](int ring, int i) { // rings from the end at a to the end at b
        const int rings = circle_corners / 2;
        const double polar = pi<double> * (ring <= rings / 2 ? ring : ring - 1) / rings,
                     turn = 2 * pi<double> * i / circle_corners;
        const auto out = side * cosine(turn) + other * sine(turn);
        return (ring <= rings / 2 ? a : b) + (out * sine(polar) - axis * cosine(polar)) * radius;
    };
    for (int ring = 0; ring < circle_corners / 2 + 1; ++ring)
        for (int i = 0; i < circle_corners; ++i) {
            const auto p = at(ring, i), q = at(ring, i + 1), r = at(ring + 1, i + 1), s = at(ring + 1, i);
            const auto normal = cross(r - p, s - q);
            if (normal != Position{}) faces.push_back({{p, q, r, s}, direction(normal), {}});
        }
}
template <class Real> void add_faces(Faces& faces, const collide::Sphere<3, Real>& sphere) {
    add_capsule(faces, {}, {}, double(sphere.radius));
}
template <class Real> void add_faces(Faces& faces, const collide::Capsule<3, Real>& capsule) {
    add_capsule(faces, placed_in_space(capsule.a), placed_in_space(capsule.b), double(capsule.radius));
}
template <class Real> void add_faces(Faces& faces, const collide::Box<3, Real>& box) {
    const auto half = placed_in_space(box.half());
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const auto u = Position::axis((axis + 1) % 3) * half[(axis + 1) % 3],
                       v = Position::axis((axis + 2) % 3) * (half[(axis + 2) % 3] * side),
                       middle = Position::axis(axis) * (half[axis] * side);
            add_face(faces, {middle - u - v, middle + u - v, middle + u + v, middle - u + v});
        }
}
template <class Real> void add_faces(Faces& faces, const collide::HalfSpace<3, Real>& plane) {
    constexpr double half_width = 20;
    const auto normal = placed_in_space(plane.normal);
    const auto u = direction(cross(normal, absolute(normal[0]) < 0.8 ? Position::axis(0) : Position::axis(2))) *
                   half_width,
               v = cross(normal, u), middle = normal * double(plane.offset);
    add_face(faces, {middle - u - v, middle + u - v, middle + u + v, middle - u + v});
}
template <class Surface> void add_faces(Faces& faces, const Surface& surface) requires(collide::IsSurface<Surface>) {
    surface.parts_near(std::decay_t<decltype(surface.bounds({}))>::everything(), [&](const auto& part) {
        add_face(faces, {placed_in_space(part.a), placed_in_space(part.b), placed_in_space(part.c)});
    });
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
        Faces faces;
        for (const auto& collider : colliders) {
            if (collider.is_sensor || !collider.is_enabled()) continue;
            const auto colors = colors_of(collider.name, scene_, theme_);
            if (!colors.hidden)
                std::visit([&](const auto& shape) { collect(faces, shape, collider.target, colors.fill); },
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

    template <class ShapeT>
    static void collect(Faces& faces, const ShapeT& shape, const Pose& pose, const Color& color) {
        const auto first = faces.size();
        add_faces(faces, shape);
        for (auto i = first; i < faces.size(); ++i) {
            for (auto& corner : faces[i].corners) corner = position(pose, corner);
            faces[i].normal = position({{}, pose.rotation}, faces[i].normal);
            faces[i].color = color;
        }
    }

    double depth_of(const SolidFace& face) const {
        Position sum{};
        for (const auto& corner : face.corners) sum += corner * (1.0 / double(face.corners.size()));
        const auto seen = view_.see(sum);
        return seen ? double(seen->depth) : 0;
    }

    void draw_faces(Faces& faces) {
        sinew::stable_sort(faces.begin(), faces.end(),
                           [&](const SolidFace& a, const SolidFace& b) { return depth_of(a) > depth_of(b); });
        const Light light(view_, theme_.ink);
        for (const auto& face : faces) draw_face(face, light);
    }

    /// Seams between faces are closed by a thin line of the same colour.
    void draw_face(const SolidFace& face, const Light& light) {
        pixels_.clear();
        for (const auto& corner : face.corners)
            if (const auto seen = view_.see(corner)) pixels_.push_back(seen->pixel);
        if (pixels_.size() < face.corners.size() || !faces_viewer()) return;
        const double lit = 0.5 + 0.5 * dot(face.normal, light.towards_light);
        const Color dark = mix(face.color, theme_.ink, 0.45F), pale = mix(face.color, {1, 1, 1, 1}, 0.5F);
        const Color shade = mix(dark, pale, float(lit));
        picture_.add(sinew::Shape::polygon, pixels_, 0, shade);
        picture_.add(sinew::Shape::loop, pixels_, 1, shade);
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
