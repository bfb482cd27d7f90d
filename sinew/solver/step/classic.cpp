#include "sinew/collide/moving_collider.h"
#include "sinew/solver/contact/collider_sweep.h"
#include "sinew/solver/contact/contact_law.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/project.h"
#include "sinew/solver/step/classic_polygons.h"
#include "sinew/solver/step/free_motion.h"

#include <algorithm>
#include <limits>

/// Step of classic mode, as in the originals: points with a previous position, moved once a frame, and constraints
/// acting on points. Rules and sources are in docs/how/classic.md.
namespace sinew {
namespace {

/// Constraints act on positions; the share of an immovable end is lost.
template <int D, class RealT> struct ClassicMover {
    using Real = RealT;
    static constexpr int dimension = D;
    Particles<D, Real>& particles;
    bool first_iteration = true;

    const Vec<D, Real>& point(Row row) const { return particles.position[row]; }
    Real weight(Row row) const { return particles.inverse_mass[row]; }
    Real alpha(Real) const { return Real(0); } // the originals know relaxation only
    Real max_multiplier(Real) const { return limit::multiplier<Real>; }
    Real share(Real) const { return Real(0); }
    template <class Stencil> Real ahead(const Stencil&, std::span<const Row>, Real, Real) const { return Real(0); }
    void displace(Row row, const Vec<D, Real>& displacement) {
        if (particles.mobility[row] == Real(0)) return;
        particles.position[row] = clamp_components(particles.position[row] + displacement, limit::coordinate<Real>);
    }
    template <class Stencil> void choose_direction(Stencil& stencil, std::span<const Row>) const {
        stencil.direction = stencil.gradient;
    }
};

/// Bounds factors which no original had, to keep products finite.
template <class Real> ClassicRules<Real> held_in_limits(ClassicRules<Real> rules) {
    constexpr auto max = Real(1e6);
    for (Real* factor : {&rules.keep, &rules.bounce, &rules.floor_keep, &rules.time_scale, &rules.longest_step})
        *factor = clamp(*factor, Real(0), max);
    return rules;
}

/// Walls of classic mode: planes, and colliders as planes at each contact.
template <int D, class Real> class ClassicWalls {
  public:
    ClassicWalls(World<D, Real>& world, ColliderTouches<D, Real>& touches, const ContactFilter& filter,
                 const ClassicRules<Real>& rules, Real h)
        : world_(world), p_(world.particles), touches_(touches), filter_(filter), rules_(rules), h_(h) {}

    /// Moves particles back onto planes and colliders.
    void keep_in() {
        const bool lists = lists_planes(world_);
        for (std::size_t i = 0; i < world_.bounds.size(); ++i)
            for (Row row = 0; row < p_.size(); ++row)
                if (p_.mobility[row] > Real(0) && strikes(world_.bounds[i], row) && hit(world_.bounds[i], row) && lists)
                    touches_.add(row, std::uint32_t(world_.colliders.size() + i), Real(0));
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) hit(world_.colliders[i], i);
    }

  private:
    World<D, Real>& world_;
    Particles<D, Real>& p_;
    ColliderTouches<D, Real>& touches_;
    const ContactFilter& filter_;
    const ClassicRules<Real>& rules_;
    Real h_;

    /// The program's answer; walls of classic mode have no friction or bounce of their own.
    bool is_admitted(const HalfSpace<D, Real>& plane, Row row, Row collider = PendingContact::none) const {
        if (!filter_) return true;
        const auto moved = p_.position[row] - p_.previous[row];
        PendingContact contact{.particle = row,
                               .collider = collider,
                               .gap = -double(plane.depth_of(p_.previous[row], p_.radius[row])),
                               .speed = -double(dot(plane.normal, moved) * inverse_or_zero(h_))};
        contact.set_normal(plane.normal);
        return filter_.ask(contact);
    }

    /// A collider is a wall at each contact, where it will be at the end of the step.
    void hit(const collide::Collider<D, Real>& collider, std::uint32_t index) {
        const collide::Cover<D, Real, Real> nothing({}, {}, Real(1), {}); // as in the originals
        const collide::MovingCollider<D, Real> moving(collider, Real(1), Real(1), Real(0), nothing);
        for (Row row = 0; row < p_.size(); ++row) {
            if (!(p_.mobility[row] > Real(0)) || !touch(collider.filter, detail::filter_of(world_, row))) continue;
            moving.contacts(p_.previous[row], p_.position[row], p_.radius[row], [&](const auto& contact) {
                const auto& surface = contact.surface;
                const HalfSpace<D, Real> plane{surface.normal, dot(surface.normal, surface.point)};
                if (!is_admitted(plane, row, index)) return;
                touches_.add(row, index, Real(0));
                if (!collider.is_sensor) hit(plane, row);
            });
        }
    }

