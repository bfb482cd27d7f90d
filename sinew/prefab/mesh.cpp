#include "sinew/prefab/mesh.h"

#include "sinew/math/format.h"
#include "sinew/math/sort.h"

#include <algorithm>
#include <cmath>
#include <compare>

namespace sinew {
namespace {

const MeshModel usual_square{.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, -1, 0}}, {{0, -1, 0}}, {{0.5, -0.5, 0}}},
                             .corners = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4},
                             .ends = {3, 6, 9, 12}};

const MeshModel& shape_of(const Mesh& mesh) {
    return mesh.model ? *mesh.model : usual_square;
}

/// Number of sides and diagonals of all faces; those of several faces are counted several times.
std::size_t count_named(const MeshModel& model, bool diagonals) {
    std::size_t count = model.corners.size();
    for (std::size_t i = 0; i < model.faces() && diagonals; ++i)
        if (const auto corners = model.face(i).size(); corners > 3) count += corners;
    return count;
}

/// Calls visit(a, b), a < b, for the sides of all faces, then for the diagonals. A side shared by faces is visited once
/// for each face.
template <class Visit> void each_named(const MeshModel& model, bool diagonals, Visit&& visit) {
    for (std::size_t apart = 1; apart <= (diagonals ? 2U : 1U); ++apart)
        for (std::size_t i = 0; i < model.faces(); ++i) {
            const auto face = model.face(i);
            if (face.size() < 2 + apart) continue;
            for (std::size_t k = 0; k < face.size(); ++k) {
                const auto next = k + apart;
                const auto a = face[k], b = face[next < face.size() ? next : next - face.size()];
                visit(std::min(a, b), std::max(a, b));
            }
        }
}

/// Marks each visit of each_named whose pair (a, b) has been visited before. Pairs are grouped by a and sorted, in
/// batches of about an eighth of all pairs, because the list of pairs can need more memory than the built mesh.
std::vector<bool> repeats_of(const MeshModel& model, bool diagonals) {
    struct Turn {
        std::uint32_t b, turn;
        auto operator<=>(const Turn&) const = default;
    };
    const auto points = std::uint32_t(model.points.size());
    const auto named = count_named(model, diagonals), max = std::max(named / 8, std::size_t(1) << 16);
    std::vector<std::uint32_t> count(points); // pairs of each a; then the number of pairs already in the batch
    each_named(model, diagonals, [&](std::uint32_t a, std::uint32_t) { ++count[a]; });
    std::vector<bool> repeats(named);
    std::vector<Turn> turns;
    std::vector<std::uint32_t> end; // end of the pairs of each a in the batch
    for (std::uint32_t first = 0, last = 0; first < points; first = last) {
        std::size_t listed = 0;
        for (end.clear(); last < points && (last == first || listed + count[last] <= max); ++last) {
            end.push_back(std::uint32_t(listed));
            listed += count[last];
        }
        turns.resize(listed);
        std::uint32_t turn = 0;
        each_named(model, diagonals, [&](std::uint32_t a, std::uint32_t b) {
            if (a >= first && a < last) turns[end[a - first]++] = {b, turn};
            ++turn;
        });
        for (std::size_t i = 0, begin = 0; i < end.size(); begin = end[i++]) {
            sinew::sort(turns.begin() + std::ptrdiff_t(begin), turns.begin() + end[i]);
            for (auto k = begin + 1; k < end[i]; ++k)
                if (turns[k].b == turns[k - 1].b) repeats[turns[k].turn] = true;
        }
    }
    return repeats;
}

} // namespace

Sizes Mesh::sizes() const {
    const auto& shape = shape_of(*this);
    return {.particles = shape.points.size(), .constraints = count_named(shape, diagonals)};
}

std::optional<std::string> Mesh::problem(int) const {
    const auto points = shape_of(*this).points.size();
    for (const double number : pin_list)
        if (!(number >= 0 && number < double(points)) || number != std::floor(number))
            return format_text("pin_list holds {}: the points of this mesh are counted from 0 to {}", number,
                               points - 1);
    return std::nullopt;
}

template <int D, class Real> void Mesh::build(Builder<D, Real>& figure) const {
    const auto& shape = shape_of(*this);
    const auto& particles = figure.figure().particles;
    figure.figure().tethers = tethers;
    figure.number_particles("vertex", shape.points.size());
    const double share = mass / double(shape.points.size());
    for (const auto& point : shape.points)
        figure.particle("", Vec<D, double>::map([&](int i) { return size * point[i]; }), share, thickness / 2);
    const auto repeats = repeats_of(shape, diagonals);
    figure.number_constraints("edge", std::size_t(std::count(repeats.begin(), repeats.end(), false)));
    auto spec = strength.applied_to(elasticity.spec());
    each_named(shape, diagonals, [&, turn = std::size_t(0)](std::uint32_t a, std::uint32_t b) mutable {
        if (repeats[turn++]) return;
        const std::array ends{particles[a], particles[b]};
        const double length = figure.template measure<Distance>(ends);
        spec.limits = between((1 - buckling) * length, length);
        figure.template constrain<Distance>("", ends, spec);
    });
    for (const double number : pin_list) figure.hold(particles[std::size_t(number)]);
    for (std::size_t i = 0; i < shape.faces() && !unseen; ++i) {
        std::vector<ParticleId> corners;
        for (const auto corner : shape.face(i)) corners.push_back(particles[corner]);
        if (corners.size() == 3) corners.push_back(corners.back()); // a surface patch has four corners
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
