#include "bindings/c/native/collider_shape.h"

#include "sinew/math/format.h"
#include "sinew/math/limit.h"
#include "sinew/math/point.h"
#include "sinew/world/world_types.h"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::c {
namespace {

constexpr std::uint32_t max_points = 1U << 20, max_triangles = 1U << 22, max_heights = 1U << 24;

template <class Real> bool is_coordinate(double number) {
    return std::fabs(number) <= double(limit::coordinate<Real>);
}

template <class Real> std::string beyond(std::string_view name) {
    return format_text("{} is within {:6}", name, double(limit::coordinate<Real>));
}
template <class Real> std::string beyond(std::string_view list, std::size_t index) {
    return format_text("{}[{}] is no number, or not within {:6}", list, index, double(limit::coordinate<Real>));
}

/// Shapes that a struct describes. `problem` is set by the first number that makes none.
template <int D, class Real> class Shapes {
    using Vector = Vec<D, Real>;
    using Any = collide::Shape<D, Real>;

  public:
    explicit Shapes(const sinew_collider_spec& spec) : spec_(spec) {}

    std::string problem{};

    Any of() {
        switch (spec_.shape) {
        case SINEW_HALF_SPACE:
            return collide::HalfSpace<D, Real>{};
        case SINEW_SPHERE:
            return collide::Sphere<D, Real>{radius("a sphere")};
        case SINEW_CAPSULE:
            return capsule();
        case SINEW_BOX:
            return box();
        default:
            break;
        }
        if constexpr (D == 2) {
            if (spec_.shape == SINEW_POLYGON_2D) return polygon();
            if (spec_.shape == SINEW_TERRAIN_2D) return terrain();
        } else {
            if (spec_.shape == SINEW_MESH_3D) return mesh();
            if (spec_.shape == SINEW_HEIGHT_FIELD_3D) return height_field();
        }
        return refuse("no shape of this dimension has this number");
    }

  private:
    const sinew_collider_spec& spec_;

    Any refuse(std::string why) {
        if (problem.empty()) problem = std::move(why);
        return {};
    }

    Real radius(std::string_view of) {
        if (!(Real(spec_.radius) > Real(0))) refuse(format_text("{} has a radius above 0", of));
        if (!is_coordinate<Real>(spec_.radius)) refuse(beyond<Real>("radius"));
        return Real(spec_.radius);
    }
    Any capsule() {
        const auto thickness = radius("a capsule");
        if (!is_coordinate<Real>(spec_.half.x)) return refuse(beyond<Real>("half.x"));
        const auto end = Vector::axis(0) * Real(spec_.half.x);
        return collide::Capsule<D, Real>{-end, end, thickness};
    }
    Any box() {
        const auto half = point(spec_.half);
        for (int i = 0; i < D; ++i)
            if (!(half[i] > Real(0)) || !is_coordinate<Real>(double(half[i])))
                return refuse("a box has edges above 0, and within 1e8");
        return collide::Box<D, Real>{half * Real(2)};
    }

    static Vector point(const sinew_point& given) { return Point{{given.x, given.y, given.z}}.template as<D, Real>(); }
    static bool is_place(const sinew_point& given) {
        return is_coordinate<Real>(given.x) && is_coordinate<Real>(given.y) && is_coordinate<Real>(given.z);
    }
    /// The caller's points; none after an error.
    std::vector<Vector> points(std::uint32_t least, std::string_view of) {
        std::vector<Vector> list;
        if (spec_.point_count < least || spec_.point_count > max_points || !spec_.points) {
            refuse(format_text("{} has from {} to {} points, found {}", of, least, max_points, spec_.point_count));
            return list;
        }
        for (std::uint32_t i = 0; i < spec_.point_count; ++i) {
            if (!is_place(spec_.points[i])) refuse(beyond<Real>("points", i));
            list.push_back(point(spec_.points[i]));
        }
        return problem.empty() ? list : std::vector<Vector>();
    }

    // --- two dimensions ----------------------------------------------------------------------------------------------

    Any polygon() {
        auto corners = points(3, "a polygon");
        double turns = 0;
        for (std::size_t i = 0, n = corners.size(); i < n; ++i) {
            const auto before = cast<double>(corners[(i + 1) % n] - corners[i]),
                       after = cast<double>(corners[(i + 2) % n] - corners[(i + 1) % n]);
            const double turn = std::atan2(before[0] * after[1] - before[1] * after[0], dot(before, after));
            if (!(turn > 0))
                return refuse(format_text("a polygon is convex, its corners counter-clockwise: not at points[{}]; one "
                                          "with dents is a closed terrain",
                                          (i + 1) % n));
            turns += turn;
        }
        if (turns > 7) return refuse("a polygon goes around once"); // 2 pi: a star goes around twice
        return collide::Polygon<2, Real>{std::move(corners)};
    }
    Any terrain() {
        const bool is_closed = spec_.is_closed != 0;
        auto line = points(is_closed ? 3 : 2, "a terrain");
        const auto n = line.size(), edges = is_closed || n == 0 ? n : n - 1;
        for (std::size_t i = 0; i < edges; ++i)
            if (const auto next = (i + 1) % n; line[i] == line[next])
                return refuse(format_text("points[{}] and points[{}] are in the same place", i, next));
        return collide::Chain<2, Real>{std::move(line), is_closed};
    }

    // --- three dimensions --------------------------------------------------------------------------------------------

    Any mesh() {
        auto corners = points(3, "a mesh");
        std::vector<std::array<std::uint32_t, 3>> triangles;
        if (spec_.triangle_count == 0 || spec_.triangle_count > max_triangles || !spec_.triangles)
            return refuse(
                format_text("a mesh has from 1 to {} triangles, found {}", max_triangles, spec_.triangle_count));
        for (std::uint32_t i = 0; i < spec_.triangle_count && problem.empty(); ++i) {
            const auto* numbers = spec_.triangles + 3 * std::size_t(i);
            triangles.push_back({numbers[0], numbers[1], numbers[2]});
            refuse_triangle(i, triangles.back(), corners);
        }
        if (!problem.empty()) return {};
        return collide::Mesh<3, Real>(std::move(corners), std::move(triangles));
    }
    void refuse_triangle(std::uint32_t index, const std::array<std::uint32_t, 3>& triangle,
                         const std::vector<Vector>& corners) {
        for (const auto corner : triangle)
            if (corner >= corners.size()) {
                refuse(format_text("triangles[{}] names point {} of {}", index, corner, corners.size()));
                return;
            }
        const auto& [a, b, c] = triangle;
        const auto normal = cross(corners[b] - corners[a], corners[c] - corners[a]);
        if (!(dot(normal, normal) > Real(0))) refuse(format_text("triangles[{}] has no area", index));
    }
    Any height_field() {
        const auto count = std::uint64_t(spec_.columns) * spec_.rows;
        if (spec_.columns < 2 || spec_.rows < 2 || count > max_heights || !spec_.heights)
            return refuse(
                format_text("a height field has at least 2 rows of 2 heights, at most {} in all, found {} x {}",
                            max_heights, spec_.rows, spec_.columns));
        if (!(Real(spec_.spacing) > Real(0)) || !is_coordinate<Real>(spec_.spacing))
            return refuse("spacing is above 0, and within 1e8");
        collide::HeightField<3, Real> field{.columns = spec_.columns, .spacing = Real(spec_.spacing), .height = {}};
        for (std::size_t i = 0; i < count; ++i) {
            if (!is_coordinate<Real>(spec_.heights[i])) return refuse(beyond<Real>("heights", i));
            field.height.push_back(Real(spec_.heights[i]));
        }
        return field;
    }
};

} // namespace

template <int D, class Real> std::string set_shape(const sinew_collider_spec& spec, collide::Shape<D, Real>& shape) {
    Shapes<D, Real> shapes(spec);
    auto made = shapes.of();
    if (shapes.problem.empty()) shape = std::move(made);
    return shapes.problem;
}

#define SINEW_C_SHAPES(D, Real)                                                                                        \
    template std::string set_shape<D, Real>(const sinew_collider_spec&, collide::Shape<D, Real>&);
SINEW_INSTANTIATE(SINEW_C_SHAPES)

} // namespace sinew::c
