#pragma once

#include "sinew/solver/simd/chain_pack.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/simd/lane_swing.h"

/// Newton's step of chains side by side in lanes, and the active set of their links.
namespace sinew {
namespace {

template <int D, class V> class ChainEquations : protected LaneSwing<D, V> {
    using Base = LaneSwing<D, V>;

  public:
    using Node = ChainNode<D, V>;

  protected:
    using Base::far2_, Base::moved2_, Base::number, Base::of, Base::at, Base::half_h2_, Base::min_pull_;
    using typename Base::Mask;
    using typename Base::Pair;

    ChainPack<D>& pack_;
    Node* nodes_;
    int links_;
    V slight_;      ///< multiplier that counts as zero, kg
    V flipped_{};   ///< 1: the active set changed in this iteration
    V tightened_{}; ///< 1: a link that pulled nothing at the start is active

    explicit ChainEquations(ChainPack<D>& pack)
        : Base(pack), pack_(pack), nodes_(reinterpret_cast<Node*>(pack.nodes)), links_(pack.links),
          slight_(of(pack.weight_length) * half_h2_ * number(1e-6 * pack.links) /
                  (of(pack.total_length) * of(pack.total_length))) {}

    static Mask pulls_only(const Node& node) { return node.pulls_only > V{}; }

    /// Eliminates each node with the multiplier of its link, from the last to the first. With S the matrix of a node, N
    /// its inverse, g the geometric stiffness, a the direction of the force, e the link, and f the multiplier,
    ///
    ///     S d = r + g d_before - f a          e . (d - d_before) = -C
    ///     f = (C + e N r - q . d_before) / (e N a),   q = e - g N^T e,   p = a - g N a
    ///     S_before += g - g^2 N + p q^T / (e N a),    r_before += g N r + p (C + e N r) / (e N a)
    void eliminate() {
        Square<D, V> s{};
        Pair r{};
        const V half = number(0.5);
        for (int i = links_; i > 0; --i) {
            auto& node = nodes_[i];
            const Pair e = at(node.span), a = (at(node.begun) + e) * half;
            const V g = max(node.pull, V{}) * half; // none of a slack link, whose multiplier is zero
            r = r + (at(node.predicted) - at(node.position)) * node.mass;
            s.add_to_diagonal(node.mass + g);
            V determinant;
            const auto n = adjugate(s, determinant);
            const Pair u = n * a, w = e * n, y = n * r;
            const V resistance = node.holds > V{} ? dot(e, u) : number(1),
                    both_inverse = number(1) / (determinant * resistance);
            const V per = resistance * both_inverse, stiffness = determinant * determinant * both_inverse * node.holds;
            const V gp = g * per;
            const Pair q = e - w * gp, p = (a - u * gp) * stiffness;
            const V error = (dot(e, e) - node.length2) * half + dot(w, r) * per;
            (y * per).to(node.displacement);
            (u * per).to(node.lever);
            q.to(node.across);
            node.error = error;
            node.stiffness = stiffness;
#pragma GCC unroll 3
            for (int k = 0; k < D; ++k)
#pragma GCC unroll 3
                for (int j = 0; j < D; ++j) {
                    const V carried = n.at[D * k + j] * gp;
                    node.carried[D * k + j] = carried;
                    s.at[D * k + j] = p.at[k] * q.at[j] - carried * g;
                }
            s.add_to_diagonal(g);
            r = at(node.displacement) * g + p * error;
        }
    }

    void substitute_back() {
        far2_ = moved2_ = V{};
        Pair d{};
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            const V f = (node.error - dot(at(node.across), d)) * node.stiffness;
            Square<D, V> carried;
#pragma GCC unroll 9
            for (int k = 0; k < D * D; ++k) carried.at[k] = node.carried[k];
            const Pair before = d;
            d = at(node.displacement) + carried * d - at(node.lever) * f;
            d.to(node.displacement);
            node.next = f;
            const Pair change = d - before;
            far2_ = max(dot(change, change) * node.per_length2, far2_);
            moved2_ = max(dot(d, d), moved2_);
        }
    }

    /// Newton step of the active lanes, within the trust region. Returns the worst error of a length, relative.
    V take_step(const Mask& active) {
        const V share = Base::trusted_share();
        V worst{};
        Pair before = at(nodes_[0].position);
        min_pull_ = number(1);
        flipped_ = tightened_ = V{};
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            Base::move(node.position, at(node.displacement) * share, active);
            node.pull = active ? node.pull + (node.next - node.pull) * share : node.pull;
            const Pair position = at(node.position), span = position - before;
            span.to(node.span);
            before = position;
            const V error = (dot(span, span) - node.length2) * node.per_length2;
            choose_side(node, error, active);
            worst = max(node.holds > V{} ? size_of(error) : error, worst);
            min_pull_ = pulls_only(node) ? min(node.pull, min_pull_) : min_pull_;
            tightened_ = both(both(pulls_only(node), node.tension <= V{}), node.pull > V{}) ? number(1) : tightened_;
        }
        return worst * number(0.5);
    }

    /// Releases a link that would push, unless it has become active too often, and activates a slack one that is too
    /// long: the active set of direct/multiplier_update.h. `error`: of the squared length, relative.
    void choose_side(Node& node, const V& error, const Mask& active) {
        constexpr double max_flips = 2, long_enough = 2e-7;
        const Mask may = both(active, pulls_only(node)), holds = node.holds > V{};
        const Mask released = both(both(may, holds), both(node.pull < -slight_, node.flips <= number(max_flips)));
        const Mask seized = both(without(may, holds), error > number(long_enough));
        node.holds = released ? V{} : seized ? number(1) : node.holds;
        node.pull = released ? V{} : node.pull;
        node.flips = seized ? node.flips + number(1) : node.flips;
        flipped_ = (released | seized) ? number(1) : flipped_;
    }
};

} // namespace
} // namespace sinew
