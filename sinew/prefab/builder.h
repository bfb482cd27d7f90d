#pragma once

#include "sinew/math/record.h"
#include "sinew/math/trig.h"
#include "sinew/solver/edit.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

/// What prefabs build with: a figure under construction in a world. A prefab works in its own frame (x right, y up,
/// metres by default); the builder places it: scaled units are already in the parameters, `Placement` turns and moves.
namespace sinew {

/// Where a figure stands: its frame's origin and a turn about it; `up` is -1 in worlds whose y axis points down.
template <int D, class Real> struct Placement {
    Vec<D, Real> at{};
    double turn = 0; ///< radians, counter-clockwise as seen on screen; about z in 3D
    int up = 1;

    Vec<D, Real> place(const Vec<D, double>& local) const { return Frame(*this).place(local); }

    /// The same, for many places.
    class Frame {
      public:
        explicit Frame(const Placement& placement)
            : at_(placement.at), cosine_(cosine(placement.turn)), sine_(sine(placement.turn)), up_(placement.up) {}

        Vec<D, Real> place(const Vec<D, double>& local) const { return at_ + cast<Real>(turned(local)); }
        /// What rounding takes from it: links shorter than a float's grain is fine would begin slack or stretched.
        Vec<D, Real> residual(const Vec<D, double>& local) const {
            return cast<Real>(cast<double>(at_) + turned(local) - cast<double>(place(local)));
        }

      private:
        Vec<D, Real> at_;
        double cosine_, sine_;
        int up_;

        Vec<D, double> turned(const Vec<D, double>& local) const {
            auto place = local;
            place[0] = cosine_ * local[0] - sine_ * local[1];
            place[1] = (sine_ * local[0] + cosine_ * local[1]) * up_;
            return place;
        }
    };
};

/// A place in the plane of the screen, in any dimension.
template <int D> constexpr Vec<D, double> on_screen(double x, double y) {
    Vec<D, double> place;
    place[0] = x;
    place[1] = y;
    return place;
}

/// A breaking strain as prefabs take it, where 0 means that nothing tears.
inline double tears_beyond(double strain) {
    return strain > 0 ? strain : std::numeric_limits<double>::infinity();
}

/// How slowly something tears that has a breaking strain.
inline constexpr Field toughness_field{.name = "toughness",
                                       .help = "Strain beyond breaking_strain, times time, that it bears before it "
                                               "tears: 0.1 is a tenth too far for a second; 0 tears at once",
                                       .unit = unit::time,
                                       .low = 0,
                                       .high = 1e6};

/// Whether a measure changes its sign in a mirror: signed angles do, and areas in the plane, and volumes in space, and
/// what says so.
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
          first_(Row(world.particles.size())) {}

    /// Prefabs may build a classic rig (equal masses, hidden beams) and a physical one.
    Mode mode() const { return mode_; }
    Figure& figure() { return world_.figures[figure_]; }

    /// A particle at a place of the prefab's frame. An empty name leaves it nameless. The originals of classic mode
    /// know points, all alike: there the mass is 1 and the radius 0.
    ParticleId particle(std::string_view name, const Local& local, double mass, double radius = 0) {
        const bool classic = mode_ == Mode::classic;
        return weighed_particle(name, local, classic ? 1 : mass, classic ? 0 : radius);
    }

    /// The same for the few originals that did weigh their points, and gave them a size.
    ParticleId weighed_particle(std::string_view name, const Local& local, double mass, double radius = 0) {
        const auto id = add_particle(
            world_, {.position = frame_.place(local), .mass = Real(mass), .radius = Real(radius), .figure = figure_});
        if (mode_ == Mode::physical) world_.particles.residual.back() = frame_.residual(local);
        locals_.push_back(local);
        figure().particles.push_back(id);
        if (!name.empty()) figure().particle_names.emplace_back(name, id);
        return id;
    }

    /// The particle of that name. Prefabs only ask for names they gave.
    ParticleId named(std::string_view name) { return figure().particle_names.find(name).value_or(ParticleId{}); }

    /// What a kind measures in the prefab's frame.
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

    /// A constraint between particles of the figure; without limits, exactly as they stand. Limits are meant in the
    /// prefab's frame, and so is what is measured: a figure has the same lengths wherever it stands, to the last digit.
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

    /// Many distances of the same limits, all nameless.
    void link(std::span<const std::array<ParticleId, 2>> ends, const ConstraintSpec<double>& spec) {
        add_distances(world_, ends, in_world<Distance>(spec, *spec.limits), figure().constraints);
    }

    /// The next `count` particles are called stem_0, stem_1, ...; in rows of `columns`, stem_COLUMN_ROW.
    void number_particles(std::string_view stem, std::size_t count, std::size_t columns = 0) {
        figure().particle_numbers.push_back({std::string(stem), figure().particles.size(), count, columns});
    }
    void number_constraints(std::string_view stem, std::size_t count, std::size_t columns = 0) {
        figure().constraint_numbers.push_back({std::string(stem), figure().constraints.size(), count, columns});
    }

    void hold(ParticleId id) { pin(world_, id); }

    /// A drawn piece: `width` in world units, 0 leaves it to the looks.
    void draw(Mark mark, std::string_view part, std::vector<ParticleId> particles, double width = 0,
              bool hidden = false) {
        figure().pieces.push_back({mark, std::string(part), std::move(particles), width, 0, hidden});
    }

    /// A stroke or limb as wide as `width` where it begins, as `end_width` where it ends.
    void draw_tapered(Mark mark, std::string_view part, std::vector<ParticleId> particles, double width,
                      double end_width) {
        figure().pieces.push_back({mark, std::string(part), std::move(particles), width, end_width, false});
    }

  private:
    template <template <int> class Kind>
    ConstraintSpec<Real> in_world(const ConstraintSpec<double>& spec, Interval<double> limits) const {
        if (mirrors<Kind<D>, D> && placement_.up < 0) limits = {-limits.high, -limits.low};
        return {.limits = Interval<Real>{Real(limits.low), Real(limits.high)},
                .compliance = Real(spec.compliance),
                .relaxation = Real(spec.relaxation),
                .split = Real(spec.split),
                .breaking_strain = Real(spec.breaking_strain),
                .toughness = Real(spec.toughness),
                .figure = figure_};
    }

    /// Rows are given out in order, and nothing is removed while a figure is built.
    const Local& local(ParticleId id) const { return locals_[row_of(world_, id).value_or(first_) - first_]; }

    World<D, Real>& world_;
    FigureIndex figure_;
    Placement<D, Real> placement_;
    typename Placement<D, Real>::Frame frame_;
    Mode mode_;
    Row first_;
    std::vector<Local> locals_;
};

/// Adds a figure to a world: build(world, Rope{.length = 3}, "rope", {.at = {{1, 2}}}).
template <class Prefab, int D, class Real>
requires(Prefab::dimensions.include(D)) FigureIndex
    build(World<D, Real>& world, const Prefab& prefab, std::string_view name,
          const Placement<D, Real>& placement = {}) {
    const auto figure = add_figure(world, name, Prefab::name);
    const auto sizes = prefab.sizes();
    if (sizes.particles > world.particles.size())
        reserve(world, sizes); // of many small ones each would move all before
    Builder<D, Real> builder(world, figure, placement, world.settings.mode);
    prefab.build(builder);
    return figure;
}

} // namespace sinew
