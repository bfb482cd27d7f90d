#pragma once

#include "sinew/constraint/angle.h"
#include "sinew/solver/block_matrix.h"
#include "sinew/solver/block_way.h"
#include "sinew/solver/project.h"

/// One substep of one block: Newton's method on
///
///     sum inertia/2 |x - aim|^2  +  sum tension C + k/2 C^2,        C = (|x_b - x_a|^2 - limit^2) / 2
///
/// the augmented Lagrangian of its links, their geometric stiffness kept, the tensions of the last substep for a start.
/// Each iteration gains about four digits, whatever the masses.
namespace sinew::detail {

template <int D> class BlockSolve {
  public:
    using Vector = Vec<D, double>;

    BlockSolve(Blocks<D>& blocks, const Block& block, double substep)
        : blocks_(blocks), block_(block), ways_(blocks, block, substep), h_(substep), per_h_(1 / substep) {
        for (const auto& node : unknowns()) total_mass_ += node.mass;
        stiffness_ = relative_stiffness * total_mass_ * per_h_ * per_h_;
    }

    std::span<BlockNode<D>> nodes() const { return std::span(blocks_.nodes).subspan(block_.first_node, block_.nodes); }
    std::span<BlockNode<D>> unknowns() const {
        return std::span(blocks_.nodes).subspan(block_.first_node, block_.unknowns);
    }
    std::span<BlockLink<D>> links() const { return std::span(blocks_.links).subspan(block_.first_link, block_.links); }
    std::span<BlockBend<D>> bends() const { return std::span(blocks_.bends).subspan(block_.first_bend, block_.bends); }
    const BlockWays<D>& ways() const { return ways_; }
    double stiffness() const { return stiffness_; }
    /// The length of all links.
    double reach() const { return reach_; }

    /// From now on lengths that cannot be kept are shared out, as by very stiff springs.
    void be_elastic() { elastic_ = true; }

    /// Finds every `place`. `hold(assemble)` adds what else acts on the nodes to their equations. False where it did
    /// not converge.
    template <class Hold> bool run(Rule rule, int most_iterations, Hold&& hold) {
        set_out(rule);
        double before = 0;
        for (int i = 0;; ++i) {
            if (i > 0 && steady() && worst_error() <= good_enough) return true;
            const double worst = assemble(rule);
            hold();
            if (i > 0 && !(worst <= absurd)) return false;
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
            solve_block(blocks_, block_);
            take_step(i >= undecided_after ? 0.5 : 1);
        }
    }

    /// How far the worst rigid link is outside its limits, as Green's strain, at the places or at the start.
    template <class At> double worst_strain(At&& at) const {
        double worst = 0;
        for (const auto& link : links()) {
            if (soft(link)) continue;
            const auto span = at(node(link.b)) - at(node(link.a));
            const double length2 = dot(span, span);
            const double error = maximum(length2 - square(link.high), square(link.low) - length2);
            worst = maximum(worst, 0.5 * error * link.per_length2);
        }
        return worst;
    }
    double worst_start_strain() const { return maximum(worst_strain(start_of), ways_.worst_strain(true)); }
    double worst_place_strain() const { return maximum(worst_strain(place_of), ways_.worst_strain(false)); }
    static const Vector& start_of(const BlockNode<D>& node) { return node.start; }
    static const Vector& place_of(const BlockNode<D>& node) { return node.place; }

    /// What the constraints did to the velocities is not along the links: those that pull keep the lengths they have
    /// (n . v = 0), for the least change of momentum. `hold(assemble)` as above, for velocities.
    template <class Hold> void settle(Hold&& hold) {
        constexpr double relative = 1e3;
        constexpr int rounds = 3;
        for (auto& link : links()) link.pull = 0;
        for (auto& bend : bends()) bend.pull = 0, measure(bend);
        ways_.begin_settling();
        for (auto& node : nodes()) node.aim = node.velocity;
        for (int i = 0; i < rounds; ++i) {
            for (auto& node : unknowns()) {
                node.diagonal = Matrix<D, double>::diagonal(node.mass);
                node.residual = (node.aim - node.velocity) * node.mass;
            }
            clear_entries();
            for (auto& link : links()) {
                link.along = node(link.b).place - node(link.a).place;
                const double k = relative * total_mass_ * link.per_length2;
                const double rate = dot(link.along, node(link.b).velocity - node(link.a).velocity);
                const double pull = link.pull + k * rate;
                const bool resists =
                    !link.one_sided() || (link.tension > 0 && pull > 0) || (link.tension < 0 && pull < 0);
                link.stiffness = resists && !soft(link) ? k : 0;
                if (link.stiffness == 0) continue;
                link.pull = pull;
                add(link, outer(link.along * k, link.along), link.along * pull);
            }
            for (auto& bend : bends()) {
                double rate = -bend.rate;
                for (std::size_t k = 0; k < 3; ++k) rate += dot(bend.gradient[k], node(bend.nodes[k]).velocity);
                const double k = relative * total_mass_ * arm2(bend);
                const double pull = bend.pull + k * rate;
                const bool resists =
                    bend.side != 0 && !soft(bend) && !bend.slips && (!bend.one_sided() || pull * bend.side > 0);
                bend.stiffness = resists ? k : 0;
                if (resists) add(bend, bend.pull = pull);
            }
            ways_.settle(relative * total_mass_);
            hold(relative * total_mass_);
            solve_block(blocks_, block_);
            for (auto& node : unknowns()) node.velocity += node.move;
            for (auto& link : links())
                if (link.stiffness > 0)
                    link.pull += link.stiffness * dot(link.along, move_of(node(link.b)) - move_of(node(link.a)));
            for (auto& bend : bends())
                if (bend.stiffness > 0) bend.pull += bend.stiffness * turn_of(bend);
            ways_.end_round();
        }
    }

    /// Where Newton does not find the lengths: sweeps over the links come nearer to them.
    void sweep() {
        constexpr int rounds = 20;
        for (auto& node : unknowns()) node.place = node.start;
        for (int i = 0; i < rounds; ++i)
            for (auto& link : links()) {
                auto &a = node(link.a), &b = node(link.b);
                const double wa = weight(link.a), wb = weight(link.b);
                const auto now = b.place - a.place;
                const double length = norm(now);
                const auto correction = now * ((length - clamp(length, link.low, link.high)) * inverse_or_zero(length) *
                                               inverse_or_zero(wa + wb));
                a.place += correction * wa;
                b.place -= correction * wb;
            }
    }

    /// Whether velocities would lengthen links, as after a blow: by more than a swing does in a substep.
    bool jolted() const {
        const double usual = block_.motored ? 1e-4 : 0.02; // what is driven starts and stops, and must not ring on
        for (const auto& link : links()) {
            if (soft(link) || (link.one_sided() && link.tension == 0)) continue;
            const auto span = node(link.b).place - node(link.a).place;
            const double rate = dot(span, node(link.b).velocity - node(link.a).velocity);
            if (absolute(rate) * h_ > usual * square(link.length)) return true;
        }
        return ways_.jolted(usual);
    }

    /// Half the sum of m v^2.
    double kinetic() const {
        double sum = 0;
        for (const auto& node : unknowns()) sum += 0.5 * node.mass * dot(node.velocity, node.velocity);
        return sum;
    }

    double stored(const BlockLink<D>& link, const Vector& span) const {
        if (!soft(link)) return 0;
        const double length = norm(span);
        return 0.5 * square(length - clamp(length, link.low, link.high)) / link.compliance;
    }

    double stored(const BlockBend<D>& bend, double angle) const {
        return soft(bend) ? 0.5 * square(angle - clamp(angle, bend.low, bend.high)) / bend.compliance : 0;
    }
    /// Its angle, at the places or at the start.
    template <class At> double angle_of(const BlockBend<D>& bend, At&& at) const {
        const Points<3, D, double> points{at(node(bend.nodes[0])), at(node(bend.nodes[1])), at(node(bend.nodes[2]))};
        return unwrap<Angle<D>>(Angle<D>::evaluate(points).value, bend.low, bend.high);
    }
    bool any_bend_struck() const {
        for (const auto& bend : bends())
            if (bend.side != 0 && bend.one_sided() && !soft(bend)) return true;
        return false;
    }

    BlockNode<D>& node(std::uint32_t i) const { return blocks_.nodes[i]; }
    const Vector& move_of(const BlockNode<D>& node) const { return node.move; } // zero of what is fixed

  private:
    static constexpr double relative_stiffness = 1e4; ///< of a rigid link, over all mass / h^2
    static constexpr double good_enough = 1e-7;
    static constexpr double hardly = 1e-5;        ///< a move after which the next would be too small to matter
    static constexpr double hardly_pulled = 1e-3; ///< the same of a tension
    static constexpr double acceptable = 1e-5;
    static constexpr double absurd = 100;
    static constexpr int undecided_after = 8;  ///< iterations: then half steps, which settle what goes to and fro
    static constexpr double slight = 1e-3;     ///< a move, as a part of a link
    static constexpr int patience = 10;        ///< iterations
    static constexpr double most_change = 0.5; ///< of a link in one iteration, as a share of its length
    static constexpr double as_good_as_taut = 1e-4;
    static constexpr double small_angle = 1e-2; ///< an angle's error counts as this part of a length's
    static constexpr int most_flips = 2;

    Blocks<D>& blocks_;
    const Block& block_;
    BlockWays<D> ways_;
    double h_, per_h_;
    double total_mass_ = 0, stiffness_ = 0, reach_ = 0;
    double moved_ = 0, tightened_ = 0, strongest_ = 0; ///< by an iteration: the most of any node and link
    bool elastic_ = false;
    bool let_go_ = false; ///< a limit, since patience was last asked
    double slight_ = 0;   ///< a tension that is none

    double weight(std::uint32_t i) const {
        return i < block_.first_node + block_.unknowns ? inverse_or_zero(node(i).mass) : 0;
    }

    /// A spring; one so stiff that the penalty is softer is as good as rigid.
    bool soft(const BlockLink<D>& link) const { return link.compliance * stiffness_ > 1; }
    bool soft(const BlockBend<D>& bend) const { return bend.compliance > 0; }

    void clear_entries() {
        const auto begin = blocks_.first_entry[block_.first_node];
        const auto end = blocks_.first_entry[block_.first_node + block_.unknowns];
        for (auto e = begin; e < end; ++e) blocks_.entries[e].lower = blocks_.entries[e].upper = {};
    }

    /// Where it would go by itself, and a first guess.
    void set_out(Rule rule) {
        const double share = rule == Rule::swing ? 0.5 : rule == Rule::implicit ? 1 : 0;
        for (auto& node : unknowns()) {
            node.inertia = node.mass * per_h_ * per_h_ * (rule == Rule::swing ? 2 : 1);
            const auto flight = rule == Rule::place ? Vector{} : node.velocity * h_;
            node.place = node.start + flight;
            node.aim = node.place + node.push * (share * h_ * h_);
        }
        reach_ = 0;
        for (auto& link : links()) {
            link.start = node(link.b).start - node(link.a).start;
            reach_ += link.length;
            choose_side(link);
        }
        for (auto& bend : bends()) {
            bend.flips = 0;
            const double angle = bend.begun = angle_of(bend, start_of);
            bend.slips = false, bend.doubts = 0;
            const bool exact = !bend.one_sided();
            bend.side = exact || bend.tension > 0 || angle > bend.high ? 1
                        : bend.tension < 0 || angle < bend.low         ? -1
                                                                       : 0;
        }
        double weight = 0;
        for (const auto& node : unknowns()) weight += node.mass * norm(node.push);
        reach_ += ways_.set_out(as_good_as_taut);
        slight_ = 1e-6 * weight * inverse_or_zero(reach_) * double(block_.links + block_.ways);
    }

    /// Which limit holds when the substep begins. What is as good as taut counts as taut: else a falling rope would
    /// tighten link by link.
    void choose_side(BlockLink<D>& link) const {
        link.flips = 0;
        const double length = norm(link.start), margin = as_good_as_taut * link.length;
        const bool exact = link.low == link.high;
        if (exact || link.tension > 0 || (link.tension == 0 && length > link.high - margin))
            link.side = 1;
        else
            link.side = link.tension < 0 || length < link.low + margin ? -1 : 0;
    }

    static void come_to_a_limit(BlockLimit& limit, double above, double below, double margin) {
        if (!(above > margin || below < -margin)) return;
        limit.side = above > margin ? 1 : -1;
        ++limit.flips;
    }

    [[gnu::always_inline]] void add(const BlockLink<D>& link, const Matrix<D, double>& stiffness, const Vector& force) {
        auto &a = node(link.a), &b = node(link.b);
        a.diagonal += stiffness;
        b.diagonal += stiffness;
        if (link.entry != Blocks<D>::none) {
            blocks_.entries[link.entry].lower -= stiffness;
            blocks_.entries[link.entry].upper -= stiffness;
        }
        a.residual += force;
        b.residual -= force;
    }

    /// The equations at the present places. Returns the worst violation of a rigid link, relative to its length.
    double assemble(Rule rule) {
        for (auto& node : unknowns()) {
            node.diagonal = Matrix<D, double>::diagonal(node.inertia);
            node.residual = (node.aim - node.place) * node.inertia;
        }
        clear_entries();
        const double hardest = stiffness();
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
            if (link.side == 0) come_to_a_limit(link, above, below, good_enough * square(link.length));
            const double error = link.side > 0 ? above : link.side < 0 ? below : 0;
            worst = maximum(worst, absolute(error) * link.per_length2);
            link.pull = link.side != 0 ? link.tension + k * error : 0;
            link.stiffness = link.side != 0 ? k : 0;
            if (link.side == 0) continue;
            const bool swings = rule == Rule::swing;
            const auto along = swings ? (link.start + now) * 0.5 : now;
            link.along = now;
            auto matrix = outer(along * k, now);
            if (rule != Rule::place)
                matrix +=
                    Matrix<D, double>::diagonal(maximum(elastic_ ? link.pull : link.tension, 0.0) * (swings ? 0.5 : 1));
            add(link, matrix, along * link.pull);
        }
        for (auto& bend : bends()) worst = maximum(worst, small_angle * bend_back(rule, bend, hardest));
        worst = maximum(worst, ways_.assemble(rule, hardest, elastic_, good_enough));
        return worst;
    }

