#pragma once

#include "sinew/assert/assert.h"
#include "sinew/math/record.h"
#include "sinew/math/trig.h"
#include "sinew/prefab/problem.h"
#include "sinew/world/edit.h"

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A figure under construction in a world. A prefab works in a frame of its own: x right, y up, lengths already in the
/// world's unit (metres by default). The builder transforms the frame into the world by a `Placement`.
namespace sinew {

/// Transform from a figure's frame to the world: origin and rotation; `up` is -1 in worlds whose y axis points down.
template <int D, class Real> struct Placement {
    Vec<D, Real> at{};
    double turn = 0; ///< radians, counter-clockwise on screen; about z in 3D
    int up = 1;

    Vec<D, Real> to_world(const Vec<D, double>& local) const { return Frame(*this).to_world(local); }

    /// The same transform with sine and cosine evaluated once, for many points.
    class Frame {
      public:
        explicit Frame(const Placement& placement)
            : at_(placement.at), cosine_(cosine(placement.turn)), sine_(sine(placement.turn)), up_(placement.up) {}

        Vec<D, Real> to_world(const Vec<D, double>& local) const { return at_ + cast<Real>(turned(local)); }
        /// Rounding error of `to_world`. Kept with the particle, because a link shorter than the resolution of float at
        /// its position would otherwise begin slack or stretched.
        Vec<D, Real> residual(const Vec<D, double>& local) const {
            return cast<Real>(cast<double>(at_) + turned(local) - cast<double>(to_world(local)));
        }

      private:
        Vec<D, Real> at_;
        double cosine_, sine_;
        int up_;

        Vec<D, double> turned(const Vec<D, double>& local) const {
            auto rotated = local;
            rotated[0] = cosine_ * local[0] - sine_ * local[1];
            rotated[1] = (sine_ * local[0] + cosine_ * local[1]) * up_;
            return rotated;
        }
    };
};

/// A point in the plane of the screen, in any dimension.
template <int D> constexpr Vec<D, double> on_screen(double x, double y) {
    Vec<D, double> position;
    position[0] = x;
    position[1] = y;
    return position;
}

/// True if mirroring flips the sign of a measure: signed angles, areas in 2D, volumes in 3D, and kinds that declare
/// `sided`.
template <class Kind, int D> inline constexpr bool mirrors = Kind::period > 0 || Kind::length_power == D || requires {
    Kind::sided;
};

template <int D, class RealT> class Builder {
  public:
    using Real = RealT;
    using Local = Vec<D, double>;
    static constexpr int dimension = D;

    Builder(World<D, Real>& world, FigureIndex figure, const Placement<D, Real>& placement, Mode mode)
        : world_(world), figure_(figure), placement_(placement), frame_(placement), mode_(mode),
          first_(Row(world.particles.size())) {
        SINEW_ASSERT(has_figure(world, figure), "the figure has been added");
    }

    /// Mode of the world. A prefab may build one rig for classic mode (equal masses, hidden supports) and another for
    /// physical mode.
    Mode mode() const { return mode_; }
    Figure& figure() { return world_.figures[figure_]; }

    /// Adds a particle at a point of the prefab's frame. An empty name leaves the particle nameless. Classic mode sets
    /// the mass to 1 and the radius to 0, as the original demos do.
    ParticleId particle(std::string_view name, const Local& local, double mass, double radius = 0) {
        const bool classic = mode_ == Mode::classic;
        return weighed_particle(name, local, classic ? 1 : mass, classic ? 0 : radius);
    }

    /// Adds a particle with its mass and radius in every mode, for the few originals that give points a mass and a
    /// size.
    ParticleId weighed_particle(std::string_view name, const Local& local, double mass, double radius = 0) {
        const auto id = add_particle(
            world_,
            {.position = frame_.to_world(local), .mass = Real(mass), .radius = Real(radius), .figure = figure_});
        if (mode_ == Mode::physical) world_.particles.residual.back() = frame_.residual(local);
        locals_.push_back(local);
        figure().particles.push_back(id);
        if (!name.empty()) figure().particle_names.emplace_back(name, id);
        return id;
    }

    /// Way in which a ball rolls.
    struct Rolling {
        double inertia = solid_inertia<D>; ///< as a share of mass times radius^2
        double spin = 0;                   ///< angular velocity, counter-clockwise on screen; in 3D about z
    };
    /// Adds a particle that rolls, whatever holds it; in classic mode a particle as others are.
    ParticleId ball(std::string_view name, const Local& local, double mass, double radius, const Rolling& rolling) {
        const auto id = particle(name, local, mass, radius);
        auto& p = world_.particles;
        const auto row = p.size() - 1;
        p.rolls.set(row, Rolls::always);
        p.inertia.set(row, Real(rolling.inertia));
        p.spin.set(row, Vec<spins<D>, Real>::axis(spins<D> - 1) * Real(rolling.spin * placement_.up));
        return id;
    }

    /// Particle of a given name. The name must belong to the figure.
    ParticleId named(std::string_view name) {
        SINEW_ASSERT(figure().particle_names.find(name).has_value(), "the name belongs to the figure");
        return figure().particle_names.find(name).value_or(ParticleId{});
    }

    /// Measure of a constraint kind in the prefab's frame.
    template <template <int> class KindOf> double measure(std::span<const ParticleId> members) const {
        using Kind = KindOf<D>;
        if constexpr (Kind::arity == any_arity) {
            std::vector<Local> points, gradient(members.size());
            for (const auto id : members) points.push_back(local(id));
            return Kind::evaluate(std::span<const Local>(points), std::span(gradient));
        } else {
            Points<Kind::arity, D, double> points{};
            for (std::size_t i = 0; i < points.size() && i < members.size(); ++i) points[i] = local(members[i]);
            return Kind::evaluate(points).value;
        }
    }

    /// Adds a constraint between particles of the figure; without limits, at its present measure. Limits and measures
    /// refer to the prefab's frame in double precision, so a figure has identical rest lengths at every position.
    template <template <int> class Kind>
    void constrain(std::string_view name, std::initializer_list<ParticleId> members, ConstraintSpec<double> spec = {}) {
        constrain<Kind>(name, std::span(members.begin(), members.size()), spec);
    }
    template <template <int> class Kind>
    void constrain(std::string_view name, std::span<const ParticleId> members, ConstraintSpec<double> spec = {}) {
        const auto limits = spec.limits ? *spec.limits : exactly(measure<Kind>(members));
        const auto id = add_constraint(world_, kind_number<Kind, D>, members, in_world<Kind>(spec, limits));
        if (!id) return;
        figure().constraints.push_back(*id);
        if (!name.empty()) figure().constraint_names.emplace_back(name, *id);
    }

    /// Adds many nameless distances with the same limits.
    void link(std::span<const std::array<ParticleId, 2>> ends, const ConstraintSpec<double>& spec) {
        SINEW_ASSERT(spec.limits.has_value(), "many distances have limits of their own");
        add_distances(world_, ends, in_world<Distance>(spec, *spec.limits), figure().constraints);
    }

    /// Names the next `count` particles stem_0, stem_1, ..., or stem_COLUMN_ROW where `columns` is not 0.
    void number_particles(std::string_view stem, std::size_t count, std::size_t columns = 0) {
        figure().particle_numbers.push_back({std::string(stem), figure().particles.size(), count, columns});
    }
    void number_constraints(std::string_view stem, std::size_t count, std::size_t columns = 0) {
        figure().constraint_numbers.push_back({std::string(stem), figure().constraints.size(), count, columns});
    }

    void hold(ParticleId id) { pin(world_, id); }

    /// Adds a drawn piece; `width` in world units, 0: taken from the looks.
    void draw(Mark mark, std::string_view part, std::vector<ParticleId> particles, double width = 0,
              bool hidden = false) {
        figure().pieces.push_back({mark, std::string(part), std::move(particles), width, 0, hidden});
    }

    /// Adds a stroke or limb that tapers from `width` to `end_width`.
    void draw_tapered(Mark mark, std::string_view part, std::vector<ParticleId> particles, double width,
                      double end_width) {
        figure().pieces.push_back({mark, std::string(part), std::move(particles), width, end_width, false});
    }

  private:
    template <template <int> class Kind>
    ConstraintSpec<Real> in_world(const ConstraintSpec<double>& spec, Interval<double> limits) const {
        if (mirrors<Kind<D>, D> && placement_.up < 0) limits = {-limits.high, -limits.low};
        auto made = cast<Real>(spec);
        made.limits = cast<Real>(limits);
        made.figure = figure_;
        return made;
    }

    /// Position of a particle in the prefab's frame. Rows are consecutive while a figure is built: nothing is removed.
    const Local& local(ParticleId id) const {
        const Row row = row_of(world_, id).value_or(first_);
        SINEW_ASSERT(row >= first_ && row - first_ < locals_.size(), "the particle belongs to the figure");
        return locals_[row - first_];
    }

    World<D, Real>& world_;
    FigureIndex figure_;
    Placement<D, Real> placement_;
    typename Placement<D, Real>::Frame frame_;
    Mode mode_;
    Row first_;
    std::vector<Local> locals_;
};

/// A figure that build() has added, or the fault of the parameters; nothing is added then.
struct Built {
    FigureIndex figure = no_figure;
    std::string problem{}; ///< empty if there is none

