#pragma once

#include "sinew/constraint/kinds.h"
#include "sinew/solver/block.h"
#include "sinew/solver/column.h"
#include "sinew/solver/figure.h"
#include "sinew/solver/force.h"
#include "sinew/solver/id.h"
#include "sinew/solver/integrator.h"
#include "sinew/solver/limit_columns.h"
#include "sinew/solver/passive.h"
#include "sinew/solver/swept.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

/// The state of everything, as plain columns. Data only: edit.h changes it, step.h moves it, energy.h measures it. A
/// world is a value; copying it is a snapshot. Units are the user's own, as long as they agree (metres, kilograms,
/// seconds, newtons; or pixels and frames).
namespace sinew {

/// The stated limits within which finite input can never become infinite or not-a-number, in float as in double:
/// nothing is further out, faster, heavier or lighter. What would be is held at the limit. In the user's units.
namespace limit {
template <class Real> inline constexpr Real coordinate = Real(1e8);
template <class Real> inline constexpr Real speed = Real(1e12);
template <class Real> inline constexpr Real force = Real(1e15);
template <class Real> inline constexpr Real mass = Real(1e12);          ///< and its inverse
template <class Real> inline constexpr Real measure = Real(1e26);       ///< a constraint's limits, compliance / h^2
template <class Real> inline constexpr Real multiplier = Real(1e25);    ///< a constraint's multiplier
template <class Real> inline constexpr Real step = Real(1e6);           ///< time units a step may last
template <class Real> inline constexpr Real shortest_step = Real(1e-9); ///< a shorter one is none
} // namespace limit

/// A vector held at a limit. One that is not finite stays as it is: the next step puts its figure in quarantine.
template <int D, class Real> constexpr Vec<D, Real> clamp_finite(const Vec<D, Real>& vector, Real limit) {
    return is_finite(vector) ? clamp_components(vector, limit) : vector;
}

/// Nothing is pushed further in a substep of length h: what crosses the world.
template <class Real> constexpr Real furthest_move(Real h) {
    return minimum(limit::speed<Real> * h, Real(2) * limit::coordinate<Real>);
}

template <int D, class Real> struct Particles {
    std::vector<Vec<D, Real>> position;
    std::vector<Vec<D, Real>> previous; ///< where it was one step ago; classic mode's state
    std::vector<Vec<D, Real>> velocity; ///< mean over the last substep; in classic mode over the step
    std::vector<Vec<D, Real>> residual; ///< what rounding took from position (Kahan 1965)
    std::vector<Vec<D, Real>> force;    ///< applied for one step, then cleared
    bool any_force = false;             ///< who writes a force says so: else none is looked for
    std::vector<Vec<D, Real>> rebound;  ///< scratch: the velocity with which it leaves what it struck
    std::vector<Real> inverse_mass;     ///< 0: nothing moves it
    std::vector<Real> mobility;         ///< the inverse mass that constraints see; 0 while pinned or quarantined
    std::vector<Real> radius;
    std::vector<FigureIndex> figure;
    std::vector<char> quarantined; ///< stands still: it or its figure was found non-finite
    std::vector<char> in_block;    ///< scratch: a block moves it, not the sweep
    Slots<ParticleTag> slots;

    std::size_t size() const { return position.size(); }

    template <class Self, class Visit> static void columns(Self& self, Visit&& visit) {
        visit(self.position);
        visit(self.previous);
        visit(self.velocity);
        visit(self.residual);
        visit(self.force);
        visit(self.rebound);
        visit(self.inverse_mass);
        visit(self.mobility);
        visit(self.radius);
        visit(self.figure);
        visit(self.quarantined);
        visit(self.in_block);
    }
};

/// The particles of each constraint of a table, as rows of Particles.
template <int Arity> struct Members {
    std::vector<std::array<Row, Arity>> rows;

    std::span<const Row> operator[](Row constraint) const { return rows[constraint]; }
    std::span<Row> operator[](Row constraint) { return rows[constraint]; }
    std::size_t size() const { return rows.size(); }

    void append(std::span<const Row> members) {
        auto& row = rows.emplace_back();
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = members[i];
    }
    void erase(std::span<const char> gone) { erase_rows(rows, gone); }
};

template <> struct Members<any_arity> {
    std::vector<Row> pool;
    std::vector<std::uint32_t> first{
        0}; ///< where each constraint's members begin in the pool; one more than constraints

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
    LimitColumns<Real> limits;    ///< the measure is held within [low, high]; equal for an exact constraint
    std::vector<Real> multiplier; ///< of the last substep; tension = -multiplier / h^2
    Column<Real> compliance;      ///< 1/stiffness; 0 is rigid
    Column<Real> relaxation;      ///< share of the error removed at once, (0, 1]
    Column<Real> split;           ///< share of the correction that the first member takes, 0..1; 1/2 is fair
    Column<Real> max_force;       ///< most it pulls or pushes with; limit::measure and more has no end
    Column<Real> lead;            ///< a compliant one aims where the measure will be so much later: a damper
    Column<Real> rate;            ///< at which the limits move: a winch, a motor
    Column<char> driven;          ///< its limits were made to move once
    Column<Real> breaking_strain; ///< torn beyond it; limit::measure and more never tears
    Column<Real> toughness;       ///< strain beyond that, times time, which it bears before it tears; 0: none
    Column<Real> fatigue;         ///< what it has borne of it
    Column<FigureIndex> figure;
    Column<char> in_block; ///< scratch: a block solves it, not the sweep
    Column<char> torn;     ///< scratch: to be removed when the step ends; the last of the columns (remove.h)
    Slots<ConstraintTag> slots;

    std::size_t size() const { return limits.size(); }
    Real low(Row row) const { return limits.low(row); }
    Real high(Row row) const { return limits.high(row); }
    /// It gives way: it does not pull harder than that.
    bool gives(Row row) const { return max_force[row] < limit::measure<Real>; }
    bool any_gives() const {
        return max_force.any_of([](Real force) { return force < limit::measure<Real>; });
    }
    bool may_tear() const {
        return breaking_strain.any_of([](Real strain) { return strain < limit::measure<Real>; });
    }
    /// From now on tearing allocates nothing.
    void expect_tears() {
        slots.remember();
        fatigue.set_apart();
        in_block.set_apart();
        torn.set_apart();
    }

    template <class Self, class Visit> static void columns(Self& self, Visit&& visit) {
        visit(self.limits);
        visit(self.multiplier);
        visit(self.compliance);
        visit(self.relaxation);
        visit(self.split);
        visit(self.max_force);
        visit(self.lead);
        visit(self.rate);
        visit(self.driven);
        visit(self.breaking_strain);
        visit(self.toughness);
        visit(self.fatigue);
        visit(self.figure);
        visit(self.in_block);
        visit(self.torn);
    }
};

/// Whether a distance ties its ends together: what only keeps them apart does not.
template <int D, class Real> bool ties(const Constraints<Distance<D>, Real>& distances, Row row) {
    return distances.high(row) < limit::measure<Real>;
}

namespace detail {
template <class Real, class List> struct Tables;
template <class Real, class... Kind> struct Tables<Real, TypeList<Kind...>> {
    using type = std::tuple<Constraints<Kind, Real>...>;
};
} // namespace detail

/// One table a kind, in the order of the list of kinds.
template <int D, class Real> using ConstraintTables = typename detail::Tables<Real, Kinds<D>>::type;

/// Consecutive rows of one kind's table, as they come in a sweep.
struct Run {
    int kind = 0;
    Row count = 0;
};

/// Classic mode: the effect of a pin on its particle, before the particles are moved and the constraints swept. A
/// particle that is not fixed takes corrections like any other.
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
    Vec<D, Real> from{};       ///< where the target was when the step began
    Vec<D, Real> target{};     ///< where it is when the step ends; interpolated over the substeps
    Real compliance = 0;       ///< 0: the particle is on the target, whatever pulls at it
    Real damping = 1;          ///< of a compliant pin, as a fraction of critical
    Real max_force = 0;        ///< most it pulls with; 0 means no limit
    Vec<D, Real> multiplier{}; ///< of the last substep; force = -multiplier / h^2
    Vec<D, Real> carried{};    ///< scratch: its particle's velocity before the constraints
    Hold hold = Hold::fixed;   ///< in classic mode
    Vec<D, Real> steer{};      ///< acceleration over the distance to the target, along each axis, 1/s^2; classic mode
    Real steer_damping = 0;    ///< acceleration against the velocity, 1/s; classic mode
    /// Accelerates its particle instead of holding it.
    bool steers() const { return steer != Vec<D, Real>{} || steer_damping != Real(0); }
    bool hard() const { return compliance == Real(0) && max_force == Real(0) && !steers(); }
};

