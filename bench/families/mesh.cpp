#include "sinew/prefab/mesh.h"

#include "sinew/math/random.h"

#include "bench/cases.h"
#include "bench/shuffle.h"

#include <array>

namespace sinew::bench {
namespace {

constexpr double cell = 0.03; // metres

/// The cloth of cloth-SIZE as a mesh with points and faces in random order. Four triangles per cell have the cell's
/// sides and both diagonals for edges.
MeshModel shuffled_cloth(int side) {
    std::vector<std::uint32_t> number(std::size_t(side) * side);
    for (std::size_t i = 0; i < number.size(); ++i) number[i] = std::uint32_t(i);
    // The two pinned corners stay the first two points.
    std::swap(number[1], number[std::size_t(side) - 1]);
    std::vector<std::uint32_t> inner(number.begin() + 2, number.end());
    shuffle(inner, 1);
    std::vector<std::uint32_t> grid{number[0], number[1]};
    grid.insert(grid.end(), inner.begin(), inner.end()); // grid[point of the file] = index in the grid
    MeshModel model;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        number[grid[i]] = std::uint32_t(i);
        const double x = cell * (grid[i] % side), y = -cell * (grid[i] / side);
        model.points.push_back({{x, y, i < 2 ? 0 : 1e-3 * cell * random::symmetric(1, 0, grid[i])}});
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (int r = 0; r + 1 < side; ++r)
        for (int c = 0; c + 1 < side; ++c) {
            const auto at = [&](int down, int right) { return number[std::size_t((r + down) * side + c + right)]; };
            triangles.push_back({at(0, 0), at(0, 1), at(1, 1)});
            triangles.push_back({at(0, 0), at(1, 1), at(1, 0)});
            triangles.push_back({at(0, 1), at(1, 1), at(1, 0)});
            triangles.push_back({at(0, 0), at(0, 1), at(1, 0)});
        }
    shuffle(triangles, 2);
    for (const auto& triangle : triangles) {
        model.corners.insert(model.corners.end(), triangle.begin(), triangle.end());
        model.ends.push_back(std::uint32_t(model.corners.size()));
    }
    return model;
}

/// OBJ text of the shuffled cloth; the model itself is freed.
std::string shuffled_file(int side) {
    return to_obj(shuffled_cloth(side));
}

template <class Real> void hang(World<3, Real>& world, int side) {
    auto read = read_obj(shuffled_file(side), {.points = std::size_t(1) << 25, .corners = std::size_t(1) << 28});
    const Mesh mesh{.pin_list = {0, 1},
                    .mass = double(side) * side,
                    .model = std::make_shared<const MeshModel>(std::get<MeshModel>(std::move(read))),
                    .unseen = true};
    build(world, mesh, "mesh");
}

} // namespace

CaseFamily family::mesh() {
    return {.name = "mesh",
            .about = "the same cloth as a mesh read from an OBJ file, its points and triangles in no order",
            .sizes = {"64", "256"}, // 1024 takes minutes to build: on request only
            .max = 2048,
            .build_float = hang<float>,
            .build_double = hang<double>};
}

} // namespace sinew::bench
