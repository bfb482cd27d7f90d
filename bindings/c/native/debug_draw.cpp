#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

/// A world as segments, spheres and polygons, by callbacks.
using namespace sinew;
using namespace sinew::c;

namespace {

constexpr std::uint32_t blue = 0x3b7ddd, grey = 0xa0a0a0, black = 0x202020, brown = 0x8a6d4b, red = 0xd03030;
constexpr double most_strain = 0.1; ///< drawn red

template <int D, class Real> sinew_point in_c(const Vec<D, Real>& vector) {
    sinew_point point{double(vector[0]), double(vector[1]), 0};
    if constexpr (D == 3) point.z = double(vector[2]);
    return point;
}

/// Green at rest, over yellow to red.
std::uint32_t color_of_strain(double strain) {
    const double share = std::min(std::fabs(strain) / most_strain, 1.0);
    const auto level = [](double amount) { return std::uint32_t(40 + 160 * std::min(amount, 1.0)); };
    return level(2 * share) << 16 | level(2 - 2 * share) << 8 | 40;
}

/// Items drawn, in order. Callbacks follow when all items are listed, and may change the world or close it.
class Sketch {
  public:
    explicit Sketch(double extent) : extent(extent) {}

    const double extent;

    void segment(const sinew_point& from, const sinew_point& to, double radius, std::uint32_t color) {
        add(Shape::segment, std::array{from, to}, radius, color);
    }
    void sphere(const sinew_point& center, double radius, std::uint32_t color) {
        add(Shape::sphere, std::array{center}, radius, color);
    }
    void polygon(const std::vector<sinew_point>& corners, std::uint32_t color) {
        add(Shape::polygon, corners, 0, color);
    }

    /// Calls back for each, where the caller has a callback.
    void draw(const sinew_debug_draw& by) const {
        for (const auto& [shape, first, count, radius, color] : items_) {
            const auto* points = points_.data() + first;
            if (shape == Shape::segment && by.segment) by.segment(by.context, points[0], points[1], radius, color);
            if (shape == Shape::sphere && by.sphere) by.sphere(by.context, points[0], radius, color);
            if (shape == Shape::polygon && by.polygon) by.polygon(by.context, points, count, color);
        }
    }

  private:
    enum class Shape : std::uint8_t { segment, sphere, polygon };
    struct Item {
        Shape shape;
        std::size_t first, count; ///< in points_
        double radius;
        std::uint32_t color;
    };
    std::vector<Item> items_;
    std::vector<sinew_point> points_;

