#pragma once

#include "sinew/solver/direct/equations.h"

#include <utility>

/// Substep of a block: Newton's method on
///
///     sum inertia/2 |x - aim|^2  +  sum tension C + k/2 C^2,        C = (|x_b - x_a|^2 - limit^2) / 2
///
/// the augmented Lagrangian of the links, with geometric stiffness, started from the tensions of the last substep. Each
/// iteration gains about four digits, whatever the masses.
namespace sinew::detail {

/// Progress of a solve.
struct SolveProgress {
    int iteration = 0;
    double share = 0; ///< fraction of the Newton step taken in the last iteration, 0..1
};

template <int D> class BlockSolve : public BlockEquations<D> {
    using Base = BlockEquations<D>;

  public:
    using Base::Base, Base::links, Base::unknowns, Base::soft, Base::bounces;
    using typename Base::Vector;
    BlockNode<D>& node(std::uint32_t i) const { return Base::node(i); }

    /// Total length of links and cables, m.
    double reach() const { return reach_; }
    const SolveProgress& progress() const { return progress_; }

    /// Treats links as very stiff springs from now on: lengths that cannot all be kept share the error.
    void use_penalty() { elastic_ = true; }

    /// Iterates until rounding is all that is left, from now on.
    void be_precise() { is_precise_ = true; }

    /// Lets joints swing past their limits from now on, and bounce afterwards (direct/joint_stops.h).
    void allow_overshoot() { bounce_ = true; }

    /// Chooses the active limits at the start of the substep.
    void choose_active_limits(Rule rule) {
        reach_ = 0;
        Base::ranges_bounce_ = bounce_ && rule == Rule::swing;
        for (auto& link : links()) {
            link.start = node(link.b).start - node(link.a).start;
            reach_ += link.length;
            choose_side(link);
        }
        bends_.set_out(Base::ranges_bounce_);
        reach_ += ways_.set_out(as_good_as_taut);
    }

    /// Solves for every `place`. `hold()` adds external terms to the equations. False if the solve did not converge.
    template <class Hold> bool run(Rule rule, int most_iterations, Hold&& hold) {
        set_out(rule);
        for (auto& node : unknowns()) node.place = node.start + guess(rule, node);
        return iterate(rule, most_iterations, hold);
    }

    /// Same as `run`, started from the present positions and tensions.
    template <class Hold> bool run_again(Rule rule, int most_iterations, Hold&& hold) {
        set_out(rule);
        return iterate(rule, most_iterations, hold);
    }

    /// True if the external terms decided as in the equations before; a `hold` without a result always agrees.
    template <class Hold> static bool agrees(Hold& hold) {
        if constexpr (std::is_void_v<decltype(hold())>)
            return true;
        else
            return hold();
    }

    /// Runs one more iteration. False if the error is no longer acceptable, as after a wrong release of a limit.
    template <class Hold> bool refine(Rule rule, Hold&& hold) {
        assemble(rule);
        hold();
        Base::solve();
        take_step(1);
        return worst_error() <= acceptable;
    }

    /// Largest overshoot of a bouncing joint past the limit, and past the state at the start of the substep: radians
    /// for an angle, a fraction of half the length for a link.
    double worst_overshoot() const {
        double worst = bends_.worst_overshoot();
        for (const auto& link : links()) {
            if (link.side != 0 || !bounces(link)) continue;
            const double begun = norm(link.start), now = norm(node(link.b).place - node(link.a).place);
            const double beyond = maximum(now - maximum(link.high, begun), minimum(link.low, begun) - now);
            worst = maximum(worst, 2 * beyond / link.length);
        }
        return worst;
    }

    /// Gauss-Seidel sweeps over the links from the start positions: brings lengths nearer where Newton's method fails.
    void sweep() {
        constexpr int rounds = 20;
        for (auto& node : unknowns()) node.place = node.start;
        for (int i = 0; i < rounds; ++i)
            for (auto& link : links()) {
                auto &a = node(link.a), &b = node(link.b);
                const double wa = mobility(link.a), wb = mobility(link.b);
                const auto now = b.place - a.place;
                const double length = norm(now);
                const auto correction = now * ((length - clamp(length, link.low, link.high)) * inverse_or_zero(length) *
                                               inverse_or_zero(wa + wb));
                a.place += correction * wa;
                b.place -= correction * wb;
            }
    }

  protected:
    static constexpr double good_enough = 1e-7;
    static constexpr double braces_give = 1e-6;
    static constexpr double hardly = 1e-5;        ///< relative move after which the next would be too small to matter
    static constexpr double hardly_light = 1e-10; ///< same where light trees have velocities
    static constexpr double precise = 1e-11, nearly_precise = 1e-8; ///< same where `is_precise_`
    static constexpr double stagnant = 0.25;      ///< ratio to the last move, above which the iteration only rounds
    static constexpr double crude = 1e-3;         ///< violation above which the multipliers of light trees mean nothing
    static constexpr double hardly_pulled = 3e-3; ///< same for a tension
    static constexpr double acceptable = 1e-5;
    static constexpr double absurd = 100;
    static constexpr int undecided_after =
        8;                                 ///< iterations; from then on half steps, which settle limits that alternate
    static constexpr double slight = 1e-3; ///< a move, as a fraction of a link
    static constexpr int patience = 10;    ///< iterations
    static constexpr double most_change = 0.5; ///< change of a link in one iteration, as a fraction of the length
    static constexpr double as_good_as_taut = 1e-4;
    static constexpr double small_angle =
        1e-2; ///< an angle's error in radians counts as this fraction of a relative length error
    static constexpr int most_flips = 2;

    using Base::add, Base::clear_entries, Base::bends_, Base::ways_, Base::block_, Base::h_, Base::per_h_;
    double reach_ = 0;
    SolveProgress progress_{};
    double moved_before_ = 0; ///< `moved_` of the iteration before
    double moved_ = 0, tightened_ = 0,
           strongest_ = 0; ///< largest move of a node, change of a tension, and tension in an iteration
    bool elastic_ = false, bounce_ = false, is_precise_ = false;
    bool releases_ = true; ///< limits may be released in this iteration
    bool let_go_ = false;  ///< a limit was released since `patience` was last checked
    double slight_ = 0;    ///< tension that counts as zero

    double mobility(std::uint32_t i) const {
        return i < block_.first_node + block_.unknowns ? inverse_or_zero(node(i).mass) : 0;
    }

    template <class Hold> bool iterate(Rule rule, int most_iterations, Hold&& hold) {
        double before = 0, last = 0;
        for (int i = 0;; ++i) {
            if (i > 0 && steady() && worst_error() <= good_enough && agrees(hold)) return true;
            const double worst = assemble(rule);
            releases_ = !Base::has_light_trees_ || worst <= crude;
            hold();
            if (i > 0 && !(worst <= absurd)) return false;
            if (i > 1 && block_.braced() && worst <= braces_give && worst > 0.5 * last && moved_ <= hardly * reach_)
                return true; // redundant links in a plane: Newton's method stagnates
            last = worst;
            if (i % patience == 0) { // the error falls if there is a solution
                if (i > 0 && !let_go_ && worst > 0.5 * before && worst > acceptable) return false;
                before = worst;
                let_go_ = false; // a rope goes slack link by link
            }
            // contacts that alternate: lengths are right, and nodes hardly move
            const double slight_move = slight * reach_ / double(block_.links + block_.ways);
            if (rule == Rule::implicit && i >= undecided_after && worst <= acceptable && moved_ <= slight_move)
                return true;
            if (i == most_iterations)
                return worst <= acceptable &&
                       moved_ <= acceptable * reach_; // links that alternate between taut and slack
            Base::solve();
            take_step(i >= undecided_after ? 0.5 : 1);
        }
    }

    Vector flight(Rule rule, const BlockNode<D>& node) const {
        return rule == Rule::place ? Vector{} : node.velocity * h_;
    }

    /// Displacement from which the iteration starts: the free flight. Light parts whirl too fast for that, and heavy
    /// ones hardly move in a substep.
    Vector guess(Rule rule, const BlockNode<D>& node) const {
        return Base::has_light_trees_ ? Vector{} : flight(rule, node);
    }

    /// Sets inertia and the positions without constraints, and chooses the active limits.
    void set_out(Rule rule) {
        progress_ = {};
        const double share = rule == Rule::swing ? 0.5 : rule == Rule::implicit ? 1 : 0;
        for (auto& node : unknowns()) {
            node.inertia = node.mass * per_h_ * per_h_ * (rule == Rule::swing ? 2 : 1);
            node.aim = node.start + flight(rule, node) + node.push * (share * h_ * h_);
        }
        choose_active_limits(rule);
        slight_ = 1e-6 * Base::weight() * inverse_or_zero(reach_) * double(block_.links + block_.ways);
    }

    /// Active limit at the start of the substep. A link within the margin of a limit counts as taut: a falling rope
    /// would otherwise tighten link by link.
    void choose_side(DistanceRow<D>& link) const {
        link.flips = 0;
        link.give = 0;
        if (bounces(link)) return rest_on_end(link);
        link.side = link.low == link.high || link.tension > 0 ? 1 : link.tension < 0 ? -1 : 0;
        if (link.side != 0) return;
        const double length = norm(link.start), margin = as_good_as_taut * link.length;
        link.side = length > link.high - margin ? 1 : length < link.low + margin ? -1 : 0;
    }

    /// For a bouncing link: only the limit on which the link rests is active, offset by the present excess.
    static void rest_on_end(DistanceRow<D>& link) {
        constexpr double hardly_short = 1e-6;
        const double length2 = dot(link.start, link.start), margin = hardly_short * square(link.length);
        const double above = 0.5 * (length2 - square(link.high)), below = 0.5 * (length2 - square(link.low));
        link.side = link.tension > 0 && above > -margin ? 1 : link.tension < 0 && below < margin ? -1 : 0;
        link.give = link.side > 0 ? maximum(above, 0.0) : link.side < 0 ? minimum(below, 0.0) : 0;
    }

    /// Assembles the equations at the present positions. Returns the worst violation of a rigid link, relative to the
    /// length.
    double assemble(Rule rule) {
        for (auto& node : unknowns()) {
            node.diagonal = Matrix<D, double>::diagonal(node.inertia);
            node.residual = (node.aim - node.place) * node.inertia;
        }
        clear_entries();
        const double hardest = Base::stiffness();
        double worst = 0;
        for (auto& link : links()) {
            const auto now = node(link.b).place - node(link.a).place;
            if (soft(link)) {
                spring(rule, link, now);
                continue;
            }
            const double k = hardest * link.per_length2 * Base::share(link);
            const double length2 = dot(now, now);
            const double above = 0.5 * (length2 - square(link.high)), below = 0.5 * (length2 - square(link.low));
            if (link.side == 0 && !bounces(link)) link.activate(above, below, good_enough * square(link.length));
            const double error = (link.side > 0 ? above : link.side < 0 ? below : 0) - link.give;
            worst = maximum(worst, absolute(error) * link.per_length2);
            link.pull = link.side != 0 ? link.tension + k * error : 0;
            link.stiffness = link.side != 0 ? k : 0;
            if (link.side == 0) continue;
            const bool swings = rule == Rule::swing;
            const auto along = swings ? (link.start + now) * 0.5 : rule == Rule::shake ? link.start : now;
            link.along = now;
            auto matrix = outer(along * k, now);
            if (rule != Rule::place && rule != Rule::shake)
                matrix +=
                    Matrix<D, double>::diagonal(maximum(elastic_ ? link.pull : link.tension, 0.0) * (swings ? 0.5 : 1));
            add(link, matrix, along * link.pull);
        }
        worst = maximum(worst, small_angle * bends_.assemble(rule, hardest, good_enough / small_angle));
        worst = maximum(worst, ways_.assemble(rule, hardest, elastic_, good_enough));
        return worst;
    }

    /// Worst violation of links and angles at the present positions, scaled as in `assemble`.
    double worst_error() {
        double worst = 0;
        for (const auto& link : links()) {
            if (soft(link) || (link.side == 0 && bounces(link))) continue;
            const auto now = node(link.b).place - node(link.a).place;
            const double length2 = dot(now, now) - 2 * link.give;
            const double above = length2 - square(link.high), below = length2 - square(link.low);
            worst = maximum(worst, 0.5 * link.outside(above, below) * link.per_length2);
        }
        return maximum(worst, small_angle * bends_.worst_error());
    }

    /// A compliant link: the force follows from the length, without a multiplier.
    void spring(Rule rule, DistanceRow<D>& link, const Vector& now) {
        const double length = norm(now), per_length = inverse_or_zero(length);
        const double error = length - clamp(length, link.low, link.high);
        link.stiffness = 0;
        link.pull = link.tension = 0;
        if (error == 0 || rule == Rule::place) return;
        const double k = 1 / link.compliance;
        double force = k * error;
        auto along = now * per_length;
        auto matrix = outer(along * k, along);
        matrix += Matrix<D, double>::diagonal(maximum(force, 0.0) * per_length);
        add(link, matrix, along * force);
        link.pull = link.tension = force * per_length;
    }

    /// Trust region: the fraction of the step at which no link changes by more than `most_change`. Newton's model means
    /// nothing further out.
    double trusted_share() {
        double most = 0;
        tightened_ = strongest_ = 0;
        for (auto& link : links()) {
            const auto change = node(link.b).move - node(link.a).move;
            most = maximum(most, dot(change, change) * link.per_length2);
            link.pull += link.stiffness * dot(link.along, change);
            tightened_ = maximum(tightened_, absolute(link.pull - link.tension) * link.length / Base::share(link));
            strongest_ = maximum(strongest_, absolute(link.pull) * link.length);
        }
        most = maximum(most, ways_.largest_change2());
        return most > square(most_change) ? most_change / square_root(most) : 1;
    }

    bool steady() const {
        return moved_ <= (Base::has_light_trees_ ? hardly_light : hardly) * reach_ &&
               tightened_ <= hardly_pulled * strongest_ && (!is_precise_ || is_rounding());
    }
    /// True if the last move was no more than rounding.
    bool is_rounding() const {
        return moved_ <= precise * reach_ || (moved_ <= nearly_precise * reach_ && moved_ > stagnant * moved_before_);
    }

    void take_step(double most) {
        const double share = progress_.share = minimum(most, trusted_share());
        ++progress_.iteration;
        moved_before_ = std::exchange(moved_, 0);
        for (auto& node : unknowns()) {
            node.place += node.move * share;
            moved_ = maximum(moved_, largest_component(node.move));
        }
        for (auto& link : links())
            if (!soft(link)) renew(link, link.pull, share, slight_ * Base::share(link));
        for (auto& bend : bends_.all())
            if (!bends_.soft(bend)) {
                renew(bend, bend.pull + bend.stiffness * bends_.change(bend), share, slight_);
                bend.tension = clamp(bend.tension, -bend.most, bend.most);
            }
        for (auto& way : ways_.all())
            if (!ways_.soft(way)) {
                renew(way, way.pull + way.stiffness * ways_.change(way), share, slight_);
                way.tension = clamp(way.tension, -way.most, way.most);
            }
    }

    /// Updates the multiplier. A limit whose multiplier has the wrong sign, by more than `slight`, is released, unless
    /// activated more than `most_flips` times in this substep.
    void renew(BlockLimit& limit, double next, double share, double slight) {
        if (elastic_) {
            limit.tension = 0;
            limit.side = limit.one_sided() && next * limit.side < 0 ? 0 : limit.side;
            return;
        }
        limit.tension = limit.side != 0 ? limit.tension + share * (next - limit.tension) : 0;
        const bool undecided = limit.flips > most_flips;
        if (releases_ && limit.one_sided() && !undecided && next * limit.side < -slight)
            limit.side = 0, limit.tension = 0, let_go_ = true;
    }

    static double largest_component(const Vector& v) {
        double most = 0;
        for (int i = 0; i < D; ++i) most = maximum(most, absolute(v[i]));
        return most;
    }
};

} // namespace sinew::detail
