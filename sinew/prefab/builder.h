#pragma once

#include "sinew/math/record.h"
#include "sinew/math/trig.h"
#include "sinew/solver/edit.h"

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

    Vec<D, Real> place(const Vec<D, double>& local) const {
        const double c = cosine(turn), s = sine(turn);
        auto turned = local;
        turned[0] = c * local[0] - s * local[1];
        turned[1] = (s * local[0] + c * local[1]) * up;
        return at + cast<Real>(turned);
    }
};

template <int D, class RealT> class Builder {
  public:
    using Real = RealT;
    static constexpr int dimension = D;

    Builder(World<D, Real>& world, FigureIndex figure, const Placement<D, Real>& placement, Mode mode)
        : world_(world), figure_(figure), placement_(placement), mode_(mode) {}

    /// Prefabs may build a classic rig (equal masses, hidden beams) and a physical one.
    Mode mode() const { return mode_; }
    Figure& figure() { return world_.figures[figure_]; }
    World<D, Real>& world() { return world_; }

    /// A particle at a place of the prefab's frame. An empty name leaves it nameless.
    ParticleId particle(std::string_view name, const Vec<D, double>& local, double mass = 1, double radius = 0) {
        const auto id = add_particle(
            world_,
            {.position = placement_.place(local), .mass = Real(mass), .radius = Real(radius), .figure = figure_});
        figure().particles.push_back(id);
        if (!name.empty()) figure().particle_names.emplace_back(name, id);
        return id;
    }

    /// A constraint between particles of the figure; without limits, exactly as they stand.
    template <template <int> class Kind>
    void constrain(std::string_view name, std::initializer_list<ParticleId> members, ConstraintSpec<Real> spec = {}) {
        constrain<Kind>(name, std::span(members.begin(), members.size()), spec);
    }
    template <template <int> class Kind>
    void constrain(std::string_view name, std::span<const ParticleId> members, ConstraintSpec<Real> spec = {}) {
        spec.figure = figure_;
        const auto id = add_constraint(world_, kind_number<Kind, D>, members, spec);
        if (!id) return;
        figure().constraints.push_back(*id);
        if (!name.empty()) figure().constraint_names.emplace_back(name, *id);
    }

    void hold(ParticleId id) { pin(world_, id); }

    /// A drawn piece: `width` in world units, 0 leaves it to the looks.
    void draw(Mark mark, std::string_view part, std::vector<ParticleId> particles, double width = 0,
              bool hidden = false) {
        figure().pieces.push_back({mark, std::string(part), std::move(particles), width, hidden});
    }

  private:
    World<D, Real>& world_;
    FigureIndex figure_;
    Placement<D, Real> placement_;
    Mode mode_;
};

} // namespace sinew