    /// True for a particle behind a plane whose contact acts.
    bool strikes(const HalfSpace<D, Real>& plane, Row row) const {
        return plane.depth_of(p_.position[row], p_.radius[row]) > grain(plane, row) && is_admitted(plane, row);
    }

    /// Moves a particle back onto a wall; false if it was not behind it. With a bounce, x_prev is mirrored: the normal
    /// velocity is reversed, whatever its sign.
    bool hit(const HalfSpace<D, Real>& plane, Row row) {
        const auto& position = p_.position[row];
        const Real depth = plane.depth_of(position, p_.radius[row]);
        if (depth <= grain(plane, row)) return false;
        const auto velocity = position - p_.previous[row];
        p_.position[row] = clamp_components(position + plane.normal * depth, limit::coordinate<Real>);
        if (rules_.bounce == Real(0) && rules_.floor_keep == Real(1)) return true;
        const detail::RelativeMotion<D, Real> motion(plane.normal, velocity);
        const Real away = motion.approach * rules_.bounce;
        const auto leaving = plane.normal * (faces_wrong_way(plane) ? -away : away);
        const Real kept = is_floor(plane, away) ? rules_.floor_keep : Real(1);
        p_.previous[row] = p_.position[row] - leaving - motion.along * kept;
        return true;
    }

    /// Rounding error of a depth: a particle on the wall is not struck again.
    Real grain(const HalfSpace<D, Real>& plane, Row row) const {
        Real size = absolute(plane.offset) + p_.radius[row];
        for (int i = 0; i < D; ++i) size += absolute(plane.normal[i] * p_.position[row][i]);
        return Real(4) * std::numeric_limits<Real>::epsilon() * size;
    }

    /// Roblox's walls at the top and the right have the wrong sign.
    bool faces_wrong_way(const HalfSpace<D, Real>& plane) const {
        return rules_.outward_bounce && (plane.normal[0] < Real(0) || dot(plane.normal, gravity()) > Real(0));
    }

