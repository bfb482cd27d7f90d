#include "sinew/math/sort.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/step/wind_areas.h"
#include "sinew/solver/sweep/wind_at.h"

#include <algorithm>
#include <span>

/// Wind on areas: the pressure of the air on a patch by the angle at which it strikes, on a line by its length, width
/// and the flow across it, on a ball by its disc (White, "Fluid Mechanics", section 7.6):
///
///     F = 1/2 density drag_coefficient A |w| w,    w = velocity of the air relative to the patch, along its normal,
///                                                  across the line, or whole for a ball
///
/// and on a patch, strength A w / (0.1 m)^2. A force that grows with a speed is taken at the end of the step, F / (1 +
/// dt rate), area after area as the ones before have changed the velocities: no step is too long. A patch in 2D is seen
/// from the broad side: it takes the whole w.
namespace sinew {
namespace {

template <int D, class Real> class WindAreaFinder {
  public:
    WindAreaFinder(World<D, Real>& world, WindAreas& areas) : world_(world), p_(world.particles), areas_(areas) {}

    void find() {
        areas_.list.clear(), areas_.rows.clear(), areas_.links.clear();
        for (FigureIndex i = 0; i < world_.figures.size(); ++i)
            if (world_.figures[i].in_use()) find(i);
    }

  private:
    World<D, Real>& world_;
    const Particles<D, Real>& p_;
    WindAreas& areas_;

    void find(FigureIndex index) {
        auto& figure = world_.figures[index];
        const auto before = areas_.list.size();
        for (const auto& piece : figure.pieces)
            if (!piece.hidden) add_area(index, piece);
        if (areas_.list.size() == before) add_nets(figure);
        figure.faces_wind = world_.settings.mode == Mode::physical && areas_.list.size() > before;
        if (areas_.list.size() == before)
            for (const auto& piece : figure.pieces)
                if (!piece.hidden) add_lines(piece);
        if (areas_.list.size() == before) add_balls(figure);
    }

    void add_area(FigureIndex index, const Piece& piece) {
        const auto& ids = piece.particles;
        if (piece.mark == Mark::fragment) {
            add({.shape = WindArea::Shape::fragment, .figure = index, .fragment = piece.fragment}, ids);
        } else if (piece.mark == Mark::surface) {
            if (ids.size() != 4) return;
            ids[2] == ids[3] ? add_patch(std::array{ids[0], ids[1], ids[2]}) : add_patch(ids);
        } else if (piece.mark == Mark::fill && D == 3) {
            for (std::size_t i = 1; i + 1 < ids.size(); ++i) add_patch(std::array{ids[0], ids[i], ids[i + 1]});
        }
    }
    template <class Ids> bool add_patch(const Ids& ids) { return add({.shape = WindArea::Shape::patch}, ids); }
    /// False, and nothing added, if one of the particles is gone.
    template <class Ids> bool add(WindArea area, const Ids& ids) {
        area.first = std::uint32_t(areas_.rows.size()), area.count = std::uint32_t(ids.size());
        for (const auto id : ids) {
            const auto row = p_.handles.find(id);
            if (!row) return areas_.rows.resize(area.first), false;
            areas_.rows.push_back(*row);
        }
        if (area.count > 0) areas_.list.push_back(area);
        return area.count > 0;
    }

    /// Cells of a grid of threads, with a link at each side.
    void add_nets(const Figure& figure) {
        for (const auto& grid : figure.particle_numbers) {
            if (grid.columns < 2) continue;
            if (areas_.links.empty()) list_links();
            const auto at = [&](std::size_t column, std::size_t row) {
                const auto number = grid.first + row * grid.columns + column;
                return number < figure.particles.size() ? figure.particles[number] : ParticleId{};
            };
            for (std::size_t row = 0; (row + 2) * grid.columns <= grid.count; ++row)
                for (std::size_t column = 0; column + 1 < grid.columns; ++column)
                    add_cell({at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)});
        }
    }
    void add_cell(const std::array<ParticleId, 4>& ids) {
        if (!add_patch(ids)) return;
        const auto first = areas_.list.back().first;
        const auto rows = std::span(areas_.rows).subspan(first);
        for (std::size_t i = 0; i < 4; ++i)
            if (!are_linked(rows[i], rows[(i + 1) % 4])) return areas_.rows.resize(first), areas_.list.pop_back();
    }
    void list_links() {
        const auto& distances = std::get<kind_number<Distance, D>>(world_.constraints);
        for (Row row = 0; row < distances.size(); ++row) {
            const auto ends = distances.members[row];
            areas_.links.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
        }
        sinew::sort(areas_.links.begin(), areas_.links.end());
    }
    bool are_linked(Row a, Row b) const {
        return std::binary_search(areas_.links.begin(), areas_.links.end(),
                                  std::array<Row, 2>{std::min(a, b), std::max(a, b)});
    }