    static double outside(const BlockLimit& limit, double above, double below) {
        return limit.side > 0 ? absolute(above) : limit.side < 0 ? absolute(below) : maximum(above, -below);
    }

    /// What `assemble` would return, without the equations.
    double worst_error() {
        double worst = 0;
        for (const auto& link : links()) {
            if (soft(link)) continue;
            const auto now = node(link.b).place - node(link.a).place;
            const double length2 = dot(now, now);
            const double above = length2 - square(link.high), below = length2 - square(link.low);
            worst = maximum(worst, 0.5 * outside(link, above, below) * link.per_length2);
        }
        for (const auto& bend : bends()) {
            if (soft(bend)) continue;
            const double angle = angle_of(bend, place_of);
            worst = maximum(worst, small_angle * outside(bend, angle - bend.high, angle - bend.low));
        }
        return worst;
    }

    // --- angles -----------------------------------------------------------------------------------------------------

    double measure(BlockBend<D>& bend) const {
        const Points<3, D, double> points{node(bend.nodes[0]).place, node(bend.nodes[1]).place,
                                          node(bend.nodes[2]).place};
        const auto evaluated = Angle<D>::evaluate(points);
        for (std::size_t k = 0; k < 3; ++k) bend.gradient[k] = gentle<Angle<D>>(evaluated.gradient[k]);
        return unwrap<Angle<D>>(evaluated.value, bend.low, bend.high);
    }

