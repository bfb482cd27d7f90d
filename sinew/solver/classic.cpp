#include "sinew/solver/free_motion.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/project.h"

#include <algorithm>

/// The originals' own step: points that remember where they were, moved once a frame, and constraints that move points.
/// Rules and their sources are in docs/classic.md.
namespace sinew {
namespace {

/// Constraints act on places, and an end that cannot move leaves its share of the correction undone.
template <int D, class RealT> struct ClassicMover {
    using Real = RealT;
    static constexpr int dimension = D;
    Particles<D, Real>& particles;
    bool first_iteration = true;

    const Vec<D, Real>& point(Row row) const { return particles.position[row]; }
    Real weight(Row row) const { return particles.inverse_mass[row]; }
    Real alpha(Real) const { return Real(0); } // the originals know relaxation, not compliance
    Real most(Real) const { return limit::multiplier<Real>; }
    Real share(Real) const { return Real(0); }
    template <class Stencil> Real ahead(const Stencil&, std::span<const Row>, Real, Real) const { return Real(0); }
    void push(Row row, const Vec<D, Real>& displacement) {
        if (particles.mobility[row] == Real(0)) return;
        particles.position[row] = clamp_components(particles.position[row] + displacement, limit::coordinate<Real>);
    }
    template <class Stencil> void choose_direction(Stencil& stencil, std::span<const Row>) const {
        stencil.direction = stencil.gradient;
    }
};

/// Factors that no original ever had are held where what they multiply stays finite.
template <class Real> ClassicRules<Real> held_in_limits(ClassicRules<Real> rules) {
    constexpr auto most = Real(1e6);
    for (Real* factor : {&rules.keep, &rules.bounce, &rules.floor_keep, &rules.time_scale, &rules.longest_step})
        *factor = clamp(*factor, Real(0), most);
    return rules;
}

template <int D, class Real> class ClassicStep {
  public:
    ClassicStep(World<D, Real>& world, Real dt)
        : world_(world), p_(world.particles), rules_(held_in_limits(world.settings.classic)),
          h_(clamp(minimum(dt, rules_.longest_step * world.settings.frame) * rules_.time_scale, Real(0),
                   limit::step<Real>)),
          mover_{p_} {}

    void run() {
        if (h_ < limit::shortest_step<Real> && !rules_.unscaled_inertia) return; // time stands still
        carry_pins();
        move_limits(world_, h_);
        switch (rules_.order) {
        case PassOrder::sweeps_last:
            for (int i = 0; i < (rules_.points_only_passes ? rules_.passes : 1); ++i) move_all();
            walls();
            for (int i = 0; i < (rules_.points_only_passes ? 1 : rules_.passes); ++i) sweep();
            break;
        case PassOrder::walls_each_pass:
            move_all();
            for (int i = 0; i < rules_.passes; ++i) {
                sweep();
                walls();
            }
            break;
        case PassOrder::interleaved:
            for (int i = 0; i < rules_.passes; ++i) sweep(i == 0);
            walls();
            break;
        }
        let_go();
        read_velocities();
        if (h_ > Real(0)) world_.last_step = world_.last_substep = h_;
    }

  private:
    World<D, Real>& world_;
    Particles<D, Real>& p_;
    const ClassicRules<Real> rules_;
    Real h_;
    ClassicMover<D, Real> mover_;

    /// Held points, however softly: x_prev = x, x = target, and nothing else moves them.
    void carry_pins() {
        for (const auto& pin : world_.pins) {
            const auto row = p_.slots.find(pin.particle);
            if (!row || p_.quarantined[*row]) continue;
            if (rules_.displaced_hold && pin.moves) { // Godot's loop: pushed along, and free all the same
                p_.position[*row] =
                    clamp_components(p_.position[*row] + pin.target - pin.from, limit::coordinate<Real>);
                p_.mobility[*row] = p_.inverse_mass[*row];
                continue;
            }
            p_.previous[*row] = p_.position[*row];
            p_.position[*row] = pin.target;
            p_.mobility[*row] = Real(0);
        }
    }

    /// In physical mode a soft pin lets its particle move.
    void let_go() {
        for (const auto& pin : world_.pins)
            if (const auto row = p_.slots.find(pin.particle); row && !p_.quarantined[*row])
                p_.mobility[*row] = p_.inverse_mass[*row];
        for (const auto& pin : world_.pins)
            if (const auto row = p_.slots.find(pin.particle); row && pin.hard()) p_.mobility[*row] = Real(0);
    }

    /// v = x - x_prev; x_prev = x; x += keep v + a h^2
    void move(Row row) {
        if (p_.mobility[row] == Real(0)) return;
        const Real inertia = rules_.unscaled_inertia ? Real(1) : h_ / verlet_interval(world_);
        const Real share = rules_.halved_acceleration ? Real(0.5) : Real(1);
        const auto velocity = (p_.position[row] - p_.previous[row]) * inertia;
        if (const auto integrator = integrator_of(world_, row); !goes_as_verlet(integrator))
            return integrate(integrator, row, velocity, share);
        const auto push = push_on(world_, row);
        const auto fallen = clamp_components(push.acceleration * (h_ * h_ * share), limit::coordinate<Real>);
        const auto pushed = fallen - velocity * minimum(Real(1), push.drag_rate * h_);
        const auto moved =
            rules_.damp_after_force ? (velocity + pushed) * rules_.keep : velocity * rules_.keep + pushed;
        p_.previous[row] = p_.position[row];
        p_.position[row] = clamp_components(p_.position[row] + moved, limit::coordinate<Real>);
    }

    /// Another integrator: damping takes its share before the step, or after it; x_prev = x - v h.
    void integrate(Integrator integrator, Row row, const Vec<D, Real>& velocity, Real share) {
        const auto gain = [&](const Vec<D, Real>& place, const Vec<D, Real>& change) {
            const auto push = push_on(world_, row, clamp_components(place, limit::coordinate<Real>));
            const auto fallen = clamp_components(push.acceleration * (h_ * h_ * share), limit::coordinate<Real>);
            return fallen - change * minimum(Real(1), push.drag_rate * h_);
        };
        const Real before = rules_.damp_after_force ? Real(1) : rules_.keep;
        const Real after = rules_.damp_after_force ? rules_.keep : Real(1);
        const auto moved = advance(integrator, FreeMotion<Vec<D, Real>>{p_.position[row], velocity * before}, gain);
        p_.position[row] = clamp_components(moved.place, limit::coordinate<Real>);
        p_.previous[row] = clamp_components(p_.position[row] - moved.change * after, limit::coordinate<Real>);
    }

    void move_all() {
        for (Row row = 0; row < p_.size(); ++row) move(row);
    }

    /// The constraints in the order they were added; `moving`: each particle moves just before the first that names it.
    void sweep(bool moving = false) {
        if (moving) std::fill(p_.rebound.begin(), p_.rebound.end(), Vec<D, Real>{}); // marks who has moved
        std::array<Row, std::size_t(Kinds<D>::size)> next{};
        for (const auto& run : world_.sweep)
            visit_table(world_, run.kind, [&](auto& table) {
                auto& row = next[std::size_t(run.kind)];
                for (const Row end = row + run.count; row < end; ++row) {
                    if (moving)
                        for (const Row member : std::as_const(table.members)[row]) move_once(member);
                    project(table, row);
                }
            });
        if (moving)
            for (Row row = 0; row < p_.size(); ++row) move_once(row);
        mover_.first_iteration = false;
    }

    void move_once(Row row) {
        if (p_.rebound[row][0] != Real(0)) return;
        p_.rebound[row][0] = Real(1);
        move(row);
    }

    template <class Table> void project(Table& table, Row row) {
        if constexpr (std::is_same_v<typename Table::Kind, Distance<D>>)
            if (rules_.root_free) return project_without_root(table, row);
        table.multiplier[row] = Real(0); // each pass starts from where the points are
        detail::project_row(world_, table, row, mover_);
    }

    /// s = r^2/(d^2 + r^2) - 1/2 approximates half the relative error without a square root (Jakobsen 2001).
    template <class Table> void project_without_root(Table& table, Row row) {
        const auto ends = std::as_const(table.members)[row];
        const auto ab = p_.position[ends[1]] - p_.position[ends[0]];
        const Real squared = dot(ab, ab);
        constexpr Real most = limit::coordinate<Real>;
        const Real rest = square_root(clamp(squared, square(clamp(table.low(row), Real(0), most)),
                                            square(clamp(table.high(row), Real(0), most))));
        const Real s = rest * rest * inverse_or_zero(squared + rest * rest) - Real(0.5);
        const auto both = ab * (Real(2) * s * table.relaxation[row]);
        mover_.push(ends[0], -both * table.split[row]);
        mover_.push(ends[1], both * (Real(1) - table.split[row]));
    }

    void walls() {
        for (const auto& plane : world_.bounds)
            for (Row row = 0; row < p_.size(); ++row)
                if (p_.mobility[row] > Real(0)) hit(plane, row);
    }

    /// Put back on the wall; with a bounce, x_prev is mirrored so that the speed turns round.
    void hit(const HalfSpace<D, Real>& plane, Row row) {
        const Real depth = plane.offset + p_.radius[row] - dot(plane.normal, p_.position[row]);
        if (depth < Real(0)) return;
        const auto velocity = p_.position[row] - p_.previous[row];
        p_.position[row] = clamp_components(p_.position[row] + plane.normal * depth, limit::coordinate<Real>);
        if (rules_.bounce == Real(0) && rules_.floor_keep == Real(1)) return;
        const Real approach = -dot(plane.normal, velocity);
        if (approach < Real(0)) return;
        const auto along = velocity + plane.normal * approach;
        const Real away = approach * rules_.bounce;
        const auto leaving = plane.normal * (faces_wrong_way(plane) ? -away : away);
        p_.previous[row] = p_.position[row] - leaving - along * (is_floor(plane, away) ? rules_.floor_keep : Real(1));
    }

    /// Roblox's walls at the top and the right have the wrong sign.
    bool faces_wrong_way(const HalfSpace<D, Real>& plane) const {
        return rules_.outward_bounce && (plane.normal[0] < Real(0) || dot(plane.normal, gravity()) > Real(0));
    }

    /// Resting on the floor: it holds against gravity and what bounces back is gone within the next frame.
    bool is_floor(const HalfSpace<D, Real>& plane, Real away) const {
        const Real pull = -dot(plane.normal, gravity()) * h_ * h_;
        return pull > Real(0) && away <= pull;
    }

    Vec<D, Real> gravity() const {
        Vec<D, Real> sum{};
        for (const auto& force : world_.forces)
            if (const auto* gravity = std::get_if<Gravity<D, Real>>(&force))
                sum += clamp_components(gravity->acceleration, limit::measure<Real>);
        return sum;
    }

    /// For those who ask: classic mode itself lives on x and x_prev.
    void read_velocities() {
        const Real per_h = inverse_or_zero(h_);
        for (Row row = 0; row < p_.size(); ++row) {
            const auto velocity = (p_.position[row] - p_.previous[row]) * per_h;
            p_.velocity[row] = clamp_components(velocity, limit::speed<Real>);
        }
    }
};

} // namespace

template <int D, class Real> void classic_step(World<D, Real>& world, Real dt) {
    if (!world.settings.classic.dropped_leftover) return ClassicStep<D, Real>(world, dt).run();
    constexpr Real tick_share = Real(0.96); // 16 ms of a frame
    constexpr int most_ticks = 1000;
    const Real tick = tick_share * world.settings.frame;
    const Real whole = clamp(dt * inverse_or_zero(tick) + Real(1e-4), Real(0), Real(most_ticks));
    for (int left = int(whole); left > 0; --left) ClassicStep<D, Real>(world, tick).run();
}

#define SINEW_CLASSIC(D, Real) template void classic_step(World<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_CLASSIC)

} // namespace sinew
