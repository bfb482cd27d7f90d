#pragma once

#include "sinew/assert/assert.h"
#include "sinew/collide/collider.h"
#include "sinew/constraint/kinds.h"
#include "sinew/math/limit.h"
#include "sinew/math/moments.h"
#include "sinew/table/column.h"
#include "sinew/table/id.h"
#include "sinew/table/limit_columns.h"
#include "sinew/world/contacts.h"
#include "sinew/world/figure.h"
#include "sinew/world/force_table.h"
#include "sinew/world/integrator.h"
#include "sinew/world/journal.h"
#include "sinew/world/world_types.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

/// State of the simulation, as plain columns. Data only: edit.h changes a world, step.h advances it, measure.h measures
/// it. A world is a value; a copy is a snapshot. Units are the user's, as long as they agree (metres, kilograms,
/// seconds, newtons; or pixels and frames).
namespace sinew {

/// Components clamped to [-limit, limit]. A non-finite vector is returned unchanged: the next step quarantines its
/// figure.
template <int D, class Real> constexpr Vec<D, Real> clamp_finite(const Vec<D, Real>& vector, Real limit) {
    return is_finite(vector) ? clamp_components(vector, limit) : vector;
}

/// Largest displacement in a substep of length h: at most the width of the world.
template <class Real> constexpr Real max_displacement(Real h) {
    return min(limit::speed<Real> * h, Real(2) * limit::coordinate<Real>);
}

/// Whether a particle with a radius turns as a ball does (a disc in 2D), by friction at its rim, in physical mode.
enum class Rolls : std::uint8_t {
    loose, ///< while no constraint holds it and it can move
    always,
    never
};

inline constexpr std::array<std::string_view, 3> rolls_names = {"loose", "always", "never"}; ///< in the order of Rolls

/// Moment of inertia of a solid disc (2D) or ball (3D), as a share of mass times radius^2.
template <int D> inline constexpr double solid_inertia = 2.0 / (D + 2);

template <int D, class Real> struct Particles {
    std::vector<Vec<D, Real>> position;
    std::vector<Vec<D, Real>> previous; ///< position one step ago; the state of classic mode
    std::vector<Vec<D, Real>> velocity; ///< mean over the substep, or at its end; classic mode: over the step
    std::vector<char> at_end;           ///< velocity is that at the end of the substep: a direct block's particle
    std::vector<Vec<D, Real>> residual; ///< rounding error of position (Kahan 1965)
    std::vector<Vec<D, Real>> force;    ///< external force, applied for one step, then cleared
    bool any_force = false;             ///< set by whoever writes `force`; the step skips the column while false
    std::vector<Real> inverse_mass;     ///< 0: immovable
    std::vector<Real> mobility;         ///< inverse mass seen by the constraints; 0 while pinned hard or quarantined
    std::vector<Real> radius;
    std::vector<FigureIndex> figure;
    std::vector<char> quarantined; ///< frozen: the particle or the particle's figure was found non-finite
    Column<Real> rest_time;        ///< time for which the body of a particle, its first one, has been at rest
    Column<char> asleep;           ///< left out of the step until the body is woken (docs/concepts/contact.md)
    Column<double> energy_debt; ///< energy that constraints of a joined figure still owe, J: a sum over its particles
    Column<Rolls> rolls;
    Column<Real> inertia;                    ///< moment of inertia, as a share of mass times radius^2; > 0
    Column<Vec<spins<D>, Real>> spin;        ///< angular velocity of a particle that rolls, 1 / time
    Column<collide::Rotation<D, Real>> turn; ///< rotation by it so far
    Column<char> near; ///< to something that the body may touch: held by rows of contact, not by a direct block
    HandleMap<ParticleTag> handles;

    std::size_t size() const { return position.size(); }

    template <class Self, class Visit> static void columns(Self& self, Visit&& visit) {
        visit(self.position);
        visit(self.previous);
        visit(self.velocity);
        visit(self.at_end);
        visit(self.residual);
        visit(self.force);
        visit(self.inverse_mass);
        visit(self.mobility);
        visit(self.radius);
        visit(self.figure);
        visit(self.quarantined);
        visit(self.rest_time);
        visit(self.asleep);
        visit(self.energy_debt);
        visit(self.rolls);
        visit(self.inertia);
        visit(self.spin);
        visit(self.turn);
        visit(self.near);
    }
};

/// Particles of each constraint of a table, as rows of Particles.
template <int Arity> struct Members {
    std::vector<std::array<Row, Arity>> rows;

    std::span<const Row> operator[](Row constraint) const {
        SINEW_ASSERT(constraint < rows.size(), "the constraint is in the table");
        return rows[constraint];
    }
    std::span<Row> operator[](Row constraint) {
        SINEW_ASSERT(constraint < rows.size(), "the constraint is in the table");
        return rows[constraint];
    }
    std::size_t size() const { return rows.size(); }

    void append(std::span<const Row> members) {
        SINEW_ASSERT(members.size() == std::size_t(Arity), "a constraint has as many members as its kind");
        auto& row = rows.emplace_back();
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = members[i];
    }
    void erase(std::span<const char> gone) { erase_rows(rows, gone); }
};

template <> struct Members<any_arity> {
    std::vector<Row> pool;
    std::vector<std::uint32_t> first{0}; ///< offset of each constraint's members in the pool; size() + 1 entries

    std::span<const Row> operator[](Row constraint) const {
        return std::span(pool).subspan(first[constraint], first[constraint + 1] - first[constraint]);
    }
    std::span<Row> operator[](Row constraint) {
        return std::span(pool).subspan(first[constraint], first[constraint + 1] - first[constraint]);
    }
    std::size_t size() const { return first.size() - 1; }

    void append(std::span<const Row> members) {
        pool.insert(pool.end(), members.begin(), members.end());
        first.push_back(std::uint32_t(pool.size()));
    }
    void erase(std::span<const char> gone) {
        SINEW_ASSERT(gone.size() == size(), "every row has a flag");
        std::uint32_t kept = 0, end = 0;
        for (Row row = 0, rows = Row(size()); row < rows; ++row) {
            const auto begin = first[row];
            if (gone[row]) continue;
            for (auto i = begin; i < first[row + 1]; ++i) pool[end + i - begin] = pool[i];
            const auto length = first[row + 1] - begin;
            first[kept++] = end;
            end += length;
        }
        first.resize(kept + 1);
        first[kept] = end;
        pool.resize(end);
    }
};

/// All constraints of one kind.
template <class KindT, class Real> struct Constraints {
    using Kind = KindT;
    Members<Kind::arity> members;
    LimitColumns<Real> limits;    ///< interval [low, high] of the measure; low == high for an equality constraint
    std::vector<Real> multiplier; ///< Lagrange multiplier after the last substep; tension = -multiplier / h^2
    Column<Real> compliance;      ///< 1 / stiffness; 0 is rigid
    Column<Real> relaxation;      ///< share of the error removed at once, (0, 1]
    Column<Real> split;           ///< share of the correction taken by the first member, [0, 1]; 1/2 is fair
    Column<Real> max_force;       ///< largest force; from limit::measure on unlimited
    Column<Real>
        damping_time; ///< damping time of a compliant constraint: force = k (C + damping_time (dC/dt - motor_speed))
    Column<Real> motor_speed;     ///< rate of the limits: a winch, a motor
    Column<char> motorized;       ///< 1 once drive() has set a rate
    Column<Real> breaking_strain; ///< strain beyond which the constraint tears; from limit::measure on never
    Column<Real> break_force;     ///< force beyond which the constraint tears; from limit::measure on never
    Column<Real> damage_limit;    ///< damage limit: excess strain times time borne before tearing; 0: tears at once
    Column<Real> damage;          ///< damage so far, excess strain times time
    Column<FigureIndex> figure;
    HandleMap<ConstraintTag> handles;

    std::size_t size() const { return limits.size(); }
    Real low(Row row) const { return limits.low(row); }
    Real high(Row row) const { return limits.high(row); }
    bool is_rigid(Row row) const { return compliance[row] == Real(0); }
    /// Energy of a compliant constraint whose measure is so far from the limits, J.
    double spring_energy(Row row, double error) const { return 0.5 * square(error) / double(compliance[row]); }
    /// True if the force of the constraint is limited.
    bool gives(Row row) const { return max_force[row] < limit::measure<Real>; }
    /// Distance of the measure from the limits at which a spring reaches the largest force.
    Real max_stretch(Row row) const { return max_force[row] * compliance[row]; }
    bool any_gives() const {
        return max_force.any_of([](Real force) { return force < limit::measure<Real>; });
    }
    bool may_tear() const {
        constexpr auto is_set = [](Real bound) { return bound < limit::measure<Real>; };
        return breaking_strain.any_of(is_set) || break_force.any_of(is_set);
    }
    /// True if the constraint can tear, by its strain or by its force.
    bool may_tear(Row row) const {
        return breaking_strain[row] < limit::measure<Real> || break_force[row] < limit::measure<Real>;
    }
    /// Allocates all the memory tearing needs.
    void expect_tears() {
        handles.remember();
        damage.set_apart();
    }

    template <class Self, class Visit> static void columns(Self& self, Visit&& visit) {
        visit(self.limits);
        visit(self.multiplier);
        visit(self.compliance);
        visit(self.relaxation);
        visit(self.split);
        visit(self.max_force);
        visit(self.damping_time);
        visit(self.motor_speed);
        visit(self.motorized);
        visit(self.breaking_strain);
        visit(self.break_force);
        visit(self.damage_limit);
        visit(self.damage);
        visit(self.figure);
    }
};

/// True for a distance with an upper limit: its ends are held together, not only apart.
template <int D, class Real> bool ties(const Constraints<Distance<D>, Real>& distances, Row row) {
    return distances.high(row) < limit::measure<Real>;
}

namespace detail {
template <class Real, class List> struct Tables;
template <class Real, class... Kind> struct Tables<Real, TypeList<Kind...>> {
    using type = std::tuple<Constraints<Kind, Real>...>;
};
} // namespace detail

/// A table per kind, in the order of the list of kinds.
template <int D, class Real> using ConstraintTables = typename detail::Tables<Real, Kinds<D>>::type;

/// Consecutive rows of one kind's table, in the order of the sweep.
struct Run {
    int kind = 0;
    Row count = 0;
};

/// Classic mode: effect of a pin on its particle, before the particles are moved and the constraints swept. Only a
/// `fixed` particle takes no corrections.
enum class Hold : std::uint8_t {
    fixed,      ///< x_prev = x, x = target; neither moved nor corrected
    corrected,  ///< x_prev = x, x = target; not moved (Flash, Godot)
    integrated, ///< x = target; moved like any other (GameMaker)
    displaced,  ///< x_prev = x, x = target; moved like any other (Godot chain, first version)
    frozen      ///< not moved (Godot chain, second version, under the pointer)
};

/// Holds a particle in place or on a moving target. A pointer's grab is a pin.
template <int D, class Real> struct Pin {
    ParticleId particle{};
    Vec<D, Real> from{};       ///< target at the start of the step
    Vec<D, Real> target{};     ///< target at the end of the step; interpolated over the substeps
    Real compliance = 0;       ///< 1 / stiffness; 0 is rigid
    Real damping = 1;          ///< fraction of critical damping, for a compliant pin
    Real max_force = 0;        ///< largest force; 0: unlimited
    Vec<D, Real> multiplier{}; ///< Lagrange multiplier after the last substep; force = -multiplier / h^2
    Hold hold = Hold::fixed;   ///< classic mode only
    Vec<D, Real> steer{};      ///< acceleration per distance to the target, by axis, 1/s^2; classic mode only
    Real steer_damping = 0;    ///< deceleration per velocity, 1/s; classic mode only
    /// True if the pin accelerates the particle instead of holding it at the target.
    bool steers() const { return steer != Vec<D, Real>{} || steer_damping != Real(0); }
    bool is_rigid() const { return compliance == Real(0); }
    bool hard() const { return is_rigid() && max_force == Real(0) && !steers(); }
    /// Energy of a compliant pin at an offset from the target, J.
    double spring_energy(const Vec<D, double>& offset) const { return 0.5 * dot(offset, offset) / double(compliance); }
    /// Target at a share of the step.
    template <class T = Real> Vec<D, T> target_at(std::type_identity_t<T> share) const {
        const auto begun = cast<T>(from);
        return begun + (cast<T>(target) - begun) * share;
    }
};

/// Plane with the particles on one side: dot(normal, x) >= offset + radius.
template <int D, class Real> struct HalfSpace {
    Vec<D, Real> normal{}; ///< unit length, towards the free side
    Real offset = 0;
    Real restitution = 0; ///< share of the approach speed given back, [0, 1]
    Real friction = 0;    ///< Coulomb's coefficient

    /// Depth of a sphere behind the plane, negative in front.
    Real depth_of(const Vec<D, Real>& center, Real radius) const { return offset + radius - dot(normal, center); }
    template <class T> HalfSpace<D, T> as() const { return {cast<T>(normal), T(offset), T(restitution), T(friction)}; }
};

enum class Mode : std::uint8_t { physical, classic };

/// Order of moves, walls and sweeps in a step of classic mode.
enum class PassOrder : std::uint8_t {
    sweeps_last,     ///< move, walls, then the sweep `passes` times
    walls_each_pass, ///< move, then (sweep, walls) `passes` times
    walls_last       ///< move, the sweep `passes` times, then walls
};

/// Rules of classic mode, each found in some original (docs/how/classic.md). The last five are known bugs of the
/// originals.
template <class Real> struct ClassicRules {
    int passes = 1;
    PassOrder order = PassOrder::sweeps_last;
    bool moves_each_pass = false; ///< a pass moves the particles, then sweeps (a reader of the Roblox article)
    /// For particles of figures without an integrator, and of no figure.
    Integrator integrator = Integrator::verlet;
    Real keep = 1;                 ///< velocity kept each frame (the originals' "damping" or "friction")
    bool damp_after_force = false; ///< (v + a) keep, as on Roblox; else v keep + a, as in Godot
    bool root_free = false;        ///< distances by s = r^2/(d^2 + r^2) - 1/2 instead of a square root (Jakobsen)
    Real bounce = 0;               ///< share of the speed given back by a wall; 0 with floor_keep 1: `previous` is kept
    Real floor_keep = 1;           ///< velocity along the floor kept each frame while resting
    Real time_scale = 1;           ///< slow motion; acceleration scales with its square
    Real longest_step = 4;         ///< largest step, frames: bounds the effect of a stall
    bool outward_bounce = false;   ///< Roblox: top and right walls leave the outward speed unchanged
    bool points_only_passes = false;  ///< Roblox: the passes move the points, the constraints are swept once
    bool unscaled_inertia = false;    ///< GameMaker: inertia does not shrink with the step
    bool halved_acceleration = false; ///< tearable cloth: x += v + a/2 dt^2
    bool dropped_leftover = false;    ///< tearable cloth: ticks of 16 ms, the remainder of a frame is dropped
};

/// Substeps of a sweep when the settings leave the number open.
inline constexpr int usual_substeps = 16;

/// Sleep of bodies at rest, by island (physical mode).
template <class Real> struct SleepRules {
    Real speed = 0; ///< speed below which a particle counts as at rest, length per time; 0: nothing falls asleep
    Real delay = Real(0.5); ///< time at rest before an island falls asleep, time units
};

template <class Real> struct Settings {
    Mode mode = Mode::physical;
    int substeps = 0; ///< 0: automatic, `usual_substeps` where constraints are swept
    int iterations = 1;
    Real damping = 0;            ///< rate of decay of velocities, >= 0: exp(-damping t)
    Real frame = Real(1.0 / 60); ///< length of a frame in the user's time unit; tick of classic mode
    ClassicRules<Real> classic;
    SleepRules<Real> sleep;
};

enum class EventType : std::uint8_t {
    torn,        ///< a constraint exceeded its breaking strain and was removed
    quarantined, ///< a figure or a loose particle became non-finite and is frozen; a figure until release_quarantine()
    touched,     ///< a particle and a collider, or what Contacts lists besides, came into contact
    parted,      ///< they ceased to touch
    hit,         ///< they met harder than Contacts::hit_impulse
};

struct Event {
    EventType type{};
    FigureIndex figure = no_figure;
    ConstraintId constraint{};        ///< torn: id of the removed constraint
    std::array<ParticleId, 2> ends{}; ///< torn: its first particle and its last
    ParticleId particle{};         ///< quarantined: the first non-finite particle; touched, parted, hit: the particle
    ColliderId collider{};         ///< touched, parted, hit: the collider, unless two figures touch; or see is_plane()
    FigureIndex other = no_figure; ///< touched, parted, hit: the second figure
    ParticleId other_particle{};   ///< of the second figure, where the figures pressed hardest
    double impulse = 0;            ///< touched: in the step; hit: of the blow; newton seconds
};

/// Largest number of events of a step. Further constraints tear in the next step.
inline constexpr std::size_t events_per_step = 4096;

template <int D, class RealT> struct World {
    static constexpr int dimension = D;
    using Real = RealT;
    using Vector = Vec<D, Real>;

    // Defined once, in world.cpp: costly to compile in every file.
    World();
    World(const World&);
    World(World&&) noexcept;
    World& operator=(const World&);
    World& operator=(World&&) noexcept;
    ~World();

    Settings<Real> settings;
    Particles<D, Real> particles;
    ConstraintTables<D, Real> constraints;
    std::vector<Run> sweep; ///< order in which the constraints are solved: as added
    std::vector<Pin<D, Real>> pins;
    HandleMap<PinTag> pin_handles;
    ForceTable<D, Real> forces;
    std::vector<HalfSpace<D, Real>> bounds;
    std::vector<collide::Collider<D, Real>> colliders; ///< colliders.h adds, moves and removes them
    HandleMap<ColliderTag> collider_handles;
    Contacts<D, Real> contacts;
    std::vector<Figure> figures; ///< by FigureIndex; a removed figure leaves an unused entry
    NameTable<FigureIndex> figure_names;
    Stamp figure_stamp;             ///< generation of the next figure added
    std::size_t unused_figures = 0; ///< unused entries of `figures`

    double time = 0;
    std::uint64_t steps = 0;
    double energy_lost = 0; ///< dissipated by direct blocks at impacts, cracks and taut snaps; diagnostic only
    Real last_step = 0;     ///< length of the last step; in classic mode the Verlet step is corrected for a change
    Real last_substep = 0;  ///< length of the last substep; the velocity update is corrected for a change
    std::uint32_t repair_window =
        0; ///< repair window, tiles: overstretched links of tethered components are swept again
    std::uint64_t sleep_parameters =
        0;                     ///< hash of all parameters since which nothing was edited, while anything sleeps
    std::vector<Event> events; ///< reported by the last step
    Journal journal;           ///< changes for the solver to follow
};

/// True if touches of planes are listed.
template <class WorldT> bool lists_planes(const WorldT& world) {
    return world.contacts.lists_planes && !world.bounds.empty();
}

/// True if planes or colliders hold particles.
template <class WorldT> bool has_walls(const WorldT& world) {
    return !world.bounds.empty() || !world.colliders.empty();
}

/// True for the index of a living figure.
template <class WorldT> bool has_figure(const WorldT& world, FigureIndex figure) {
    return figure < world.figures.size() && world.figures[figure].in_use();
}

/// Inverse mass of a particle, clamped to the limits; 0 for a mass that is infinite or not positive.
template <class Real> constexpr Real inverse_of_mass(Real mass) {
    if (mass == std::numeric_limits<Real>::infinity() || mass <= Real(0)) return Real(0);
    if (!is_finite(mass)) return mass; // the next step quarantines the particle's figure
    return Real(1) / clamp(mass, Real(1) / limit::mass<Real>, limit::mass<Real>);
}

/// Time between `previous` and `position`: the last step, or a frame before the first step.
template <int D, class Real> Real verlet_interval(const World<D, Real>& world) {
    return min(world.last_step > Real(0) ? world.last_step : world.settings.frame, limit::step<Real>);
}

/// Integrator of a particle in classic mode: the figure's, or else the one of the rules.
template <int D, class Real> Integrator integrator_of(const World<D, Real>& world, Row row) {
    const auto figure = world.particles.figure[row];
    const auto usual = world.settings.classic.integrator;
    return figure < world.figures.size() ? world.figures[figure].integrator.value_or(usual) : usual;
}

/// Calls visit(table) for every kind's table, in the order of the list of kinds.
template <class WorldT, class Visit> void for_each_table(WorldT& world, Visit&& visit) {
    std::apply([&](auto&... table) { (visit(table), ...); }, world.constraints);
}

/// Calls visit(table) for the table of the kind numbered `kind`.
template <class WorldT, class Visit> void visit_table(WorldT& world, int kind, Visit&& visit) {
    int number = 0;
    for_each_table(world, [&](auto& table) {
        if (number++ == kind) visit(table);
    });
}

} // namespace sinew