    void add(Shape shape, std::span<const sinew_point> points, double radius, std::uint32_t color) {
        items_.push_back({shape, points_.size(), points.size(), radius, color});
        points_.insert(points_.end(), points.begin(), points.end());
    }
};

template <int D, class Real> void draw_links(const World<D, Real>& world, Sketch& sketch) {
    constexpr int kind = kind_number<Distance, D>;
    const auto& table = std::get<std::size_t(kind)>(world.constraints);
    const auto& positions = world.particles.position;
    for (Row row = 0; row < table.size(); ++row) {
        const auto state = constraint_state(world, {kind, table.handles.id_of(row)});
        const auto ends = table.members[row];
        sketch.segment(in_c(positions[ends[0]]), in_c(positions[ends[1]]), 0,
                       color_of_strain(state ? state->strain : 0));
    }
}

template <int D, class Real> void draw_particles(const World<D, Real>& world, Sketch& sketch) {
    const auto& particles = world.particles;
    for (Row row = 0; row < particles.size(); ++row) {
        const auto color = particles.mobility[row] == Real(0) ? black : particles.asleep[row] != 0 ? grey : blue;
        sketch.sphere(in_c(particles.position[row]), double(particles.radius[row]), color);
    }
}

/// Calls visit(shape) by the type of shape.
template <int D, class Real> struct ColliderSketch {
    Sketch& sketch;
    const collide::Pose<D, Real>& pose;

    sinew_point placed(const Vec<D, Real>& local) const { return in_c(pose.to_world(local)); }

    void operator()(const collide::HalfSpace<D, Real>& plane) const {
        const auto foot = plane.normal * plane.offset;
        for (int i = 0; i < D; ++i) { // an edge along each direction of the plane
            const auto axis = Vec<D, Real>::axis(i);
            const auto along = axis - plane.normal * dot(axis, plane.normal);
            const Real length = norm(along);
            if (!(length > Real(0.1))) continue;
            const auto reach = along * (Real(sketch.extent) / length);
            sketch.segment(placed(foot - reach), placed(foot + reach), 0, brown);
        }
    }
    void operator()(const collide::Sphere<D, Real>& sphere) const {
        sketch.sphere(in_c(pose.position), double(sphere.radius), brown);
    }
    void operator()(const collide::Capsule<D, Real>& capsule) const {
        sketch.segment(placed(capsule.a), placed(capsule.b), double(capsule.radius), brown);
    }
    void operator()(const collide::Box<D, Real>& box) const {
        if constexpr (D == 2) {
            const auto half = box.half();
            polygon({{{-half[0], -half[1]}}, {{half[0], -half[1]}}, {{half[0], half[1]}}, {{-half[0], half[1]}}});
        } else {
            for (int corner = 0; corner < 8; ++corner)
                for (int i = 0; i < D; ++i)
                    if (!(corner >> i & 1))
                        sketch.segment(placed(corner_of(box, corner)), placed(corner_of(box, corner | 1 << i)), 0,
                                       brown);
        }
    }
    void operator()(const collide::Polygon<2, Real>& shape) const requires(D == 2) { polygon(shape.corners); }
    void operator()(const collide::Chain<2, Real>& chain) const requires(D == 2) {
        const auto& points = chain.points;
        for (std::size_t i = 1; i < points.size() + chain.is_closed; ++i)
            sketch.segment(placed(points[i - 1]), placed(points[i % points.size()]), 0, brown);
    }
    void operator()(const collide::Mesh<3, Real>&) const requires(D == 3) {}
    void operator()(const collide::HeightField<3, Real>&) const requires(D == 3) {}

    static Vec<D, Real> corner_of(const collide::Box<D, Real>& box, int corner) {
        const auto half = box.half();
        return Vec<D, Real>::map([&](int i) { return corner >> i & 1 ? half[i] : -half[i]; });
    }
    void polygon(const std::vector<Vec<D, Real>>& corners) const {
        std::vector<sinew_point> points;
        for (const auto& corner : corners) points.push_back(placed(corner));
        sketch.polygon(points, brown);
    }
};

template <int D, class Real> void draw_colliders(const World<D, Real>& world, Sketch& sketch) {
    for (const auto& collider : world.colliders)
        if (collider.is_enabled()) std::visit(ColliderSketch<D, Real>{sketch, collider.target}, collider.shape);
    const collide::Pose<D, Real> origin;
    for (const auto& plane : world.bounds)
        ColliderSketch<D, Real>{sketch, origin}(collide::HalfSpace<D, Real>{plane.normal, plane.offset});
}

void draw_contacts(sinew_world simulation, Sketch& sketch) {
    constexpr double share = 0.02; // of the extent: length of a normal
    std::uint32_t count = 0;
    if (sinew_world_contact_count(simulation, &count) != SINEW_OK) return;
    for (std::uint32_t i = 0; i < count; ++i) {
        sinew_contact contact{};
        contact.struct_size = sizeof contact;
        if (sinew_world_contact_at(simulation, i, &contact) != SINEW_OK || contact.phase == SINEW_END) continue;
        const auto &from = contact.point, &n = contact.normal;
        const double length = share * sketch.extent;
        sketch.sphere(from, 0, red);
        sketch.segment(from, {from.x + length * n.x, from.y + length * n.y, from.z + length * n.z}, 0, red);
    }
}

} // namespace

sinew_status sinew_world_draw_debug(sinew_world simulation, const sinew_debug_draw* given, double extent) {
    sinew_debug_draw draw;
    if (const auto status = take(given, draw)) return status;
    if (!(extent > 0) || !std::isfinite(extent)) return fail(SINEW_BAD_ARGUMENT, "an extent is above 0");
    Sketch sketch(extent);
    const auto wants = [&](int part) { return draw.parts == 0 || (draw.parts & std::uint32_t(part)) != 0; };
    const auto status = read(simulation, [&](const Simulation&, const Session& session) {
        std::visit(
            [&](const auto& world) {
                if (wants(SINEW_DRAW_COLLIDERS)) draw_colliders(world, sketch);
                if (wants(SINEW_DRAW_LINKS)) draw_links(world, sketch);
                if (wants(SINEW_DRAW_PARTICLES)) draw_particles(world, sketch);
            },
            session.world());
        return SINEW_OK;
    });
    if (status == SINEW_OK && wants(SINEW_DRAW_CONTACTS)) draw_contacts(simulation, sketch);
    if (status == SINEW_OK) sketch.draw(draw);
    return status;
}