    /// Lines, and outlines of filled figures in 2D.
    void add_lines(const Piece& piece) {
        const bool is_closed = piece.mark == Mark::loop || piece.mark == Mark::fill;
        const bool is_line = is_closed || piece.mark == Mark::stroke || piece.mark == Mark::curve ||
                             piece.mark == Mark::limb || piece.mark == Mark::ring;
        const auto& ids = piece.particles;
        if (!is_line) return;
        for (std::size_t i = 0; i + (is_closed ? 0 : 1) < ids.size(); ++i)
            add({.shape = WindArea::Shape::line, .width = piece.width}, std::array{ids[i], ids[(i + 1) % ids.size()]});
    }
    void add_balls(const Figure& figure) {
        for (const auto id : figure.particles)
            if (const auto row = p_.handles.find(id); row && p_.radius[*row] > Real(0))
                add({.width = 2 * double(p_.radius[*row])}, std::span(&id, 1));
    }
};

/// Pressure of one wind on all areas, in a step of dt.
template <int D, class Real> class WindPress {
  public:
    WindPress(World<D, Real>& world, const WindAreas& areas, const Wind<D, Real>& wind, Real dt)
        : world_(world), p_(world.particles), areas_(areas), wind_(wind), dt_(dt),
          half_(Real(0.5) * wind.density * wind.drag_coefficient),
          per_area_(world.settings.mode == Mode::physical
                        ? wind.strength * inverse_or_zero(square(Real(0.1) * wind.metre))
                        : Real(0)) {}

    void press(const WindArea& area) {
        const auto rows = rows_of(area);
        if (p_.asleep[rows[0]]) return;
        const Real share = Real(1) / Real(area.count);
        Vector middle{}, velocity{};
        Real give = 0; // velocity by an impulse
        for (const Row row : rows) {
            middle += p_.position[row] * share;
            velocity += (p_.velocity[row] + p_.force[row] * (p_.inverse_mass[row] * dt_)) * share;
            give += p_.inverse_mass[row] * square(share);
        }
        const auto [size, wind] = met(area, wind_at(wind_, middle, world_.time) - velocity);
        const Real linear = area.count > 2 || area.shape == WindArea::Shape::fragment ? per_area_ : Real(0);
        const Real rate = clamp((half_ * norm(wind) + linear) * size, Real(0), limit::measure<Real>);
        const auto force = wind * (rate / (Real(1) + dt_ * rate * give) * share);
        for (const Row row : rows) p_.force[row] += clamp_components(force, limit::force<Real>);
    }

  private:
    using Vector = Vec<D, Real>;
    World<D, Real>& world_;
    Particles<D, Real>& p_;
    const WindAreas& areas_;
    const Wind<D, Real>& wind_;
    Real dt_, half_, per_area_;

    struct Met {
        Real area = 0;
        Vector wind{}; ///< the part that presses
    };
    Met met(const WindArea& area, const Vector& wind) const {
        switch (area.shape) {
        case WindArea::Shape::patch:
            return on_area(area_vector(area), wind);
        case WindArea::Shape::fragment:
            return on_area(area_of_fragment(area), wind);
        case WindArea::Shape::line: {
            const auto along = at(area, 1) - at(area, 0);
            const auto axis = direction(along);
            return {norm(along) * (D == 3 ? Real(area.width) : wind_.metre), wind - axis * dot(axis, wind)};
        }
        case WindArea::Shape::ball:
            break;
        }
        const Real width = Real(area.width);
        return {D == 3 ? Real(0.25 * pi<double>) * square(width) : width * wind_.metre, wind};
    }
    Met on_area(const Vec3<Real>& area, const Vector& wind) const {
        const Real size = norm(area);
        if constexpr (D == 3) {
            const auto normal = area * inverse_or_zero(size);
            return {size, normal * dot(normal, wind)};
        } else {
            return {size, wind};
        }
    }
    std::span<const Row> rows_of(const WindArea& area) const {
        return std::span(areas_.rows).subspan(area.first, area.count);
    }
    Vector at(const WindArea& area, std::size_t i) const { return p_.position[rows_of(area)[i]]; }
    Vec3<Real> solid(const Vector& v) const { return {{v[0], v[1], D == 3 ? v[D - 1] : Real(0)}}; }

    Vec3<Real> area_vector(const WindArea& area) const {
        const auto a = at(area, 0), b = at(area, 1), c = at(area, 2), d = at(area, area.count == 3 ? 2 : 3);
        return cross(solid(c - a), solid(d - b)) * Real(0.5);
    }
    Vec3<Real> area_of_fragment(const WindArea& area) const {
        const auto& fragment = world_.figures[area.figure].fragments[area.fragment];
        std::array<Vec3<double>, 4> corner{};
        for (std::size_t i = 0; i < 4; ++i)
            corner[i] = position_of(
                fragment.corners[i], [&](std::size_t k) { return cast<double>(solid(at(area, k))); }, D == 2);
        double share = 0; // of the cell
        fragment.each_tile([&](std::span<const Vec2<float>> tile) {
            for (std::size_t i = 1; i + 1 < tile.size(); ++i) {
                const auto a = tile[i] - tile[0], b = tile[i + 1] - tile[0];
                share += 0.5 * absolute(double(a[0]) * double(b[1]) - double(a[1]) * double(b[0]));
            }
        });
        return cast<Real>(cross(corner[2] - corner[0], corner[3] - corner[1]) * (0.5 * share));
    }
};

} // namespace

