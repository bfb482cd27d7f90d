#include "sinew/prefab/cloth.h"

#include "sinew/math/format.h"
#include "sinew/math/random.h"

#include <cmath>

namespace sinew {
namespace {

/// Particles of a cloth by column and row.
struct Grid {
    std::size_t columns, rows;
    std::vector<ParticleId> particles;

    ParticleId at(std::size_t column, std::size_t row) const { return particles[row * columns + column]; }
};

/// A family of threads that span `across` columns and `down` rows: from the upper left to the lower right, or with
/// `rising` from the lower left to the upper right.
struct Thread {
    std::string_view stem;
    std::size_t across, down;
    bool rising = false;
    double shortest = 1; ///< shortest length allowed, as a share of the length
};

/// Share of one direction's length that belongs to a particle: half a cell at the ends.
double share(std::size_t i, std::size_t n) {
    return (i == 0 || i + 1 == n ? 0.5 : 1.0) / double(n - 1);
}

template <int D> Vec<D, double> on_plane(std::string_view plane, double x, double down) {
    auto position = on_screen<D>(x, -down);
    if constexpr (D == 3)
        if (plane == "horizontal") position = {{x, 0, down}};
    return position;
}

template <int D, class Real> Grid lay_out(Builder<D, Real>& figure, const Cloth& cloth) {
    Grid grid{std::size_t(cloth.columns), std::size_t(cloth.rows), {}};
    grid.particles.reserve(grid.columns * grid.rows);
    figure.number_particles("particle", grid.columns * grid.rows, grid.columns);
    const double middle = 0.5 * double(grid.columns - 1);
    for (std::size_t r = 0; r < grid.rows; ++r)
        for (std::size_t c = 0; c < grid.columns; ++c) {
            const auto position =
                on_plane<D>(cloth.plane, cloth.spacing * (double(c) - middle), cloth.spacing * double(r));
            const double mass = cloth.mass * share(c, grid.columns) * share(r, grid.rows);
            grid.particles.push_back(figure.particle("", position, mass, cloth.thickness / 2));
        }
    return grid;
}

template <int D, class Real> void name_corners(Builder<D, Real>& figure, const Grid& grid) {
    auto& names = figure.figure().particle_names;
    names.emplace_back("top_left", grid.at(0, 0));
    names.emplace_back("top_right", grid.at(grid.columns - 1, 0));
    names.emplace_back("bottom_left", grid.at(0, grid.rows - 1));
    names.emplace_back("bottom_right", grid.at(grid.columns - 1, grid.rows - 1));
}

template <int D, class Real>
void weave(Builder<D, Real>& figure, const Grid& grid, const Thread& thread, ConstraintSpec<double> spec,
           double spacing, double uneven) {
    if (grid.columns <= thread.across || grid.rows <= thread.down) return;
    const auto columns = grid.columns - thread.across, rows = grid.rows - thread.down;
    const std::size_t from = thread.rising ? thread.across : 0, to = thread.across - from;
    const double length = spacing * square_root(double(thread.across * thread.across + thread.down * thread.down));
    spec.limits = between(thread.shortest * length, length);
    figure.number_constraints(thread.stem, columns * rows, columns);
    const double weakest = spec.breaking_strain;
    std::vector<std::array<ParticleId, 2>> links; // pending links with equal parameters
    const auto link = [&] { figure.link(links, spec), links.clear(); };
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t c = 0; c < columns; ++c) {
            links.push_back({grid.at(c + from, r), grid.at(c + to, r + thread.down)});
            if (!(uneven > 0)) continue;
            const auto number = figure.figure().constraints.size();
            spec.breaking_strain = weakest * (1 + uneven * random::uniform(0, number, 0));
            link();
        }
        link();
    }
}