    /// Resting on the floor: gravity presses against the plane, and the rebound is no faster than a frame's fall.
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
};

template <int D, class Real> class ClassicStep {
  public:
    ClassicStep(World<D, Real>& world, Solver<D, Real>& solver, Real dt)
        : world_(world), scratch_(solver.scratch), stays_(solver.stays), p_(world.particles),
          rules_(held_in_limits(world.settings.classic)),
          h_(clamp(min(dt, rules_.longest_step * world.settings.frame) * rules_.time_scale, Real(0),
                   limit::step<Real>)),
          mover_{p_}, walls_(world, solver.touches, solver.options.contact_filter, rules_, h_) {}

    void run() {
        if (h_ < limit::shortest_step<Real> && !rules_.unscaled_inertia) return; // time stands still
        stays_.assign(p_.size(), 0);
        carry_pins();
        move_limits(world_, h_);
        const int moves = rules_.points_only_passes ? rules_.passes : 1;
        const int sweeps = rules_.points_only_passes ? 1 : rules_.passes;
        if (rules_.moves_each_pass)
            for (int i = 0; i < sweeps; ++i) move_and_sweep(moves, 1);
        else
            move_and_sweep(moves, sweeps);
        if (rules_.order == PassOrder::walls_last) walls_.keep_in();
        let_go();
        read_velocities();
        if (h_ > Real(0)) world_.last_step = world_.last_substep = h_;
    }

  private:
    World<D, Real>& world_;
    std::span<Vec<D, Real>> scratch_;
    std::vector<char>& stays_; ///< by row: neither moved by forces nor by velocity in this frame
    Particles<D, Real>& p_;
    const ClassicRules<Real> rules_;
    Real h_;
    ClassicMover<D, Real> mover_;
    ClassicWalls<D, Real> walls_;

    void move_and_sweep(int moves, int sweeps) {
        for (int i = 0; i < moves; ++i) move_all();
        if (rules_.order == PassOrder::sweeps_last) walls_.keep_in();
        for (int i = 0; i < sweeps; ++i) {
            sweep();
            if (rules_.order == PassOrder::walls_each_pass) walls_.keep_in();
        }
    }

    template <class Visit> void each_pin(Visit&& visit) {
        for (const auto& pin : world_.pins)
            if (const auto row = p_.handles.find(pin.particle); row && !p_.quarantined[*row]) visit(pin, *row);
    }

    /// Sets every x_prev before any x: the velocity of a particle with two pins is the way to the target of the last.
    void carry_pins() {
        each_pin([&](const auto& pin, Row row) {
            const bool is_set = pin.hold != Hold::integrated && pin.hold != Hold::frozen && !pin.steers();
            if (is_set) p_.previous[row] = p_.position[row];
        });
        each_pin([&](const auto& pin, Row row) { pin.steers() ? steer(pin, row) : hold(pin, row); });
    }

    /// Pins are rigid: the originals have no others.
    void hold(const Pin<D, Real>& pin, Row row) {
        if (pin.hold != Hold::frozen) p_.position[row] = pin.target;
        p_.mobility[row] = pin.hold == Hold::fixed ? Real(0) : p_.inverse_mass[row];
        if (pin.hold == Hold::corrected || pin.hold == Hold::frozen) stay(row);
    }

    /// a = k (target - x) - c v, in place of all other accelerations (GameMaker's hand and head).
    void steer(const Pin<D, Real>& pin, Row row) {
        if (!is_free(row)) return;
        const auto way = pin.target - p_.position[row];
        move_by(row, {.acceleration = Vec<D, Real>::map([&](int i) { return pin.steer[i] * way[i]; }),
                      .drag_rate = pin.steer_damping});
        stay(row);
    }

    void stay(Row row) { stays_[row] = 1; }
    bool is_free(Row row) const { return p_.mobility[row] > Real(0) && !stays_[row]; }

    /// Restores mobilities for physical mode, where only hard pins fix a particle.
    void let_go() {
        for (const auto& pin : world_.pins)
            if (const auto row = p_.handles.find(pin.particle); row && !p_.quarantined[*row])
                p_.mobility[*row] = p_.inverse_mass[*row];
        for (const auto& pin : world_.pins)
            if (const auto row = p_.handles.find(pin.particle); row && pin.hard()) p_.mobility[*row] = Real(0);
    }

    void move_all() {
        for (Row row = 0; row < p_.size(); ++row)
            if (is_free(row)) {
                move(row);
                p_.force[row] = {}; // a force acts in one move of a frame
            }
    }

    void move(Row row) {
        const auto integrator = integrator_of(world_, row);
        goes_as_verlet(integrator) ? move_by(row, forcing_on(world_, row)) : integrate(integrator, row);
    }

    /// v = x - x_prev; x_prev = x; x += keep v + a h^2
    void move_by(Row row, const Forcing<D, Real>& forcing) {
        const auto velocity = velocity_of(row);
        const auto pushed = gained(forcing, velocity);
        const auto moved =
            rules_.damp_after_force ? (velocity + pushed) * rules_.keep : velocity * rules_.keep + pushed;
        p_.previous[row] = p_.position[row];
        p_.position[row] = clamp_components(p_.position[row] + moved, limit::coordinate<Real>);
    }

    /// Velocity as a displacement per step.
    Vec<D, Real> velocity_of(Row row) const {
        const Real inertia = rules_.unscaled_inertia ? Real(1) : h_ / verlet_interval(world_);
        return (p_.position[row] - p_.previous[row]) * inertia;
    }

    /// Change of velocity by a forcing, both as displacements per step.
    Vec<D, Real> gained(const Forcing<D, Real>& forcing, const Vec<D, Real>& velocity) const {
        const Real share = rules_.halved_acceleration ? Real(0.5) : Real(1);
        const auto fallen = clamp_components(forcing.acceleration * (h_ * h_ * share), limit::coordinate<Real>);
        return fallen - velocity * min(Real(1), forcing.drag_rate * h_ * dragged_share());
    }

    /// A displacement that is not scaled is the way of a frame: its drag is an acceleration like any other, over h^2.
    Real dragged_share() const {
        return rules_.unscaled_inertia ? h_ * inverse_or_zero(world_.settings.frame) : Real(1);
    }

    /// Step of an integrator other than Verlet: damping acts before or after; x_prev = x - v h.
    void integrate(Integrator integrator, Row row) {
        const auto gain = [&](const Vec<D, Real>& position, const Vec<D, Real>& change) {
            return gained(forcing_on(world_, row, clamp_components(position, limit::coordinate<Real>)), change);
        };
        const Real before = rules_.damp_after_force ? Real(1) : rules_.keep;
        const Real after = rules_.damp_after_force ? rules_.keep : Real(1);
        const auto moved =
            advance(integrator, FreeMotion<Vec<D, Real>>{p_.position[row], velocity_of(row) * before}, gain);
        p_.position[row] = clamp_components(moved.position, limit::coordinate<Real>);
        p_.previous[row] = clamp_components(p_.position[row] - moved.change * after, limit::coordinate<Real>);
    }

    /// Projects the constraints in the order of their addition, then parts the polygons that overlap.
    void sweep() {
        std::array<Row, std::size_t(Kinds<D>::size)> next{};
        for (const auto& run : world_.sweep)
            visit_table(world_, run.kind, [&](auto& table) {
                auto& row = next[std::size_t(run.kind)];
                for (const Row end = row + run.count; row < end; ++row) project(table, row);
            });
        mover_.first_iteration = false;
        if constexpr (D == 2)
            detail::ClassicPolygons<Real>(world_).part_all(
                [&](Row row, const Vec<D, Real>& by) { mover_.displace(row, by); });
    }

    template <class Table> void project(Table& table, Row row) {
        if constexpr (std::is_same_v<typename Table::Kind, Distance<D>>) {
            if (rules_.root_free) return project_without_root(table, row);
            if (part_ends(table, row)) return;
        }
        table.multiplier[row] = Real(0); // each pass starts from the current points
        detail::project_row(scratch_, table, row, mover_);
    }

    /// Separates coincident ends along y, the first towards larger y: atan2(0, 0) = 0 (Flash).
    template <class Table> bool part_ends(Table& table, Row row) {
        const auto ends = std::as_const(table.members)[row];
        if (p_.position[ends[0]] != p_.position[ends[1]]) return false;
        const Real split = table.split[row];
        const Real first = p_.inverse_mass[ends[0]] * detail::handicap(split, 0);
        const Real second = p_.inverse_mass[ends[1]] * detail::handicap(split, 1);
        const Real gap = clamp(clamp(Real(0), table.low(row), table.high(row)), Real(0), limit::coordinate<Real>);
        const auto apart = Vec<D, Real>::axis(1) * (gap * table.relaxation[row] * inverse_or_zero(first + second));
        mover_.displace(ends[0], apart * first);
        mover_.displace(ends[1], -apart * second);
        return true;
    }

    /// s = r^2/(d^2 + r^2) - 1/2 approximates half the relative error without a square root (Jakobsen 2001).
    template <class Table> void project_without_root(Table& table, Row row) {
        const auto ends = std::as_const(table.members)[row];
        const auto ab = p_.position[ends[1]] - p_.position[ends[0]];
        const Real squared = dot(ab, ab);
        constexpr Real max = limit::coordinate<Real>;
        const Real rest = square_root(
            clamp(squared, square(clamp(table.low(row), Real(0), max)), square(clamp(table.high(row), Real(0), max))));
        const Real s = rest * rest * inverse_or_zero(squared + rest * rest) - Real(0.5);
        const auto both = ab * (Real(2) * s * table.relaxation[row]);
        mover_.displace(ends[0], -both * table.split[row]);
        mover_.displace(ends[1], both * (Real(1) - table.split[row]));
    }

    /// Velocities for readers: classic mode itself uses x and x_prev.
    void read_velocities() {
        const Real per_h = inverse_or_zero(h_);
        for (Row row = 0; row < p_.size(); ++row) {
            const auto velocity = (p_.position[row] - p_.previous[row]) * per_h;
            p_.velocity[row] = clamp_components(velocity, limit::speed<Real>);
        }
    }
};

} // namespace

template <int D, class Real> void classic_step(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    if (!world.settings.classic.dropped_leftover) return ClassicStep<D, Real>(world, solver, dt).run();
    constexpr Real tick_share = Real(0.96); // 16 ms of a frame
    constexpr int max_ticks = 1000;
    const Real tick = tick_share * world.settings.frame;
    const Real whole = clamp(dt * inverse_or_zero(tick) + Real(1e-4), Real(0), Real(max_ticks));
    for (int left = int(whole); left > 0; --left) ClassicStep<D, Real>(world, solver, tick).run();
}

#define SINEW_CLASSIC(D, Real) template void classic_step(World<D, Real>&, Solver<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_CLASSIC)

} // namespace sinew
