#include "files/out/solids.h"

#include "sinew/math/scalar.h"

#include <cmath>

namespace sinew::files {
namespace {

/// Corners of a circle: of a thin rod, and of what is seen by itself.
constexpr int rod_sides = 12, ball_sides = 32;

/// A row of vertices around y: a circle of a surface of revolution.
struct Circle {
    double height, radius; ///< metres
    double up;             ///< y of the unit normal
};

Vec3<float> narrow(const Vec3<double>& v) {
    return cast<float>(v);
}

/// Quadrilaterals between rows of `across` vertices.
void join_rows(TriangleMesh& mesh, std::uint32_t rows, std::uint32_t across) {
    for (std::uint32_t r = 0; r + 1 < rows; ++r)
        for (std::uint32_t c = 0; c + 1 < across; ++c) {
            const auto a = r * across + c, b = a + 1, d = a + across, e = d + 1;
            for (const auto corner : {a, d, b, b, d, e}) mesh.indices.push_back(corner);
        }
}

TriangleMesh revolved(std::span<const Circle> circles, int sides) {
    TriangleMesh mesh;
    for (const auto& circle : circles)
        for (int i = 0; i <= sides; ++i) {
            const double angle = 2 * pi<double> * i / sides, c = std::cos(angle), s = std::sin(angle);
            const double flat = std::sqrt(std::fmax(0, 1 - circle.up * circle.up));
            mesh.positions.push_back(narrow({{circle.radius * c, circle.height, circle.radius * s}}));
            mesh.normals.push_back(narrow({{flat * c, circle.up, flat * s}}));
        }
    join_rows(mesh, std::uint32_t(circles.size()), std::uint32_t(sides + 1));
    return mesh;
}

/// Half circles from the lowest point up, around (0, height, 0).
void add_dome(std::vector<Circle>& circles, double height, double radius, double from, double to) {
    constexpr int steps = 4;
    for (int i = 0; i <= steps; ++i) {
        const double angle = (from + (to - from) * i / steps) * pi<double> / 2;
        circles.push_back({height + radius * std::sin(angle), radius * std::cos(angle), std::sin(angle)});
    }
}

} // namespace

TriangleMesh rod(double length, double begin, double end) {
    std::vector<Circle> circles;
    add_dome(circles, 0, begin, -1, 0);
    add_dome(circles, length, end, 0, 1);
    return revolved(circles, rod_sides);
}

void lay_image(TriangleMesh& rod, double length, double radius, double times) {
    for (const auto& p : rod.positions)
        rod.on_image.push_back(
            cast<float>(Vec2<double>{{times * double(p[1]) / length, 0.5 + double(p[0]) / (2 * radius)}}));
}

TriangleMesh sphere(double radius) {
    std::vector<Circle> circles;
    add_dome(circles, 0, radius, -1, 0);
    circles.pop_back();
    add_dome(circles, 0, radius, 0, 1);
    return revolved(circles, ball_sides);
}

TriangleMesh disc(double radius, double half_height) {
    const std::array<Circle, 6> circles = {{{-half_height, 0, -1},
                                            {-half_height, radius, -1},
                                            {-half_height, radius, 0},
                                            {half_height, radius, 0},
                                            {half_height, radius, 1},
                                            {half_height, 0, 1}}};
    auto mesh = revolved(circles, ball_sides);
    for (auto* column : {&mesh.positions, &mesh.normals})
        for (auto& v : *column) v = {{v[0], -v[2], v[1]}}; // the axis from y to z
    return mesh;
}

TriangleMesh long_ring(double length, double width) {
    constexpr int round = 8, around = 8;
    const double wire = 0.15 * width, bend = width / 2 - wire; // radii: of the wire, of its centre line
    TriangleMesh mesh;
    for (int i = 0; i <= 2 * round + 2; ++i) {
        const int k = i % (2 * round + 2); // closed: the last row is the first
        const bool is_top = k <= round;
        const double angle = pi<double> * (is_top ? k : k - 1) / round, c = std::cos(angle), s = std::sin(angle);
        const Vec3<double> out{{c, s, 0}}, center{{bend * c, bend * s + (is_top ? length : 0), 0}};
        for (int j = 0; j <= around; ++j) {
            const double turn = 2 * pi<double> * j / around;
            const auto normal = out * std::cos(turn) + Vec3<double>{{0, 0, std::sin(turn)}};
            mesh.positions.push_back(narrow(center + normal * wire));
            mesh.normals.push_back(narrow(normal));
        }
    }
    join_rows(mesh, 2 * round + 3, around + 1);
    return mesh;
}

} // namespace sinew::files