template <int D, class Real> void weave(Builder<D, Real>& figure, const Grid& grid, const Cloth& cloth) {
    const auto threads = [&](const Thread& thread, const Elasticity& elasticity) {
        weave(figure, grid, thread, cloth.strength.applied_to(elasticity.spec()), cloth.spacing, cloth.uneven);
    };
    const double side = 1 - cloth.buckling, diagonal = cloth.buckling > 0 ? 0 : 1;
    threads({"across", 1, 0, false, side}, cloth.elasticity);
    threads({"down", 0, 1, false, side}, cloth.elasticity);
    if (cloth.diagonals != "none") threads({"falling", 1, 1, false, diagonal}, cloth.shear_elasticity);
    if (cloth.diagonals == "both") threads({"rising", 1, 1, true, diagonal}, cloth.shear_elasticity);
    if (cloth.bend) threads({"bend_across", 2, 0}, cloth.bend_elasticity);
    if (cloth.bend) threads({"bend_down", 0, 2}, cloth.bend_elasticity);
}

template <int D, class Real> void hold(Builder<D, Real>& figure, const Grid& grid, const Cloth& cloth) {
    const auto right = grid.columns - 1, bottom = grid.rows - 1;
    if (cloth.pins == "top")
        for (std::size_t c = 0; c <= right; ++c) figure.hold(grid.at(c, 0));
    if (cloth.pins == "corners" || cloth.pins == "all_corners")
        for (const auto c : {std::size_t(0), right}) figure.hold(grid.at(c, 0));
    if (cloth.pins == "all_corners")
        for (const auto c : {std::size_t(0), right}) figure.hold(grid.at(c, bottom));
    if (cloth.pins == "list")
        for (const double number : cloth.pin_list) figure.hold(grid.particles[std::size_t(number)]);
}

template <int D, class Real> void draw_threads(Builder<D, Real>& figure, const Grid& grid, double width) {
    for (std::size_t r = 0; r < grid.rows; ++r) {
        std::vector<ParticleId> row;
        for (std::size_t c = 0; c < grid.columns; ++c) row.push_back(grid.at(c, r));
        figure.draw(Mark::curve, "thread", std::move(row), width);
    }
    for (std::size_t c = 0; c < grid.columns; ++c) {
        std::vector<ParticleId> column;
        for (std::size_t r = 0; r < grid.rows; ++r) column.push_back(grid.at(c, r));
        figure.draw(Mark::curve, "thread", std::move(column), width);
    }
}

/// Draws cells column by column: folds of hanging cloth run down, so cells must overlap from one side to the other.
template <int D, class Real> void draw_cells(Builder<D, Real>& figure, const Grid& grid) {
    for (std::size_t c = 0; c + 1 < grid.columns; ++c)
        for (std::size_t r = 0; r + 1 < grid.rows; ++r)
            figure.draw(Mark::surface, "cloth",
                        {grid.at(c, r), grid.at(c + 1, r), grid.at(c + 1, r + 1), grid.at(c, r + 1)});
}

} // namespace

Sizes Cloth::sizes() const {
    const auto particles = std::size_t(columns) * std::size_t(rows);
    const std::size_t crossing = diagonals == "both" ? 2 : diagonals == "one" ? 1 : 0;
    return {.particles = particles, .constraints = particles * (2 + crossing + (bend ? 2 : 0))};
}

std::optional<std::string> Cloth::problem(int dimension) const {
    if (dimension == 2 && plane == "horizontal") return "a horizontal cloth needs a world of three dimensions";
    if (!pin_list.empty() && pins != "list") return "pin_list counts only with pins = list";
    const auto particles = double(columns) * double(rows);
    for (const double number : pin_list)
        if (!(number >= 0 && number < particles) || number != std::floor(number))
            return format_text("pin_list holds {}: this cloth's particles are counted from 0 to {}", number,
                               std::int64_t(particles) - 1);
    return std::nullopt;
}

template <int D, class Real> void Cloth::build(Builder<D, Real>& figure) const {
    const auto grid = lay_out(figure, *this);
    figure.figure().tethers = tethers;
    name_corners(figure, grid);
    weave(figure, grid, *this);
    hold(figure, grid, *this);
    if (drawn != "threads") draw_cells(figure, grid);
    if (drawn != "fill") draw_threads(figure, grid, thickness);
}

#define SINEW_CLOTH(D, Real) template void Cloth::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_CLOTH)

} // namespace sinew