/// A plane that particles stay on one side of: dot(normal, x) >= offset + radius.
template <int D, class Real> struct HalfSpace {
    Vec<D, Real> normal{}; ///< unit, pointing to the free side
    Real offset = 0;
    Real restitution = 0; ///< share of the approach speed given back, 0..1
    Real friction = 0;    ///< Coulomb's coefficient
};

enum class Mode : std::uint8_t { physical, classic };

/// When classic mode sweeps over the constraints.
enum class PassOrder : std::uint8_t {
    sweeps_last,     ///< move, walls, then the sweep `passes` times
    walls_each_pass, ///< move, then (sweep, walls) `passes` times
    walls_last       ///< move, the sweep `passes` times, then walls
};

/// Classic mode's rules, each as some original had it (docs/classic.md). The last five are the originals' known bugs.
template <class Real> struct ClassicRules {
    int passes = 1;
    PassOrder order = PassOrder::sweeps_last;
    bool moves_each_pass = false; ///< a pass moves the particles, then sweeps (a reader of the Roblox article)
    /// Of all that belongs to no figure with an integrator of its own.
    Integrator integrator = Integrator::verlet;
    Real keep = 1;                 ///< velocity kept each frame (the originals' "damping" or "friction")
    bool damp_after_force = false; ///< (v + a) keep, as on Roblox; else v keep + a, as in Godot
    bool root_free = false;        ///< distances by s = r^2/(d^2 + r^2) - 1/2 instead of a square root (Jakobsen)
    Real bounce = 0;               ///< share of the speed a wall gives back; 0 only clamps and leaves `previous` alone
    Real floor_keep = 1;           ///< velocity along the floor kept each frame while resting on it
    Real time_scale = 1;           ///< slow motion; acceleration scales with its square
    Real longest_step = 4;         ///< frames: a stall never becomes more than this
    bool outward_bounce = false;   ///< Roblox: top and right walls leave the outward speed as it is
    bool points_only_passes = false;  ///< Roblox: the passes move the points, the constraints are swept once
    bool unscaled_inertia = false;    ///< GameMaker: inertia does not shrink with the step
    bool halved_acceleration = false; ///< tearable cloth: x += v + a/2 dt^2
    bool dropped_leftover = false;    ///< tearable cloth: steps of 16 ms, what is left of a frame is dropped
};