template <int D, class Real> void find_wind_areas(World<D, Real>& world, Solver<D, Real>& solver) {
    const auto blows = [](const Force<D, Real>& force) { return std::holds_alternative<Wind<D, Real>>(force); };
    if (std::none_of(world.forces.begin(), world.forces.end(), blows)) return solver.wind_areas.reset();
    if (!solver.wind_areas) solver.wind_areas = std::make_shared<WindAreas>();
    if (std::exchange(solver.wind_areas->edits, world.journal.edits) == world.journal.edits) return;
    WindAreaFinder<D, Real>(world, *solver.wind_areas).find();
}

template <int D, class Real> void apply_winds(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    const auto& areas = solver.wind_areas;
    find_wind_areas(world, solver);
    if (!areas || areas->list.empty()) return;
    world.particles.any_force = true;
    for (const auto& force : world.forces) {
        const auto* wind = std::get_if<Wind<D, Real>>(&force);
        if (!wind) continue;
        WindPress<D, Real> press(world, *areas, *wind, dt);
        for (const auto& area : areas->list) press.press(area);
    }
}

#define SINEW_WIND(D, Real)                                                                                            \
    template void find_wind_areas(World<D, Real>&, Solver<D, Real>&);                                                  \
    template void apply_winds(World<D, Real>&, Solver<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_WIND)

} // namespace sinew
