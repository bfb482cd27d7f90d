#pragma once

#include "sinew/assert/assert.h"
#include "sinew/math/decay.h"
#include "sinew/solver/block.h"
#include "sinew/solver/direct/angle_geometry.h"
#include "sinew/solver/direct/cable_geometry.h"
#include "sinew/solver/direct/tensions.h"
#include "sinew/solver/phases.h"

#include <algorithm>
#include <optional>

/// State of a block: loaded from the world at the start of a substep, and stored at the end.
namespace sinew::detail {

template <int D, class Real> class BlockState {
  public:
    using Vector = Vec<D, double>;

    /// Tensions are those of a substep of the length `last_substep`, by the multipliers of the world; without it, they
    /// are `before` of each row.
    BlockState(World<D, Real>& of, Solver<D, Real>& solver, const Block& one, double frame,
               std::optional<double> last_substep)
        : world(of), particles(of.particles), blocks(solver.blocks), touches(solver.touches),
          filter(solver.options.contact_filter), block(one),
          distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          angles_(std::get<kind_number<Angle, D>>(world.constraints)),
          pulleys_(std::get<kind_number<Pulley, D>>(world.constraints)), frame_(frame) {
        if (!last_substep) return;
        const double per = inverse_or_zero(square(*last_substep));
        tensions().load(per);
        if (block.ways > 0 || block.is_motorized) find_drives(per);
    }

    World<D, Real>& world;
    Particles<D, Real>& particles;
    Blocks<D>& blocks;
    ColliderTouches<D, Real>& touches;
    const ContactFilter& filter;
    const Block& block;

    std::span<BlockNode<D>> nodes() const { return std::span(blocks.nodes).subspan(block.first_node, block.nodes); }
    std::span<BlockNode<D>> unknowns() const { return nodes().first(block.unknowns); }
    std::span<BlockNode<D>> fixed() const { return nodes().subspan(block.unknowns); }
    std::span<DistanceRow<D>> links() const { return std::span(blocks.links).subspan(block.first_link, block.links); }
    std::span<AngleRow<D>> bends() const { return std::span(blocks.bends).subspan(block.first_bend, block.bends); }
    std::span<CableRow> ways() const { return std::span(blocks.ways).subspan(block.first_way, block.ways); }

    double substep() const { return h_; }
    /// Fractions of the frame at the ends of the substep.
    double from() const { return from_; }
    double to() const { return to_; }
    /// True if pins or their targets may do work.
    bool motorized() const { return motorized_; }
    /// Notes that a moving collider may do work in this substep.
    void be_motorized() { motorized_ = true; }
    /// True if only fields and planes change the energy.
    bool works_alone() const { return !motorized_ && !block.is_motorized; }

    /// Sets the substep, between two fractions of the frame, and loads the state at the start.
    void load(double from, double to) {
        SINEW_ASSERT(0 <= from && from < to && to <= 1, "a substep is a part of the frame");
        from_ = from, to_ = to, h_ = (to - from) * frame_;
        motorized_ = false;
        if (block.is_motorized) move_limits();
        Decay<double> decay;
        Forcing<D, Real> fall; // common to particles under gravity only
        bool fall_known = false;
        const bool all_fall = std::all_of(world.forces.begin(), world.forces.end(), [](const auto& force) {
            return std::holds_alternative<Gravity<D, Real>>(force);
        });
        for (auto& node : unknowns()) {
            const Row row = node.row;
            SINEW_ASSERT(particles.at_end[row], "the sweep leaves out a particle of a block");
            node.start = node.position = cast<double>(particles.position[row]) + cast<double>(particles.residual[row]);
            const auto velocity = cast<double>(particles.velocity[row]);
            const auto middle = particles.position[row] + particles.velocity[row] * Real(0.5 * h_);
            const bool falls = all_fall && particles.force[row] == Vec<D, Real>{};
            if (falls && !fall_known) fall = forcing_on(world, row, middle), fall_known = true;
            const auto forcing = falls ? fall : forcing_on(world, row, middle);
            const double rate = clamp(double(world.settings.damping + forcing.drag_rate), 0.0, limit::measure<double>);
            if (rate != decay.rate) decay = Decay<double>::of(rate, h_);
            node.velocity = velocity * decay.keep;
            node.acceleration = cast<double>(forcing.acceleration) * decay.yield;
            node.mass = inverse_or_zero(double(particles.inverse_mass[row]) * decay.yield);
            motorized_ = motorized_ || blocks.pin_of[row] != Blocks<D>::none;
        }
        for (auto& node : fixed()) {
            node.displacement = node.velocity = {};
            node.start = node.position = cast<double>(particles.position[node.row]);
            for (auto i = blocks.pin_of[node.row]; i != Blocks<D>::none; i = blocks.next_pin[i]) {
                const auto& pin = world.pins[i];
                if (!pin.hard() || particles.quarantined[node.row]) continue;
                node.start = pin.template target_at<double>(from_), node.position = pin.template target_at<double>(to_);
                node.velocity = (node.position - node.start) * (1 / h_);
                motorized_ = motorized_ || !(pin.from == pin.target);
            }
        }
        start_tensions();
    }

    void store() {
        constexpr double fastest = double(limit::speed<Real>), furthest = double(limit::coordinate<Real>);
        for (auto& node : unknowns()) {
            const auto position = clamp_components(node.position, furthest);
            const auto held = cast<Real>(position);
            particles.residual[node.row] = cast<Real>(position - cast<double>(held));
            particles.position[node.row] = held;
            particles.velocity[node.row] = cast<Real>(clamp_components(node.velocity, fastest));
        }
        for (auto& link : links()) link.before = kept(link);
        for (auto& bend : bends()) {
            if (bend.slips && bend.is_motor) slip(bend);
            bend.before = kept(bend);
        }
        for (auto& way : ways()) {
            if (way.slips) slip(way);
            way.before = kept(way);
        }
    }

    /// Starts from the tensions of the last substep. A braced block starts from zero: its tensions are not unique, and
    /// a self-stress would grow from substep to substep with the rounding of lengths.
    void start_tensions() {
        for (auto& link : links()) link.tension = block.braced() ? 0 : link.before;
        for (auto& bend : bends()) bend.tension = bend.before;
        for (auto& way : ways()) way.tension = way.before;
    }
    void forget_tensions() {
        for (auto& link : links()) link.tension = 0;
        for (auto& bend : bends()) bend.tension = 0;
        for (auto& way : ways()) way.tension = 0;
    }

    /// Stores the tensions as multipliers of a substep of the given length, and limits moved by slipping.
    void report_tensions(double substep) {
        tensions().report(substep);
        for (const auto& bend : bends())
            if (bend.is_motor && bend.gives()) tell_limits(bend, angles_, bend.constraint);
        for (const auto& way : ways()) {
            multiplier_of(way) = BlockTensions<D, Real>::multiplier(way.before, substep);
            if (!way.gives()) continue;
            if (way.is_pulley)
                tell_limits(way, pulleys_, way.constraint);
            else
                tell_limits(way, distances_, way.constraint);
        }
    }

  private:
    Constraints<Distance<D>, Real>& distances_;
    Constraints<Angle<D>, Real>& angles_;
    Constraints<Pulley<D>, Real>& pulleys_;
    double frame_;
    double from_ = 0, to_ = 0, h_ = 0; ///< fractions of the frame at the ends of the substep, and its length
    bool motorized_ = false;

    BlockTensions<D, Real> tensions() { return {world, blocks, block}; }

    /// Tension at the end of the substep; zero for a limit released since.
    static double kept(const BlockLimit& limit) {
        return limit.one_sided() && limit.tension * limit.side <= 0 ? 0 : limit.tension;
    }

    // --- winches and motors

    Real& multiplier_of(const CableRow& way) {
        return way.is_pulley ? pulleys_.multiplier[way.constraint] : distances_.multiplier[way.constraint];
    }

    template <class Table> static void find_drive(BlockDrive& drive, const Table& table, Row row) {
        drive.max = double(table.max_force[row]);
        drive.damping_time = double(table.damping_time[row]);
        drive.motor_speed = double(table.motor_speed[row]);
        drive.is_motor = table.motorized[row] != 0;
        drive.low_begun = double(table.low(row));
        drive.high_begun = double(table.high(row));
    }
    void find_drives(double per) {
        for (auto& bend : bends())
            if (!bend.is_fold()) find_drive(bend, angles_, bend.constraint);
        for (auto& way : ways()) {
            if (way.is_pulley)
                find_drive(way, pulleys_, way.constraint);
            else
                find_drive(way, distances_, way.constraint);
            way.before = -double(multiplier_of(way)) * per;
            way.slips = has_slipped(way);
        }
    }

    /// True if the tension of the last substep was nearly the largest. Not stored as a flag: a copy of the world has
    /// none.
    static bool has_slipped(const CableRow& way) {
        return way.gives() && absolute(way.before) >= slipping_share * way.max;
    }

    /// Moves the limits to the length reached.
    void slip(CableRow& way) {
        const double length = CableGeometry<D>(blocks).length_of(way, false);
        const double error = way.error_of(length), spring = way.max_stretch();
        const double by = error - clamp(error, -spring, spring);
        for (double* end : {&way.low_begun, &way.high_begun})
            if (absolute(*end) < limit::measure<double>) *end += by;
    }
    /// Moves the limits of a motor to the angle reached.
    void slip(AngleRow<D>& bend) {
        const double error = bend.error_of(AngleGeometry<D>(blocks).angle_of(bend, false));
        const double spring = bend.max * bend.compliance;
        const double by = error - clamp(error, -spring, spring);
        for (double* end : {&bend.low_begun, &bend.high_begun})
            if (absolute(*end) < limit::measure<double>) *end += by;
    }
    template <class Table> static void tell_limits(const BlockDrive& drive, Table& table, Row row) {
        table.limits.set(row, Real(drive.low_begun), Real(drive.high_begun));
    }

    /// Moves the limits to the end of the substep.
    void move_limits() {
        const double by = to_ * frame_;
        for (auto& bend : bends()) {
            bend.low = bend.low_begun + bend.motor_speed * by;
            bend.high = bend.high_begun + bend.motor_speed * by;
        }
        for (auto& way : ways()) {
            way.low = max(way.low_begun + way.motor_speed * by, 0.0);
            way.high = max(way.high_begun + way.motor_speed * by, 0.0);
        }
    }
};

} // namespace sinew::detail