/// Of a sweep, where the settings leave it open.
inline constexpr int usual_substeps = 16;

template <class Real> struct Settings {
    Mode mode = Mode::physical;
    int substeps = 0; ///< 0: as many as it takes, `usual_substeps` where constraints are swept
    int iterations = 1;
    Real damping = 0;            ///< velocity decays as exp(-damping t); not negative
    Real frame = Real(1.0 / 60); ///< how long a frame is in the user's time unit; classic mode's tick
    ClassicRules<Real> classic;
};

enum class EventType : std::uint8_t {
    torn,        ///< a constraint exceeded its breaking strain and is gone
    quarantined, ///< a figure or a loose particle became non-finite and stands still until it is reset
};

struct Event {
    EventType type{};
    FigureIndex figure = no_figure;
    ConstraintId constraint{};        ///< torn: its id while it lived
    std::array<ParticleId, 2> ends{}; ///< torn: its first particle and its last
    ParticleId particle{};            ///< quarantined: the first that was not finite
};

/// Events a step can report. A step that would tear more leaves the rest for the next.
inline constexpr std::size_t events_per_step = 4096;

template <int D, class RealT> struct World {
    static constexpr int dimension = D;
    using Real = RealT;
    using Vector = Vec<D, Real>;

    // Defined once, in world.cpp: it is a lot to make and to copy.
    World();
    World(const World&);
    World(World&&) noexcept;
    World& operator=(const World&);
    World& operator=(World&&) noexcept;
    ~World();

    Settings<Real> settings;
    int threads = 0; ///< how many may work on a step; 0: as many as the machine has cores. Never changes a result
    Particles<D, Real> particles;
    ConstraintTables<D, Real> constraints;
    std::vector<Run> sweep; ///< the order in which constraints are solved: as they were added
    std::vector<Pin<D, Real>> pins;
    Slots<PinTag> pin_slots;
    std::vector<Force<D, Real>> forces;
    std::vector<HalfSpace<D, Real>> bounds;
    std::vector<Figure> figures; ///< by FigureIndex; where one was removed, one that is not in use
    NameTable<FigureIndex> figure_names;
    Stamp figure_stamp;             ///< of figures that are added next
    std::size_t unused_figures = 0; ///< of `figures`

    double time = 0;
    std::uint64_t steps = 0;
    double energy_lost = 0;      ///< where blocks were struck, cracked or snapped taut; decides nothing
    Real last_step = 0;          ///< its length: in classic mode a change of it corrects the Verlet step
    Real last_substep = 0;       ///< its length: a change of it corrects what is added to velocities
    std::uint32_t restless = 0;  ///< bands swept again at once where links of tethered sheets are much too long
    std::vector<Event> events;   ///< of the last step
    Blocks<D> blocks;            ///< what is solved at once instead of in the sweep
    Swept<D, Real> swept;        ///< room for the sweep, and its plan
    Budgets<D> budgets;          ///< what the constraints of figures may do to their energy
    std::vector<Vector> scratch; ///< room for the points and gradients of the widest constraint
};

/// Whether there is a figure of that index.
template <class WorldT> bool has_figure(const WorldT& world, FigureIndex figure) {
    return figure < world.figures.size() && world.figures[figure].in_use();
}

/// As particles have it.
template <class Real> constexpr Real inverse_of_mass(Real mass) {
    if (mass == std::numeric_limits<Real>::infinity() || mass <= Real(0)) return Real(0);
    if (!is_finite(mass)) return mass; // not a number: the next step puts its figure in quarantine
    return Real(1) / clamp(mass, Real(1) / limit::mass<Real>, limit::mass<Real>);
}

/// The time between `previous` and `position`: the last step, a frame before there was one.
template <int D, class Real> Real verlet_interval(const World<D, Real>& world) {
    return minimum(world.last_step > Real(0) ? world.last_step : world.settings.frame, limit::step<Real>);
}

/// What moves a particle in classic mode: its figure's integrator, or else that of the rules.
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

/// Defines a template for every world there is: SINEW_INSTANTIATE(X) with X(D, Real).
#define SINEW_INSTANTIATE(X) X(2, float) X(2, double) X(3, float) X(3, double)

} // namespace sinew
