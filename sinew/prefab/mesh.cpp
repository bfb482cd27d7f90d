#include "sinew/prefab/mesh.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <fmt/format.h>

namespace sinew {
namespace {

const MeshModel usual_square{.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, -1, 0}}, {{0, -1, 0}}, {{0.5, -0.5, 0}}},
                             .corners = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4},
                             .ends = {3, 6, 9, 12}};

const MeshModel& shape_of(const Mesh& mesh) {
    return mesh.model ? *mesh.model : usual_square;
}

/// Two points, the lower number first.
struct Edge {
    std::uint32_t a, b;
};

/// Each once, in the order in which they are first named. Those of each lower point are sorted by themselves.
std::vector<Edge> each_once(const std::vector<Edge>& named, std::size_t points) {
    struct Turn {
        std::uint32_t b, turn;
        auto operator<=>(const Turn&) const = default;
    };
    std::vector<Turn> turns(named.size());
    std::vector<std::uint32_t> end(points + 1); // of what is there of each point, one further on until all are
    for (const auto& [a, b] : named) ++end[a + 1];
    for (std::size_t a = 1; a < end.size(); ++a) end[a] += end[a - 1];
    for (std::uint32_t turn = 0; const auto& [a, b] : named) turns[end[a]++] = {b, turn++};
    std::vector<char> repeats(named.size());
    for (std::uint32_t a = 0, first = 0; a < points; first = end[a++]) {
        std::sort(turns.begin() + first, turns.begin() + end[a]);
        for (auto i = first + 1; i < end[a]; ++i) repeats[turns[i].turn] = turns[i].b == turns[i - 1].b;
    }
    std::vector<Edge> edges;
    edges.reserve(std::size_t(std::count(repeats.begin(), repeats.end(), char(0))));
    for (std::size_t turn = 0; turn < named.size(); ++turn)
        if (!repeats[turn]) edges.push_back(named[turn]);
    return edges;
}

/// The edges of all faces, then their diagonals, each once.
std::vector<Edge> edges_of(const MeshModel& model, bool diagonals) {
    std::vector<Edge> edges;
    edges.reserve(model.corners.size() * (diagonals ? 2 : 1));
    for (std::size_t apart = 1; apart <= (diagonals ? 2U : 1U); ++apart)
        for (std::size_t i = 0; i < model.faces(); ++i) {
            const auto face = model.face(i);
            if (face.size() < 2 + apart) continue;
            for (std::size_t k = 0; k < face.size(); ++k) {
                const auto a = face[k], b = face[(k + apart) % face.size()];
                edges.push_back({std::min(a, b), std::max(a, b)});
            }
        }
    return each_once(edges, model.points.size());
}

} // namespace

Sizes Mesh::sizes() const {
    const auto& shape = shape_of(*this);
    return {.particles = shape.points.size(), .constraints = shape.corners.size() * (diagonals ? 2 : 1)};
}

std::optional<std::string> Mesh::problem(int) const {
    const auto points = shape_of(*this).points.size();
    for (const double number : pin_list)
        if (!(number >= 0 && number < double(points)) || number != std::floor(number))
            return fmt::format("pin_list holds {}: the points of this mesh are counted from 0 to {}", number,
                               points - 1);
    return std::nullopt;
}

template <int D, class Real> void Mesh::build(Builder<D, Real>& figure) const {
    const auto& shape = shape_of(*this);
    std::vector<ParticleId> particles;
    particles.reserve(shape.points.size());
    figure.figure().tethers = tethers;
    figure.number_particles("vertex", shape.points.size());
    const double share = mass / double(shape.points.size());
    for (const auto& point : shape.points) {
        const auto place = Vec<D, double>::map([&](int i) { return size * point[i]; });
        particles.push_back(figure.particle("", place, share, thickness / 2));
    }
    const auto edges = edges_of(shape, diagonals);
    figure.number_constraints("edge", edges.size());
    ConstraintSpec<double> spec{
        .compliance = compliance, .breaking_strain = tears_beyond(breaking_strain), .toughness = toughness};
    for (const auto& edge : edges) {
        const std::array ends{particles[edge.a], particles[edge.b]};
        const double length = figure.template measure<Distance>(ends);
        spec.limits = between((1 - buckling) * length, length);
        figure.template constrain<Distance>("", ends, spec);
    }
    for (const double number : pin_list) figure.hold(particles[std::size_t(number)]);
    for (std::size_t i = 0; i < shape.faces() && !unseen; ++i) {
        std::vector<ParticleId> corners;
        for (const auto corner : shape.face(i)) corners.push_back(particles[corner]);
        if (corners.size() == 3) corners.push_back(corners.back()); // a patch has four
        const bool patch = corners.size() == 4;
        if (drawn == "threads")
            figure.draw(Mark::loop, "thread", std::move(corners), thickness);
        else
            figure.draw(patch ? Mark::surface : Mark::fill, "cloth", std::move(corners));
    }
}

#define SINEW_MESH(D, Real) template void Mesh::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_MESH)

} // namespace sinew