    /// The square of an angle's lever: an angle as stiff as a link of that length.
    static double arm2(const BlockBend<D>& bend) {
        double steepest = 0;
        for (const auto& gradient : bend.gradient) steepest = maximum(steepest, dot(gradient, gradient));
        return inverse_or_zero(steepest);
    }

    /// Returns how far the angle is outside its limits.
    double bend_back(Rule rule, BlockBend<D>& bend, double hardest) {
        const double angle = measure(bend);
        bend.stiffness = 0;
        if (rule == Rule::place && bend.driven) return 0; // no time passes: it gives
        if (soft(bend)) {
            const double error = angle - clamp(angle, bend.low, bend.high);
            if (error == 0 || rule == Rule::place) return 0;
            const double k = minimum(1 / bend.compliance, hardest * arm2(bend));
            bend.tension =
                bend.held(k * (error + bend.lead * ((angle - bend.begun) / h_ - bend.rate)), bend.tension, false);
            bend.stiffness = bend.slips ? 0 : k * (1 + bend.lead / h_);
            add(bend, bend.tension);
            return 0;
        }
        const double above = angle - bend.high, below = angle - bend.low;
        if (bend.side == 0) come_to_a_limit(bend, above, below, good_enough / small_angle);
        if (bend.side == 0) return 0;
        const double error = bend.side > 0 ? above : below;
        bend.stiffness = hardest * arm2(bend);
        bend.pull = bend.held(bend.tension + bend.stiffness * error, bend.tension, false);
        if (bend.slips) bend.stiffness = 0;
        add(bend, bend.pull);
        return bend.slips ? 0 : absolute(error);
    }

