#pragma once

#include "sinew/solver/direct/convergence.h"
#include "sinew/solver/direct/equations.h"
#include "sinew/solver/direct/multiplier_update.h"

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
    using Base::Base, Base::unknowns;
    using typename Base::Vector;
    BlockNode<D>& node(std::uint32_t i) const { return Base::node(i); }

    /// Total length of links and cables, m.
    double total_length() const { return total_length_; }
    const SolveProgress& progress() const { return progress_; }

    /// Treats links as very stiff springs from now on: lengths that cannot all be kept share the error.
    void use_penalty() { elastic_ = true; }

    /// Iterates until rounding is all that is left, from now on.
    void be_precise() { is_precise_ = true; }

    /// Maximum lengths form a convex set, with one solution in which no link pushes: from now on an iteration that
    /// would end with links that push releases the strongest of them and goes on (a primal active-set method).
    void be_convex() { convex_ = true; }

    /// Lets joints swing past their limits from now on, and bounce afterwards (direct/joint_stops.h).
    void allow_overshoot() { bounce_ = true; }

    /// Chooses the active limits at the start of the substep.
    void choose_active_limits(Rule rule) {
        const bool bounce = bounce_ && rule == Rule::midpoint;
        total_length_ = links_.set_out(bounce, as_good_as_taut);
        bends_.set_out(bounce);
        total_length_ += ways_.set_out(as_good_as_taut);
    }

    /// Solves for every `position`. `hold()` adds external terms to the equations. False if the solve did not converge.
    template <class Hold> bool run(Rule rule, int max_iterations, Hold&& hold) {
        set_out(rule);
        for (auto& node : unknowns()) node.position = node.start + guess(rule, node);
        return iterate(rule, max_iterations, hold);
    }

    /// Same as `run`, started from the present positions and tensions.
    template <class Hold> bool run_again(Rule rule, int max_iterations, Hold&& hold) {
        set_out(rule);
        return iterate(rule, max_iterations, hold);
    }

    /// True if the external terms decided as in the equations before; a `add_external_terms` without a result always
    /// agrees.
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
    double worst_overshoot() const { return max(bends_.worst_overshoot(), links_.worst_overshoot()); }

  protected:
    static constexpr double good_enough = 1e-7;
    static constexpr double braces_give = 1e-6;
    static constexpr double crude = 1e-3; ///< violation above which the multipliers of light trees mean nothing
    static constexpr double acceptable = 1e-5;
    static constexpr double absurd = 100;
    static constexpr int undecided_after =
        8;                                 ///< iterations; from then on half steps, which settle limits that alternate
    static constexpr double slight = 1e-3; ///< a move, as a fraction of a link
    static constexpr int patience = 10;    ///< iterations
    static constexpr double max_change = 0.5; ///< change of a link in one iteration, as a fraction of the length
    static constexpr double as_good_as_taut = 1e-4;
    static constexpr double small_angle =
        1e-2; ///< an angle's error in radians counts as this fraction of a relative length error

    using Base::clear_entries, Base::links_, Base::bends_, Base::ways_, Base::block_, Base::h_, Base::per_h_;
    double total_length_ = 0;
    SolveProgress progress_{};
    StepSizes sizes_;
    bool elastic_ = false, bounce_ = false, is_precise_ = false, convex_ = false;
    bool releases_ = true; ///< limits may be released in this iteration
    bool let_go_ = false;  ///< a limit was released since `patience` was last checked
    double slight_ = 0;    ///< tension that counts as zero

    template <class Hold> bool iterate(Rule rule, int max_iterations, Hold&& hold) {
        double before = 0, last = 0;
        for (int i = 0;; ++i) {
            if (i > 0 && is_steady() && worst_error() <= good_enough && agrees(hold) && !releases_strongest_push())
                return true;
            const double worst = assemble(rule);
            releases_ = !links_.uses_shares() || worst <= crude;
            hold();
            if (i > 0 && !(worst <= absurd)) return false;
            if (i > 1 && block_.braced() && worst <= braces_give && worst > 0.5 * last &&
                sizes_.moved <= StepSizes::hardly * total_length_)
                return true; // redundant links in a plane: Newton's method stagnates
            last = worst;
            if (i % patience == 0) { // the error falls if there is a solution
                if (i > 0 && !let_go_ && worst > 0.5 * before && worst > acceptable) return false;
                before = worst;
                let_go_ = false; // a rope goes slack link by link
            }
            // contacts that alternate: lengths are right, and nodes hardly move
            const double small_displacement = slight * total_length_ / double(block_.links + block_.ways);
            if (rule == Rule::backward_euler && !convex_ && i >= undecided_after && worst <= acceptable &&
                sizes_.moved <= small_displacement)
                return true;
            if (i == max_iterations)
                return worst <= acceptable &&
                       sizes_.moved <= acceptable * total_length_; // links that alternate between taut and slack
            Base::solve();
            take_step(i >= undecided_after && !convex_ ? 0.5 : 1);
        }
    }

    /// For a convex set: releases the link that pushes most. False if none pushes.
    bool releases_strongest_push() {
        if (!convex_) return false;
        auto* strongest = links_.strongest_push(slight_);
        if (strongest) strongest->side = 0, strongest->tension = 0, let_go_ = true;
        return strongest != nullptr;
    }

    Vector flight(Rule rule, const BlockNode<D>& node) const {
        return rule == Rule::static_projection ? Vector{} : node.velocity * h_;
    }

    /// Displacement from which the iteration starts: the free flight. Light parts whirl too fast for that, and heavy
    /// ones hardly move in a substep.
    Vector guess(Rule rule, const BlockNode<D>& node) const {
        return links_.uses_shares() ? Vector{} : flight(rule, node);
    }

    /// Sets inertia and the positions without constraints, and chooses the active limits.
    void set_out(Rule rule) {
        progress_ = {};
        const double share = rule == Rule::midpoint ? 0.5 : rule == Rule::backward_euler ? 1 : 0;
        for (auto& node : unknowns()) {
            node.inertia = node.mass * per_h_ * per_h_ * (rule == Rule::midpoint ? 2 : 1);
            node.predicted = node.start + flight(rule, node) + node.acceleration * (share * h_ * h_);
        }
        choose_active_limits(rule);
        slight_ = 1e-6 * Base::weight() * inverse_or_zero(total_length_) * double(block_.links + block_.ways);
    }

    /// Assembles the equations at the present positions. Returns the worst violation of a rigid link, relative to the
    /// length.
    double assemble(Rule rule) {
        for (auto& node : unknowns()) {
            node.diagonal = Matrix<D, double>::diagonal(node.inertia);
            node.residual = (node.predicted - node.position) * node.inertia;
        }
        clear_entries();
        const double hardest = links_.stiffness();
        double worst = links_.assemble(rule, elastic_, good_enough);
        worst = max(worst, small_angle * bends_.assemble(rule, hardest, good_enough / small_angle));
        worst = max(worst, ways_.assemble(rule, hardest, elastic_, good_enough));
        return worst;
    }

    /// Worst violation of links and angles at the present positions, scaled as in `assemble`.
    double worst_error() const { return max(links_.worst_error(), small_angle * bends_.worst_error()); }

    /// Trust region: the fraction of the step at which no link changes by more than `max_change`. Newton's model means
    /// nothing further out.
    double trusted_share() {
        double change2 = 0;
        sizes_.tightened = sizes_.strongest = 0;
        for (auto& link : links_.all()) {
            const auto change = node(link.b).displacement - node(link.a).displacement;
            change2 = max(change2, dot(change, change) * link.per_length2);
            link.pull += link.stiffness * dot(link.along, change);
            sizes_.tightened =
                max(sizes_.tightened, absolute(link.pull - link.tension) * link.length / links_.share(link));
            sizes_.strongest = max(sizes_.strongest, absolute(link.pull) * link.length);
        }
        change2 = max(change2, ways_.largest_change2());
        return change2 > square(max_change) ? max_change / square_root(change2) : 1;
    }

    bool is_steady() const {
        return sizes_.are_small(total_length_, links_.uses_shares()) &&
               (!is_precise_ || sizes_.are_rounding(total_length_));
    }

    void take_step(double max_share) {
        const double share = progress_.share = min(max_share, trusted_share());
        ++progress_.iteration;
        sizes_.moved_before = std::exchange(sizes_.moved, 0);
        for (auto& node : unknowns()) {
            node.position += node.displacement * share;
            sizes_.moved = max(sizes_.moved, largest_component(node.displacement));
        }
        MultiplierUpdate update{.share = share, .elastic = elastic_, .releases = releases_};
        for (auto& link : links_.all())
            if (!links_.soft(link)) update.renew(link, link.pull, slight_ * links_.share(link));
        const auto renew_driven = [&](auto& rows) {
            for (auto& row : rows.all()) {
                if (row.is_compliant()) continue;
                update.renew(row, row.pull + row.stiffness * rows.geometry().change(row), slight_);
                row.tension = clamp(row.tension, -row.max, row.max);
            }
        };
        renew_driven(bends_);
        renew_driven(ways_);
        let_go_ = let_go_ || update.any_released;
    }

    static double largest_component(const Vector& v) {
        double largest = 0;
        for (int i = 0; i < D; ++i) largest = max(largest, absolute(v[i]));
        return largest;
    }
};

} // namespace sinew::detail