    explicit operator bool() const { return figure != no_figure; }
    operator FigureIndex() const { return figure; }
};

/// Adds a figure whose parameters are known to be right.
template <class Prefab, int D, class Real>
requires(Prefab::dimensions.include(D)) FigureIndex
    build_checked(World<D, Real>& world, const Prefab& prefab, std::string_view name,
                  const Placement<D, Real>& placement = {}) {
    const auto figure = add_figure(world, name, Prefab::name);
    const auto sizes = prefab.sizes();
    if (sizes.particles > world.particles.size())
        reserve(world, sizes); // with many small figures, each reservation would copy the whole world
    Builder<D, Real> builder(world, figure, placement, world.settings.mode);
    prefab.build(builder);
    return figure;
}

/// Adds a figure to a world: build(world, Rope{.length = 3}, "rope", {.at = {{1, 2}}}). Returns the index of the
/// figure, or the fault: a number out of the range of its field, an unknown word, more particles than a world can
/// have. Angles are in radians.
template <class Prefab, int D, class Real>
requires(Prefab::dimensions.include(D)) Built build(World<D, Real>& world, const Prefab& prefab, std::string_view name,
                                                    const Placement<D, Real>& placement = {}) {
    if (auto problem = problem_of_all(prefab, D)) return {no_figure, std::move(*problem)};
    return {build_checked(world, prefab, name, placement)};
}

} // namespace sinew
