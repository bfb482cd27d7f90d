#include "sinew/scene/colliders.h"

#include "sinew/collide/decompose.h"
#include "sinew/math/format.h"
#include "sinew/scene/check.h"
#include "sinew/scene/svg_path.h"

#include <algorithm>

namespace sinew {
namespace {

std::uint32_t bits(const std::vector<int>& layers) {
    std::uint32_t sum = 0;
    for (const int layer : layers) sum |= std::uint32_t(1) << layer;
    return sum;
}

/// Most corners of a polygon's outline: its decomposition takes 0.1 s at worst, and grows with their cube.
constexpr std::size_t max_corners = 500;

/// Outlines of a polygon or a chain, by a path or by points.
template <class ShapeT> SvgPath outlines_of(const ShapeT& shape) {
    if (!shape.path.empty()) return read_svg_path(shape.path);
    SvgOutline outline;
    for (const auto& point : shape.points) outline.points.push_back(point.template as<2, double>());
    return {{outline}, {}};
}

/// Shapes of a section; a shape of the other dimension has none.
template <int D, class Real> struct ShapesOf {
    using Vector = Vec<D, Real>;
    using Shapes = std::vector<collide::Shape<D, Real>>;
    int up;

    Shapes operator()(const HalfSpaceShape& plane) const {
        return {collide::HalfSpace<D, Real>{direction(plane.normal.as<D, Real>()), 0}};
    }
    Shapes operator()(const SphereShape& sphere) const { return {collide::Sphere<D, Real>{Real(sphere.radius)}}; }
    Shapes operator()(const CapsuleShape& capsule) const {
        return {collide::Capsule<D, Real>{capsule.from.as<D, Real>(), capsule.to.as<D, Real>(), Real(capsule.radius)}};
    }
    Shapes operator()(const BoxShape& box) const { return {collide::Box<D, Real>{box.size.as<D, Real>()}}; }
    Shapes operator()(const PolygonShape& polygon) const {
        Shapes shapes;
        if constexpr (D == 2)
            for (const auto& [outline, holes] : solids_of(outlines_of(polygon).outlines, polygon.fill_rule).solids)
                for (const auto& part : collide::convex_parts(outline, holes)) {
                    collide::Polygon<2, Real> convex;
                    for (const auto& corner : part) convex.corners.push_back(cast<Real>(corner));
                    shapes.push_back(convex);
                }
        return shapes;
    }
    Shapes operator()(const ChainShape& chain) const {
        Shapes shapes;
        if constexpr (D == 2)
            for (const auto& outline : outlines_of(chain).outlines) {
                collide::Chain<2, Real> terrain{{}, chain.closed || outline.closed};
                for (const auto& point : outline.points) terrain.points.push_back(cast<Real>(point));
                if (up < 0) std::reverse(terrain.points.begin(), terrain.points.end());
                shapes.push_back(terrain);
            }
        return shapes;
    }
    Shapes operator()(const MeshShape& mesh) const {
        if constexpr (D == 3) {
            std::vector<Vector> corners;
            std::vector<std::array<std::uint32_t, 3>> triangles;
            if (mesh.model) {
                for (const auto& point : mesh.model->points) corners.push_back(cast<Real>(point * mesh.unit_length));
                for (std::size_t i = 0; i < mesh.model->faces(); ++i)
                    for (std::size_t k = 2; k < mesh.model->face(i).size(); ++k)
                        triangles.push_back(
                            {mesh.model->face(i)[0], mesh.model->face(i)[k - 1], mesh.model->face(i)[k]});
            }
            for (const auto& point : mesh.points) corners.push_back(point.as<3, Real>());
            for (const auto& [a, b, c] : mesh.triangles)
                triangles.push_back({std::uint32_t(a), std::uint32_t(b), std::uint32_t(c)});
            return {collide::Mesh<3, Real>(std::move(corners), std::move(triangles))};
        } else {
            return {};
        }
    }
    Shapes operator()(const HeightFieldShape& field) const {
        if constexpr (D == 3) {
            collide::HeightField<3, Real> landscape{.spacing = Real(field.spacing), .height = {}};
            landscape.columns = field.heights.empty() ? 0 : std::uint32_t(field.heights.front().size());
            for (const auto& row : field.heights)
                for (const double height : row) landscape.height.push_back(Real(height));
            return {landscape};
        } else {
            return {};
        }
    }
};

/// Reports the faults of a shape.
struct ShapeCheck {
    std::size_t index;
    int dimension;
    Document& document;

    void error(std::string_view key, const std::string& message, const std::string& help = {}) const {
        document.error(under("colliders", index, key), message, help);
    }
    void expect_dimension(int wanted, std::string_view name) const {
        if (dimension != wanted)
            error("shape",
                  format_text("a {} is a shape of {} dimensions, and this scene has {}", name, wanted, dimension));
    }

    template <class ShapeT> static std::string_view key_of(const ShapeT& shape) {
        return shape.path.empty() ? "points" : "path";
    }

    /// Outlines of a polygon or a chain; none after an error.
    template <class ShapeT> std::vector<SvgOutline> outlines(const ShapeT& shape, std::size_t least) const {
        expect_dimension(2, shape.name);
        const auto path = outlines_of(shape);
        const auto mistake = mistake_in(shape, path, least);
        if (mistake.empty()) return path.outlines;
        error(key_of(shape), mistake);
        return {};
    }
    template <class ShapeT> static std::string mistake_in(const ShapeT& shape, const SvgPath& path, std::size_t least) {
        if (!shape.path.empty() && !shape.points.empty())
            return format_text("a {} has either points or a path, not both", shape.name);
        if (!path.error.empty()) return path.error;
        std::size_t corners = 0;
        for (const auto& outline : path.outlines) corners += outline.points.size();
        if (corners < least) return format_text("a {} needs at least {} points, found {}", shape.name, least, corners);
        return {};
    }

