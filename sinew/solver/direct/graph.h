#pragma once

#include "sinew/world/constraint_graph.h"

/// Constraints eligible for blocks, by particle.
namespace sinew::detail {

template <int D, class Real> class BlockGraph {
  public:
    explicit BlockGraph(const World<D, Real>& world)
        : world_(world), particles_(world.particles), distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          angles_(std::get<kind_number<Angle, D>>(world.constraints)),
          pulleys_(std::get<kind_number<Pulley, D>>(world.constraints)) {}

    const Constraints<Distance<D>, Real>& distances() const { return distances_; }
    const Constraints<Angle<D>, Real>& angles() const { return angles_; }
    const Constraints<Pulley<D>, Real>& pulleys() const { return pulleys_; }

    /// Calls visit(table) with the tetrahedra that limit folds; there are none in the plane.
    template <class Visit> void with_volumes(Visit&& visit) const {
        if constexpr (D == 3) visit(std::get<kind_number<Volume, D>>(world_.constraints));
    }
    /// True for a tetrahedron that limits a joint: rigid at both limits, no jelly.
    template <class Table> static bool is_fold(const Table& table, Row row) {
        return natural(table, row) && table.is_rigid(row) && !is_driven(table, row) &&
               table.low(row) < table.high(row) && fold_unit(table, row) > 0;
    }
    /// Larger limit, m^3; 0 if either is infinite.
    template <class Table> static double fold_unit(const Table& table, Row row) {
        const double largest = max(absolute(double(table.low(row))), absolute(double(table.high(row))));
        return largest < double(limit::coordinate<Real>) ? largest : 0;
    }

    bool mobile(Row particle) const { return particles_.mobility[particle] > Real(0); }

    /// Mass of a movable particle, kg; 0 for others.
    double mass_of(Row particle) const { return inverse_or_zero(double(particles_.mobility[particle])); }
    /// Mass at the movable end of a link, kg.
    double mass_at_end(Row link) const { return mass_of(end(link, mobile(end(link, 0)) ? 0 : 1)); }

    /// Calls visit(row) for each constraint of a particle of the kind of `table`, in order.
    template <class Table, class Visit> void each(const Table& table, Row particle, Visit&& visit) const {
        for_each_row(world_, table, particle, visit);
    }

    Row end(Row link, std::size_t i) const { return distances_.members.rows[link][i]; }
    Row other_end(Row link, Row particle) const { return end(link, 0) == particle ? end(link, 1) : end(link, 0); }

    /// True for a link of positive length: zero length has no direction. Driven limits count as positive: values change
    /// from step to step, and the choice of solver must not depend on when the blocks were found.
    bool has_length(Row link) const { return is_driven(distances_, link) || distances_.high(link) >= Real(1e-6); }

    /// True for the default split and relaxation; other values are meant for the sweep.
    template <class Table> static bool natural(const Table& table, Row row) {
        return table.split[row] == Real(0.5) && table.relaxation[row] == Real(1);
    }
    template <class Table> static bool is_driven(const Table& table, Row row) {
        return table.motorized[row] || table.gives(row);
    }
    /// True for a 3D angle with a positive lower limit: an unsigned angle of zero has no direction to open in. A driven
    /// lower limit may become positive.
    static bool opens(const Constraints<Angle<D>, Real>& table, Row row) {
        const Real min = table.motorized[row] ? -limit::measure<Real> : Real(0);
        return D == 3 && table.low(row) > min;
    }

    /// True for a rigid link: neither a spring nor a motor.
    bool is_stick(Row link) const {
        return distances_.is_rigid(link) && natural(distances_, link) && has_length(link) &&
               !is_driven(distances_, link);
    }

    /// True for a constraint allowed in a block with ports.
    template <class Table> bool is_rigid(const Table& table, Row row) const {
        using Kind = typename Table::Kind;
        if constexpr (std::is_same_v<Kind, Distance<D>>) return is_stick(row);
        if constexpr (std::is_same_v<Kind, Angle<D>>)
            return table.is_rigid(row) && natural(table, row) && !is_driven(table, row) && !opens(table, row);
        return false;
    }

    /// True for a rigid link, by which a tree may hang on the rest of the world.
    bool may_hang(Row link) const {
        return is_stick(link) && direct_of(end(link, 0)) != Direct::off && direct_of(end(link, 1)) != Direct::off;
    }

    Direct direct_of(Row particle) const {
        const auto figure = particles_.figure[particle];
        if (figure >= world_.figures.size()) return Direct::automatic;
        return particles_.near[particle] ? Direct::off : world_.figures[figure].direct;
    }

  private:
    const World<D, Real>& world_;
    const Particles<D, Real>& particles_;
    const Constraints<Distance<D>, Real>& distances_;
    const Constraints<Angle<D>, Real>& angles_;
    const Constraints<Pulley<D>, Real>& pulleys_;
};

} // namespace sinew::detail
