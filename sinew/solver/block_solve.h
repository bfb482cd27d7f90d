#pragma once

#include "sinew/solver/block_equations.h"

/// One substep of one block: Newton's method on
///
///     sum inertia/2 |x - aim|^2  +  sum tension C + k/2 C^2,        C = (|x_b - x_a|^2 - limit^2) / 2
///
/// the augmented Lagrangian of its links, their geometric stiffness kept, the tensions of the last substep for a start.
/// Each iteration gains about four digits, whatever the masses.
namespace sinew::detail {

/// How far a solve has come.
struct SolveProgress {
    int iteration = 0;
    double share = 0; ///< of its move that each node went in the last iteration
};

template <int D> class BlockSolve : public BlockEquations<D> {
    using Base = BlockEquations<D>;

  public:
    using Base::Base, Base::links, Base::unknowns, Base::soft, Base::bounces;
    using typename Base::Vector;
    BlockNode<D>& node(std::uint32_t i) const { return Base::node(i); }

    /// The length of all links.
    double reach() const { return reach_; }
    const SolveProgress& progress() const { return progress_; }

    /// From now on lengths that cannot be kept are shared out, as by very stiff springs.
    void be_elastic() { elastic_ = true; }

    /// From now on joints swing past their ends, and bounce from them afterwards (block_bounce.h).
    void let_bounce() { bounce_ = true; }

    /// Which limits hold when the substep begins.
    void choose_sides(Rule rule) {
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

    /// Finds every `place`. `hold()` adds what else acts on the nodes to their equations. False where it did
    /// not converge.
    template <class Hold> bool run(Rule rule, int most_iterations, Hold&& hold) {
        set_out(rule);
        for (auto& node : unknowns()) node.place = node.start + flight(rule, node);
        return iterate(rule, most_iterations, hold);
    }

    /// The same from a guess: places and tensions as they are.
    template <class Hold> bool run_again(Rule rule, int most_iterations, Hold&& hold) {
        set_out(rule);
        return iterate(rule, most_iterations, hold);
    }

    /// Whether what acts from outside decides as it did in the equations before; where nothing does, it has no say.
    template <class Hold> static bool agrees(Hold& hold) {
        if constexpr (std::is_void_v<decltype(hold())>)
            return true;
        else
            return hold();
    }

    /// One iteration more. False where that led away: a limit let go that should have held.
    template <class Hold> bool refine(Rule rule, Hold&& hold) {
        assemble(rule);
        hold();
        Base::solve();
        take_step(1);
        return worst_error() <= acceptable;
    }

    /// How far the worst joint that bounces has gone beyond its end, and beyond where it began.
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

    /// Where Newton does not find the lengths: sweeps over the links come nearer to them.
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

  private:
    static constexpr double good_enough = 1e-7;
    static constexpr double braces_give = 1e-6;
    static constexpr double hardly = 1e-5;        ///< a move after which the next would be too small to matter
    static constexpr double hardly_pulled = 3e-3; ///< the same of a tension
    static constexpr double acceptable = 1e-5;
    static constexpr double absurd = 100;
    static constexpr int undecided_after = 8;  ///< iterations: then half steps, which settle what goes to and fro
    static constexpr double slight = 1e-3;     ///< a move, as a part of a link
    static constexpr int patience = 10;        ///< iterations
    static constexpr double most_change = 0.5; ///< of a link in one iteration, as a share of its length
    static constexpr double as_good_as_taut = 1e-4;
    static constexpr double small_angle = 1e-2; ///< an angle's error counts as this part of a length's
    static constexpr int most_flips = 2;

    using Base::add, Base::clear_entries, Base::bends_, Base::ways_, Base::block_, Base::h_, Base::per_h_;
    double reach_ = 0;
    SolveProgress progress_{};
    double moved_ = 0, tightened_ = 0, strongest_ = 0; ///< by an iteration: the most of any node and link
    bool elastic_ = false, bounce_ = false;
    bool let_go_ = false; ///< a limit, since patience was last asked
    double slight_ = 0;   ///< a tension that is none

    double mobility(std::uint32_t i) const {
        return i < block_.first_node + block_.unknowns ? inverse_or_zero(node(i).mass) : 0;
    }

    template <class Hold> bool iterate(Rule rule, int most_iterations, Hold&& hold) {
        double before = 0, last = 0;
        for (int i = 0;; ++i) {
            if (i > 0 && steady() && worst_error() <= good_enough && agrees(hold)) return true;
            const double worst = assemble(rule);
            hold();
            if (i > 0 && !(worst <= absurd)) return false;
            if (i > 1 && block_.braced() && worst <= braces_give && worst > 0.5 * last && moved_ <= hardly * reach_)
                return true; // braces in a plane: Newton does not come nearer
            last = worst;
            if (i % patience == 0) { // a solution that exists comes nearer
                if (i > 0 && !let_go_ && worst > 0.5 * before && worst > acceptable) return false;
                before = worst;
                let_go_ = false; // a rope that falls slack does so link by link
            }
            // what cannot decide whether it touches: its lengths are right, and it hardly moves
            const double slight_move = slight * reach_ / double(block_.links + block_.ways);
            if (rule == Rule::implicit && i >= undecided_after && worst <= acceptable && moved_ <= slight_move)
                return true;
            if (i == most_iterations)
                return worst <= acceptable && moved_ <= acceptable * reach_; // links that cannot decide to be taut
            Base::solve();
            take_step(i >= undecided_after ? 0.5 : 1);
        }
    }

    Vector flight(Rule rule, const BlockNode<D>& node) const {
        return rule == Rule::place ? Vector{} : node.velocity * h_;
    }

    /// Where it would go by itself.
    void set_out(Rule rule) {
        progress_ = {};
        const double share = rule == Rule::swing ? 0.5 : rule == Rule::implicit ? 1 : 0;
        for (auto& node : unknowns()) {
            node.inertia = node.mass * per_h_ * per_h_ * (rule == Rule::swing ? 2 : 1);
            node.aim = node.start + flight(rule, node) + node.push * (share * h_ * h_);
        }
        choose_sides(rule);
        slight_ = 1e-6 * Base::weight() * inverse_or_zero(reach_) * double(block_.links + block_.ways);
    }

    /// Which limit holds when the substep begins. What is as good as taut counts as taut: else a falling rope would
    /// tighten link by link.
    void choose_side(BlockLink<D>& link) const {
        link.flips = 0;
        link.give = 0;
        if (bounces(link)) return rest_on_end(link);
        link.side = link.low == link.high || link.tension > 0 ? 1 : link.tension < 0 ? -1 : 0;
        if (link.side != 0) return;
        const double length = norm(link.start), margin = as_good_as_taut * link.length;
        link.side = length > link.high - margin ? 1 : length < link.low + margin ? -1 : 0;
    }

    /// Of one that bounces: only the end that it rests on holds, as far out as it is.
    static void rest_on_end(BlockLink<D>& link) {
        constexpr double hardly_short = 1e-6;
        const double length2 = dot(link.start, link.start), margin = hardly_short * square(link.length);
        const double above = 0.5 * (length2 - square(link.high)), below = 0.5 * (length2 - square(link.low));
        link.side = link.tension > 0 && above > -margin ? 1 : link.tension < 0 && below < margin ? -1 : 0;
        link.give = link.side > 0 ? maximum(above, 0.0) : link.side < 0 ? minimum(below, 0.0) : 0;
    }

    /// The equations at the present places. Returns the worst violation of a rigid link, relative to its length.
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
            const double k = hardest * link.per_length2;
            const double length2 = dot(now, now);
            const double above = 0.5 * (length2 - square(link.high)), below = 0.5 * (length2 - square(link.low));
            if (link.side == 0 && !bounces(link)) link.come_to_a_limit(above, below, good_enough * square(link.length));
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

    /// What `assemble` would return, without the equations.
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

    /// A soft link: its force is what it is, and needs no multiplier.
    void spring(Rule rule, BlockLink<D>& link, const Vector& now) {
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

    /// No link changes by more than its own length at once: further out, Newton's model of it means nothing.
    double trusted_share() {
        double most = 0;
        tightened_ = strongest_ = 0;
        for (auto& link : links()) {
            const auto change = node(link.b).move - node(link.a).move;
            most = maximum(most, dot(change, change) * link.per_length2);
            link.pull += link.stiffness * dot(link.along, change);
            tightened_ = maximum(tightened_, absolute(link.pull - link.tension) * link.length);
            strongest_ = maximum(strongest_, absolute(link.pull) * link.length);
        }
        most = maximum(most, ways_.largest_change2());
        return most > square(most_change) ? most_change / square_root(most) : 1;
    }

    bool steady() const { return moved_ <= hardly * reach_ && tightened_ <= hardly_pulled * strongest_; }

    void take_step(double most) {
        const double share = progress_.share = minimum(most, trusted_share());
        ++progress_.iteration;
        moved_ = 0;
        for (auto& node : unknowns()) {
            node.place += node.move * share;
            moved_ = maximum(moved_, largest_component(node.move));
        }
        for (auto& link : links())
            if (!soft(link)) renew(link, link.pull, share);
        for (auto& bend : bends_.all())
            if (!bends_.soft(bend)) {
                renew(bend, bend.pull + bend.stiffness * bends_.change(bend), share);
                bend.tension = clamp(bend.tension, -bend.most, bend.most);
            }
        for (auto& way : ways_.all())
            if (!ways_.soft(way)) {
                renew(way, way.pull + way.stiffness * ways_.change(way), share);
                way.tension = clamp(way.tension, -way.most, way.most);
            }
    }

    /// The multiplier that goes with the places just found. One that holds the wrong way lets go, unless it cannot
    /// decide.
    void renew(BlockLimit& limit, double next, double share) {
        if (elastic_) {
            limit.tension = 0;
            limit.side = limit.one_sided() && next * limit.side < 0 ? 0 : limit.side;
            return;
        }
        limit.tension = limit.side != 0 ? limit.tension + share * (next - limit.tension) : 0;
        const bool undecided = limit.flips > most_flips;
        if (limit.one_sided() && !undecided && next * limit.side < -slight_)
            limit.side = 0, limit.tension = 0, let_go_ = true;
    }

    static double largest_component(const Vector& v) {
        double most = 0;
        for (int i = 0; i < D; ++i) most = maximum(most, absolute(v[i]));
        return most;
    }
};

} // namespace sinew::detail
