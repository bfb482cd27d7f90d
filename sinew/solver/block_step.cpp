#include "sinew/solver/block_solve.h"
#include "sinew/solver/decay.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/rigid_motion.h"
#include "sinew/solver/workers.h"

#include <cmath>

namespace sinew {
namespace {

using detail::Rule;

/// Moves one block over a frame: in as few substeps as swing by themselves; where something strikes, cracks or folds,
/// in shorter ones, in the end implicit.
template <int D, class Real> class BlockStep {
  public:
    BlockStep(World<D, Real>& world, const Block& block, double frame, double last_substep)
        : world_(world), p_(world.particles), d_(std::get<kind_number<Distance, D>>(world.constraints)),
          a_(std::get<kind_number<Angle, D>>(world.constraints)),
          pulleys_(std::get<kind_number<Pulley, D>>(world.constraints)), blocks_(world.blocks), block_(block),
          frame_(frame) {
        const double per = inverse_or_zero(square(last_substep));
        for (auto& bend : bends()) bend.before = -double(a_.multiplier[bend.constraint]) * per;
        for (auto& link : links()) link.before = -double(d_.multiplier[link.constraint]) * per / link.length;
        if (block_.ways > 0 || block_.motored) find_drives(per);
    }

    void run(int substeps) {
        for (int s = 0; s < substeps; ++s) advance(double(s) / substeps, double(s + 1) / substeps, 0);
    }

    void report_tensions(double substep) {
        constexpr double most = double(limit::multiplier<Real>);
        for (const auto& link : links())
            d_.multiplier[link.constraint] = Real(clamp(-link.before * link.length * square(substep), -most, most));
        for (const auto& bend : bends())
            a_.multiplier[bend.constraint] = Real(clamp(-bend.before * square(substep), -most, most));
        for (const auto& way : ways()) {
            multiplier_of(way) = Real(clamp(-way.before * square(substep), -most, most));
            if (!way.gives()) continue;
            if (way.is_pulley)
                tell_limits(way, pulleys_, way.constraint);
            else
                tell_limits(way, d_, way.constraint);
        }
    }

  private:
    using Vector = Vec<D, double>;
    using Solve = detail::BlockSolve<D>;

    World<D, Real>& world_;
    Particles<D, Real>& p_;
    Constraints<Distance<D>, Real>& d_;
    Constraints<Angle<D>, Real>& a_;
    Constraints<Pulley<D>, Real>& pulleys_;
    Blocks<D>& blocks_;
    const Block& block_;
    static constexpr int many = 40, stretched_iterations = 10; ///< iterations, where there is no other way
    double frame_;
    double from_ = 0, to_ = 0, h_ = 0; ///< of this substep: shares of the frame, and its length
    detail::RigidMotion<D> begun_{};   ///< of a free block, when the substep began
    bool near_ = false;                ///< a plane may be touched
    bool driven_ = false;              ///< something from outside may do work

    std::span<BlockNode<D>> nodes() { return std::span(blocks_.nodes).subspan(block_.first_node, block_.nodes); }
    std::span<BlockNode<D>> unknowns() { return std::span(blocks_.nodes).subspan(block_.first_node, block_.unknowns); }
    std::span<BlockBend<D>> bends() { return std::span(blocks_.bends).subspan(block_.first_bend, block_.bends); }
    std::span<BlockWay> ways() { return std::span(blocks_.ways).subspan(block_.first_way, block_.ways); }
    std::span<BlockLink<D>> links() { return std::span(blocks_.links).subspan(block_.first_link, block_.links); }

    void advance(double from, double to, int depth) {
        constexpr int deepest = 3, pieces = 4;
        constexpr int few = 8; // iterations: where more are needed, shorter substeps are cheaper
        from_ = from, to_ = to, h_ = (to - from) * frame_;
        load();
        Solve solve(blocks_, block_, h_);
        if (!pull_together(solve)) return be_stretched();
        if (solve.jolted()) settle(solve);
        const bool found = solve.run(Rule::swing, few, [&] { hold(solve); }), blow = struck(solve);
        if (found && !blow && !gains(solve)) {
            for (auto& node : unknowns()) node.velocity = (node.place - node.start) * (2 / h_) - node.velocity;
            if (any_tightened())
                settle(solve);
            else if (solve.jolted())
                straighten(solve);
            keep_momentum();
            return store();
        }
        if (driven_ && !solve.run(Rule::place, many, [] {})) return be_stretched();
        if (depth == deepest || (depth > 0 && blow)) return give_way();
        const double piece = (to - from) / pieces;
        for (int i = 0; i < pieces; ++i)
            advance(from + piece * i, i + 1 == pieces ? to : from + piece * (i + 1), depth + 1);
    }

    /// The substep once more, implicit. Where even that finds nothing, everything stays where it is for this moment and
    /// slows down, until it does.
    void give_way() {
        load();
        Solve solve(blocks_, block_, h_);
        pull_together(solve);
        const double kinetic = solve.kinetic();
        if (solve.run(Rule::implicit, many, [&] { hold(solve); })) {
            for (auto& node : unknowns()) node.velocity = (node.place - node.start) * (1 / h_);
        } else {
            for (auto& node : unknowns()) node.place = node.start, node.velocity *= 0.5;
            start_tensions();
        }
        settle(solve);
        keep_momentum();
        if (!driven_ && !block_.motored) slow_down(solve, kinetic + work(solve));
        store();
    }

    /// Pinned further apart than it is long: as near to its lengths as it gets.
    void be_stretched() {
        load();
        forget_tensions();
        Solve solve(blocks_, block_, h_);
        const double before = solve.worst_start_strain();
        solve.be_elastic();
        solve.run(Rule::implicit, stretched_iterations, [&] { hold(solve); });
        constexpr double most = 10;
        if (!(solve.worst_place_strain() <= maximum(most, before)))
            for (auto& node : unknowns()) node.place = node.start;
        for (auto& node : unknowns()) node.velocity = (node.place - node.start) * (1 / h_);
        forget_tensions();
        store();
    }

    // --- what a substep begins with, and ends with ----------------------------------------------------------------

    void load() {
        near_ = driven_ = false;
        if (block_.motored) move_limits();
        Decay<double> decay;
        for (auto& node : unknowns()) {
            const Row row = node.row;
            node.start = node.place = cast<double>(p_.position[row]) + cast<double>(p_.residual[row]);
            const auto velocity = cast<double>(p_.velocity[row]);
            const auto middle = p_.position[row] + p_.velocity[row] * Real(0.5 * h_);
            const auto push = push_on(world_, row, middle);
            const double rate = clamp(double(world_.settings.damping + push.drag_rate), 0.0, limit::measure<double>);
            if (rate != decay.rate) decay = Decay<double>::of(rate, h_);
            node.velocity = velocity * decay.keep;
            node.push = cast<double>(push.acceleration) * decay.yield;
            node.mass = inverse_or_zero(double(p_.inverse_mass[row]) * decay.yield);
            driven_ = driven_ || blocks_.pin_of[row] != Blocks<D>::none;
            near_ = near_ || is_near(node);
        }
        for (auto& node : nodes().subspan(block_.unknowns)) {
            node.move = node.velocity = {};
            node.start = node.place = cast<double>(p_.position[node.row]);
            for (auto i = blocks_.pin_of[node.row]; i != Blocks<D>::none; i = blocks_.next_pin[i]) {
                const auto& pin = world_.pins[i];
                if (!pin.hard() || p_.quarantined[node.row]) continue;
                node.start = goal(pin, from_), node.place = goal(pin, to_);
                node.velocity = (node.place - node.start) * (1 / h_);
                driven_ = driven_ || !(pin.from == pin.target);
            }
        }
        start_tensions();
        if (is_free()) begun_ = Motion::of(unknowns(), Solve::start_of);
    }

    // --- winches and motors

    Real& multiplier_of(const BlockWay& way) {
        return way.is_pulley ? pulleys_.multiplier[way.constraint] : d_.multiplier[way.constraint];
    }

    template <class Table> static void find_drive(BlockDrive& drive, const Table& table, Row row) {
        drive.most = double(table.max_force[row]);
        drive.lead = double(table.lead[row]);
        drive.rate = double(table.rate[row]);
        drive.low_begun = double(table.low[row]);
        drive.high_begun = double(table.high[row]);
    }
    void find_drives(double per) {
        for (auto& bend : bends()) find_drive(bend, a_, bend.constraint);
        for (auto& way : ways()) {
            if (way.is_pulley)
                find_drive(way, pulleys_, way.constraint);
            else
                find_drive(way, d_, way.constraint);
            way.before = -double(multiplier_of(way)) * per;
        }
    }

    /// Its limits are where it was pulled to.
    void slip(BlockWay& way) {
        const double length = detail::BlockWays<D>(blocks_, block_, h_).length_of(way, false);
        const double error = length - clamp(length, way.low, way.high), spring = way.most * way.compliance;
        const double by = error - clamp(error, -spring, spring);
        for (double* end : {&way.low_begun, &way.high_begun})
            if (absolute(*end) < limit::measure<double>) *end += by;
    }
    template <class Table> static void tell_limits(const BlockDrive& drive, Table& table, Row row) {
        table.low[row] = Real(drive.low_begun);
        table.high[row] = Real(drive.high_begun);
    }

    /// To where they are when the substep ends.
    void move_limits() {
        const double by = to_ * frame_;
        for (auto& bend : bends()) {
            bend.low = bend.low_begun + bend.rate * by;
            bend.high = bend.high_begun + bend.rate * by;
        }
        for (auto& way : ways()) {
            way.low = maximum(way.low_begun + way.rate * by, 0.0);
            way.high = maximum(way.high_begun + way.rate * by, 0.0);
        }
    }

    void start_tensions() {
        for (auto& link : links()) link.tension = link.before;
        for (auto& bend : bends()) bend.tension = bend.before;
        for (auto& way : ways()) way.tension = way.before;
    }
    void forget_tensions() {
        for (auto& link : links()) link.tension = 0;
        for (auto& bend : bends()) bend.tension = 0;
        for (auto& way : ways()) way.tension = 0;
    }
    /// What let go in the end pulls no more.
    static double kept(const BlockLimit& limit) {
        return limit.one_sided() && limit.tension * limit.side <= 0 ? 0 : limit.tension;
    }

    void store() {
        constexpr double fastest = double(limit::speed<Real>), furthest = double(limit::coordinate<Real>);
        for (auto& node : unknowns()) {
            const auto place = clamp_components(node.place, furthest);
            const auto held = cast<Real>(place);
            p_.residual[node.row] = cast<Real>(place - cast<double>(held));
            p_.previous[node.row] = p_.position[node.row];
            p_.position[node.row] = held;
            p_.velocity[node.row] = cast<Real>(clamp_components(node.velocity, fastest));
        }
        for (auto& link : links()) link.before = kept(link);
        for (auto& bend : bends()) bend.before = kept(bend);
        for (auto& way : ways()) {
            if (way.slips) slip(way);
            way.before = kept(way);
        }
    }

    static Vector goal(const Pin<D, Real>& pin, double share) {
        return cast<double>(pin.from) + (cast<double>(pin.target) - cast<double>(pin.from)) * share;
    }

    /// A figure put down stretched, or torn from its pins, is brought to its lengths without a velocity. False where
    /// its pins are too far apart.
    bool pull_together(Solve& solve) {
        constexpr double crude = 1e-3;
        const double before = solve.worst_start_strain();
        if (before <= crude) return true;
        const auto fixed = nodes().subspan(block_.unknowns);
        for (auto& node : fixed) std::swap(node.start, node.place);
        forget_tensions();
        const bool met = solve.run(Rule::place, many, [] {});
        if (!met) solve.sweep();
        const double after = solve.worst_place_strain();
        if (after < before)
            for (auto& node : unknowns()) node.start = node.place;
        for (auto& node : fixed) std::swap(node.start, node.place);
        start_tensions();
        return met || after <= crude;
    }

    // --- what acts from outside -------------------------------------------------------------------------------------

    double depth(const BlockNode<D>& node, const HalfSpace<D, Real>& plane) const {
        return double(plane.offset) + double(p_.radius[node.row]) - dot(cast<double>(plane.normal), node.place);
    }

    bool is_near(const BlockNode<D>& node) const {
        const double reach = h_ * (norm(node.velocity) + h_ * norm(node.push)) * 2;
        for (const auto& plane : world_.bounds)
            if (depth(node, plane) > -reach) return true;
        return false;
    }

    /// Something has come to a plane, or a joint to its end: what follows is a blow, not a swing.
    bool struck(const Solve& solve) {
        if (solve.any_bend_struck()) return true;
        if (!near_) return false;
        for (const auto& node : unknowns())
            for (const auto& plane : world_.bounds)
                if (depth(node, plane) > 0) return true;
        return false;
    }

    /// Soft pins and planes, as terms on the diagonal.
    void hold(const Solve& solve) {
        if (driven_)
            for (auto& node : unknowns())
                for (auto i = blocks_.pin_of[node.row]; i != Blocks<D>::none; i = blocks_.next_pin[i])
                    pull(node, world_.pins[i], solve.stiffness());
        if (near_)
            for (auto& node : unknowns())
                for (const auto& plane : world_.bounds) press(node, plane, solve.stiffness());
    }

    /// A damped spring to its goal, whose force has an end.
    void pull(BlockNode<D>& node, Pin<D, Real>& pin, double hardest) {
        const double per_compliance = inverse_or_zero(double(pin.compliance));
        const double k = per_compliance > 0 ? minimum(per_compliance, hardest) : hardest;
        const double damper = double(pin.damping) * 2 * square_root(k * node.mass) / h_;
        const auto error = node.place - goal(pin, to_), before = node.start - goal(pin, from_);
        auto force = error * k + (error - before) * damper;
        double stiffness = k + damper;
        if (const double most = double(pin.max_force); most > 0 && norm(force) > most) {
            const double share = most / norm(force);
            force *= share;
            stiffness *= share;
        }
        node.diagonal += Matrix<D, double>::diagonal(stiffness);
        node.residual -= force;
        pin.multiplier = cast<Real>(clamp_components(force * -square(h_), double(limit::multiplier<Real>)));
    }

    /// A plane pushes back and rubs (Coulomb): both so stiff that nothing sinks or creeps visibly.
    void press(BlockNode<D>& node, const HalfSpace<D, Real>& plane, double k) {
        const auto normal = cast<double>(plane.normal);
        const double pressure = k * depth(node, plane);
        if (!(pressure > 0)) return;
        node.diagonal += outer(normal * k, normal);
        node.residual += normal * pressure;
        if (!(plane.friction > Real(0))) return;
        const auto move = node.place - node.start;
        const auto slip = move - normal * dot(normal, move);
        const double most = double(plane.friction) * pressure, grip = k * norm(slip);
        const double stiffness = grip > most ? k * (most / grip) : k;
        node.diagonal += Matrix<D, double>::diagonal(stiffness);
        node.diagonal -= outer(normal * stiffness, normal);
        node.residual -= slip * stiffness;
    }

    // --- velocities --------------------------------------------------------------------------------------------------

    bool any_tightened() {
        for (const auto& link : links())
            if (link.low < link.high && link.before == 0 && link.tension != 0) return true;
        for (const auto& way : ways())
            if (way.one_sided() && way.before == 0 && way.tension != 0) return true;
        return false;
    }

    void settle(Solve& solve) {
        const double kinetic = solve.kinetic();
        solve.settle([&](double k) {
            if (!near_) return;
            for (auto& node : unknowns())
                for (const auto& plane : world_.bounds) rebound(node, plane, k);
        });
        if (!near_ && !driven_ && !block_.motored) slow_down(solve, kinetic); // less but for rounding
    }

    /// Where a whip cracks, what it does along its links is no motion but the rule's own error: it goes back into what
    /// is one.
    void straighten(Solve& solve) {
        const double kinetic = solve.kinetic();
        settle(solve);
        if (!driven_) bring_to(solve, kinetic);
    }

    /// What struck a plane leaves it with its restitution; what rests on it stays.
    void rebound(BlockNode<D>& node, const HalfSpace<D, Real>& plane, double k) {
        if (!(depth(node, plane) > 0)) return;
        const auto normal = cast<double>(plane.normal);
        const auto struck = cast<double>(p_.velocity[node.row]) + node.push * h_;
        const double approach = -dot(normal, struck), resting = 4 * h_ * norm(node.push);
        const double away = approach > resting ? double(plane.restitution) * approach : 0;
        const double missing = away - dot(normal, node.velocity);
        if (!(missing > 0)) return;
        node.diagonal += outer(normal * k, normal);
        node.residual += normal * (k * missing);
    }

    // --- energy ------------------------------------------------------------------------------------------------------

    /// What the force fields put in on the way, less what the springs took.
    double work(const Solve& solve) {
        double sum = 0;
        for (const auto& node : unknowns()) sum += node.mass * dot(node.push, node.place - node.start);
        for (const auto& link : links())
            sum -= solve.stored(link, solve.node(link.b).place - solve.node(link.a).place) -
                   solve.stored(link, link.start);
        for (const auto& bend : bends())
            sum -= solve.stored(bend, solve.angle_of(bend, Solve::place_of)) -
                   solve.stored(bend, solve.angle_of(bend, Solve::start_of));
        for (const auto& way : ways()) sum -= solve.ways().stored(way, false) - solve.ways().stored(way, true);
        return sum;
    }

    /// A swing never gains energy by itself.
    bool gains(const Solve& solve) {
        if (driven_ || block_.motored) return false;
        constexpr double rounding = 1e-6, tiny = 2e-7;
        double before = 0, after = 0, weight = 0;
        for (const auto& node : unknowns()) {
            weight += node.mass * norm(node.push);
            const auto velocity = (node.place - node.start) * (2 / h_) - node.velocity;
            before += 0.5 * node.mass * dot(node.velocity, node.velocity);
            after += 0.5 * node.mass * dot(velocity, velocity);
        }
        return after > before + work(solve) + rounding * (before + after) + tiny * weight * solve.reach();
    }

    /// What moves about the motion of the whole is slowed down, until no more than that is left.
    void slow_down(const Solve& solve, double most) {
        if (solve.kinetic() > most) bring_to(solve, most);
    }

    /// What moves about the motion of the whole gets slower or faster, until the energy is that.
    void bring_to(const Solve& solve, double kinetic) {
        constexpr double fastest = 1.1; // a correction, not a kick
        const auto motion = is_free() ? Motion::of(unknowns(), Solve::place_of) : Motion{};
        const auto rate = motion.rate_of(unknowns(), Solve::place_of);
        const auto whole = [&](const BlockNode<D>& node) {
            return motion.momentum * inverse_or_zero(motion.mass) + Motion::turning(rate, node.place - motion.center);
        };
        double kept = 0;
        for (const auto& node : unknowns()) kept += 0.5 * node.mass * dot(whole(node), whole(node));
        const double share =
            minimum(fastest, square_root(maximum(kinetic - kept, 0.0) * inverse_or_zero(solve.kinetic() - kept)));
        for (auto& node : unknowns()) node.velocity = whole(node) + (node.velocity - whole(node)) * share;
    }

    // --- momentum ----------------------------------------------------------------------------------------------------

    using Motion = detail::RigidMotion<D>;

    /// Nothing from outside acts on it but force fields.
    bool is_free() { return block_.nodes == block_.unknowns && !driven_ && !near_; }

    /// A free block has the momentum and the spin it had, and what the fields gave it: links only act within.
    void keep_momentum() {
        if (!is_free()) return;
        Motion due = begun_;
        for (const auto& node : unknowns()) {
            const auto kick = node.push * (node.mass * h_);
            due.momentum += kick;
            due.spin += Motion::moment((node.start + node.place) * 0.5 - begun_.center, kick);
        }
        auto missing = Motion::of(unknowns(), Solve::place_of);
        missing.momentum = due.momentum - missing.momentum;
        missing.spin = due.spin - missing.spin;
        const auto rate = missing.rate_of(unknowns(), Solve::place_of);
        const auto drift = missing.momentum * inverse_or_zero(missing.mass);
        for (auto& node : unknowns()) node.velocity += drift + Motion::turning(rate, node.place - missing.center);
    }
};

/// Blocks are handed out to threads some at a time.
constexpr int a_part = 8;
constexpr std::size_t worth_a_thread = 500; ///< nodes: of fewer, telling others takes longer than doing it

template <int D> int parts_of(const Blocks<D>& blocks) {
    return int((blocks.list.size() + a_part - 1) / a_part);
}
template <int D> std::span<const Block> part_of(const Blocks<D>& blocks, int part) {
    const auto first = std::size_t(part) * a_part;
    return std::span(blocks.list).subspan(first, std::min<std::size_t>(a_part, blocks.list.size() - first));
}

} // namespace

template <int D, class Real> void step_blocks(World<D, Real>& world, Real dt, Real substep) {
    auto& blocks = world.blocks;
    if (blocks.list.empty()) return;
    std::fill(blocks.pin_of.begin(), blocks.pin_of.end(), Blocks<D>::none);
    for (std::uint32_t i = 0; i < world.pins.size(); ++i) {
        const auto row = world.particles.slots.find(world.pins[i].particle);
        if (!row) continue;
        blocks.next_pin[i] = blocks.pin_of[*row];
        blocks.pin_of[*row] = i;
    }
    constexpr int few = 2;
    const int substeps = world.settings.substeps > 0 ? world.settings.substeps : few;
    const auto move = [&](int part) {
        for (const auto& block : part_of(blocks, part)) {
            BlockStep<D, Real> step(world, block, double(dt), double(world.last_substep));
            step.run(substeps);
            step.report_tensions(double(substep));
        }
    };
    const int threads = world.threads > 0 ? world.threads : hardware_threads();
    Workers::run(blocks.nodes.size() < worth_a_thread ? 1 : threads, parts_of(blocks), move);
}

#define SINEW_BLOCK_STEP(D, Real) template void step_blocks(World<D, Real>&, Real, Real);
SINEW_INSTANTIATE(SINEW_BLOCK_STEP)

} // namespace sinew