    void add(const BlockBend<D>& bend, double torque) {
        for (std::size_t i = 0; i < 3; ++i) {
            auto& at = node(bend.nodes[i]);
            const auto& gradient = bend.gradient[i];
            at.residual -= gradient * torque;
            at.diagonal += outer(gradient * bend.stiffness, gradient);
            if (bend.entries[i] == Blocks<D>::none) continue;
            const auto j = (i + 1) % 3;
            const auto& other = bend.gradient[j];
            const bool in_order = bend.nodes[i] < bend.nodes[j];
            const auto &early = in_order ? gradient : other, &late = in_order ? other : gradient;
            blocks_.entries[bend.entries[i]].lower += outer(late * bend.stiffness, early);
            blocks_.entries[bend.entries[i]].upper += outer(early * bend.stiffness, late);
        }
    }

    /// How much the last move turned it, to first order.
    double turn_of(const BlockBend<D>& bend) const {
        double turn = 0;
        for (std::size_t k = 0; k < 3; ++k) turn += dot(bend.gradient[k], move_of(node(bend.nodes[k])));
        return turn;
    }

    // --- links ------------------------------------------------------------------------------------------------------

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
            const auto change = move_of(node(link.b)) - move_of(node(link.a));
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
        const double share = minimum(most, trusted_share());
        moved_ = 0;
        for (auto& node : unknowns()) {
            node.place += node.move * share;
            moved_ = maximum(moved_, largest_component(node.move));
        }
        for (auto& link : links())
            if (!soft(link)) renew(link, link.pull, share);
        for (auto& bend : bends())
            if (!soft(bend)) {
                renew(bend, bend.pull + bend.stiffness * turn_of(bend), share);
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