    void operator()(const HalfSpaceShape& plane) const {
        if (plane.normal == Point{}) error("normal", "a normal needs a length");
    }
    void operator()(const SphereShape&) const {}
    void operator()(const CapsuleShape&) const {}
    void operator()(const BoxShape&) const {}
    void operator()(const PolygonShape& polygon) const {
        const auto path = outlines(polygon, 3);
        for (const auto& [points, closed] : path)
            if (points.size() > max_corners)
                return error(key_of(polygon), too_many(points.size()));
            else if (collide::convex_parts(points).empty())
                return error(key_of(polygon), "these corners enclose no area, or their edges cross",
                             "list at least three corners in order around the polygon");
        const auto [solids, mistake] = solids_of(path, polygon.fill_rule);
        if (!mistake.empty()) return error(key_of(polygon), mistake);
        for (const auto& [outline, holes] : solids) {
            std::size_t corners = outline.size();
            for (const auto& hole : holes) corners += hole.size();
            if (corners > max_corners) return error(key_of(polygon), too_many(corners));
            if (collide::convex_parts(outline, holes).empty())
                return error(key_of(polygon), "a hole touches the outline around it, or another hole",
                             "let the outlines of a path lie apart");
        }
    }
    static std::string too_many(std::size_t points) {
        return format_text("an outline of {} points; at most {} are allowed", points, max_corners);
    }
    void operator()(const ChainShape& chain) const {
        for (const auto& [points, closed] : outlines(chain, 2)) {
            const auto n = points.size(), edges = chain.closed || closed ? n : n - 1;
            for (std::size_t i = 0; i < edges; ++i)
                if (const auto next = (i + 1) % n; points[i] == points[next])
                    return error(key_of(chain),
                                 format_text("points {} and {} of the chain are in the same place", i, next));
        }
    }
    void operator()(const MeshShape& mesh) const {
        expect_dimension(3, mesh.name);
        if (!mesh.file.empty()) {
            if (!mesh.points.empty() || !mesh.triangles.empty())
                error("file", "a mesh has either points and triangles or a file, not both");
            else if (mesh.model && mesh.model->faces() == 0)
                error("file", "this file has no faces");
            return;
        }
        if (mesh.points.empty()) return error("points", "a mesh needs points, found none");
        if (mesh.triangles.empty()) return error("triangles", "a mesh needs triangles, found none");
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (const int corner : mesh.triangles[i])
                if (std::size_t(corner) >= mesh.points.size()) {
                    error(format_text("triangles/{}", i),
                          format_text("there is no point {}; the points are 0 to {}", corner, mesh.points.size() - 1));
                    return;
                }
    }
    void operator()(const HeightFieldShape& field) const {
        expect_dimension(3, field.name);
        const auto& rows = field.heights;
        if (rows.size() < 2 || rows.front().size() < 2)
            return error("heights", "a landscape needs at least 2 rows of 2 heights");
        for (std::size_t i = 1; i < rows.size(); ++i)
            if (rows[i].size() != rows.front().size())
                error(format_text("heights/{}", i), format_text("this row has {} heights, and the first one {}",
                                                                rows[i].size(), rows.front().size()));
    }
};

} // namespace

collide::Filter filter_of(const std::vector<int>& layers, const std::optional<std::vector<int>>& touches) {
    return {bits(layers), touches ? bits(*touches) : ~std::uint32_t(0)};
}

template <int D, class Real>
collide::Rotation<D, Real> rotation_of(const ColliderSection& section, double time, int up) {
    const double angle = (section.turn + (section.motion ? section.motion->spin * time : 0)) * up;
    if constexpr (D == 2)
        return collide::Rotation<2, Real>::of(Real(angle));
    else
        return collide::Rotation<3, Real>::of(section.axis.as<3, Real>(), Real(angle));
}

template <int D, class Real>
std::vector<collide::Collider<D, Real>> colliders_of(const ColliderSection& section, std::size_t index, int up) {
    std::vector<collide::Collider<D, Real>> colliders;
    for (auto& shape : std::visit(ShapesOf<D, Real>{up}, section.shape)) {
        collide::Collider<D, Real> collider{.shape = std::move(shape),
                                            .target = {section.at.as<D, Real>(), rotation_of<D, Real>(section, 0, up)},
                                            .restitution = Real(section.bounce),
                                            .friction = Real(section.friction),
                                            .filter = filter_of(section.layers, section.touches),
                                            .is_sensor = section.sensor,
                                            .surface_velocity = section.surface_velocity.as<D, Real>(),
                                            .name = section.name,
                                            .tag = std::uint32_t(index)};
        if (section.one_way) collider.one_way = collider.target.turn_back(section.one_way->as<D, Real>());
        colliders.push_back(std::move(collider));
    }
    return colliders;
}

void check_collider(const ColliderSection& section, std::size_t index, int dimension, Document& document) {
    std::visit(ShapeCheck{index, dimension, document}, section.shape);
    if (section.one_way && *section.one_way == Point{})
        document.error(under("colliders", index, "one_way"), "a direction needs a length");
    if (section.axis == Point{}) document.error(under("colliders", index, "axis"), "an axis needs a length");
}

#define SINEW_SCENE_COLLIDERS(D, Real)                                                                                 \
    template collide::Rotation<D, Real> rotation_of<D, Real>(const ColliderSection&, double, int);                     \
    template std::vector<collide::Collider<D, Real>> colliders_of<D, Real>(const ColliderSection&, std::size_t, int);
SINEW_INSTANTIATE(SINEW_SCENE_COLLIDERS)

} // namespace sinew
