#include "sinew/solver/phases.h"
#include "sinew/solver/project.h"

/// Newton's method on all multipliers of a tree at once, in time linear in its edges.
///
/// An edge e joins a child c to its parent q with unit normal n (from q to c) and is corrected along d, its direction
/// when the substep began. Its multiplier changes by s so that, to first order, error + n.(move_c - move_q) + alpha
/// (lambda + s) = 0, while every particle obeys m move = sum of d s over its edges. Eliminated from the leaves up
/// (Featherstone 1983; Baraff 1996):
///
///     a particle with its subtree:  K move = bias + force of its own parent edge,    K = m + sum_children d n^T /
///     pivot pivot_e = n . K_c^-1 d + alpha          wanted_e = -(error + alpha lambda) - n . K_c^-1 bias_c to the
///     parent:                K_q += d n^T / pivot,    bias_q -= d wanted / pivot back down:                    s =
///     (wanted + n . move_q) / pivot,    move_c = K_c^-1 (bias_c + d s)
namespace sinew {
namespace {

template <int D, class Real> class TreeSolver {
  public:
    TreeSolver(World<D, Real>& world, const Tree& tree, Real h, bool first_iteration)
        : particles_(world.particles), distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          forest_(world.forest), tree_(tree), h_(h), per_h_(Real(1) / h), fresh_(first_iteration) {}

    /// False where Newton did not settle; then nothing has changed.
    bool run() {
        begin();
        Real before = limit::measure<Real>;
        for (int i = 0; i < most_steps; ++i) {
            const Real worst = linearise(i == 0);
            if (worst <= good_enough()) return true;
            if (worst > before * Real(2)) break;
            before = minimum(before, worst);
            eliminate();
            substitute();
        }
        if (linearise(false) <= acceptable) return true;
        take_back();
        return false;
    }

  private:
    static constexpr int most_steps = 8;
    /// Relative error of lengths at which Newton may stop: what rounding leaves.
    static constexpr Real good_enough() { return sizeof(Real) == 4 ? Real(2e-6) : Real(1e-11); }
    /// And the error up to which its last state is still better than a sweep's.
    static constexpr Real acceptable = Real(1e-4);
    /// A chain between two fixed points has nothing left to give at its second one; this, relative to what moves,
    /// stands in.
    static constexpr Real least_pivot = sizeof(Real) == 4 ? Real(1e-4) : Real(1e-9);

    Particles<D, Real>& particles_;
    Constraints<Distance<D>, Real>& distances_;
    Forest<D, Real>& forest_;
    const Tree& tree_;
    Real h_, per_h_;
    bool fresh_;

    const TreeEdge& edge(std::uint32_t k) const { return forest_.edges[tree_.first + k]; }
    std::uint32_t node(std::uint32_t k) const { return tree_.first_node + k; }
    Vec<D, Real> point(Row row) const {
        return clamp_components(particles_.position[row] + particles_.velocity[row] * h_, limit::coordinate<Real>);
    }
    Real alpha(Row constraint) const {
        return minimum(distances_.compliance[constraint] * per_h_ * per_h_, limit::measure<Real>);
    }

    void begin() {
        if (!fresh_) return;
        for (std::uint32_t k = 0; k < tree_.count; ++k) distances_.multiplier[edge(k).constraint] = Real(0);
    }

    /// Where the particles are now: normals, errors, and in the first round the directions. Returns the largest error,
    /// relative to the length.
    Real linearise(bool choose_directions) {
        Real worst = 0;
        for (std::uint32_t k = 0; k < tree_.count; ++k) {
            const auto& e = edge(k);
            const auto n = node(k);
            const auto now = point(e.child) - point(e.parent);
            const Real length = norm(now);
            forest_.normal[n] = now * inverse_or_zero(length);
            if (choose_directions) {
                constexpr Real least_agreement = Real(0.99);
                const auto then = direction(particles_.position[e.child] - particles_.position[e.parent]);
                forest_.along[n] = dot(then, forest_.normal[n]) >= least_agreement ? then : forest_.normal[n];
            }
            const Row c = e.constraint;
            const Real lambda = distances_.multiplier[c], give = alpha(c) * lambda;
            const Real below = length - distances_.low[c] + give, above = length - distances_.high[c] + give;
            // the side that holds, or that the constraint is beyond; neither: slack
            const bool pulls = above > Real(0) || lambda < Real(0), pushes = below < Real(0) || lambda > Real(0);
            const Real error = pulls ? above : pushes ? below : Real(0);
            forest_.wanted[n] = -error;
            forest_.pivot[n] = pulls || pushes ? Real(1) : Real(0);
            forest_.side[n] = distances_.low[c] == distances_.high[c] ? Real(0) : pulls ? Real(-1) : Real(1);
            worst = maximum(worst, absolute(error) * inverse_or_zero(pulls ? distances_.high[c] : distances_.low[c]));
        }
        return worst;
    }

    /// From the leaves to the root. move holds K^-1 bias of each node on the way.
    void eliminate() {
        for (std::uint32_t k = 0; k <= tree_.count; ++k) {
            forest_.stiffness[node(k)] = {};
            forest_.bias[node(k)] = {};
        }
        for (std::uint32_t k = 0; k < tree_.count; ++k) {
            const auto& e = edge(k);
            const auto n = node(k);
            const auto d = forest_.along[n], normal = forest_.normal[n];
            const Real w = particles_.mobility[e.child];
            auto yields = Vec<D, Real>{}; // K^-1 d
            forest_.moved[n] = {};
            if (w > Real(0)) {
                add_diagonal(forest_.stiffness[n], Real(1) / w);
                forest_.moved[n] = solve(forest_.stiffness[n], forest_.bias[n]);
                yields = solve(forest_.stiffness[n], d);
            }
            if (forest_.pivot[n] == Real(0)) continue; // slack: the subtree is on its own
            const Real least = least_pivot * maximum(w, particles_.mobility[e.parent]);
            forest_.pivot[n] = maximum(dot(normal, yields) + alpha(e.constraint), least);
            forest_.wanted[n] -= dot(normal, forest_.moved[n]);
            const Real per_pivot = Real(1) / forest_.pivot[n];
            add_outer(forest_.stiffness[e.parent_node], d * per_pivot, normal);
            forest_.bias[e.parent_node] -= d * (forest_.wanted[n] * per_pivot);
        }
    }

    /// From the root to the leaves: the multipliers' changes, held to the side they may act on; then what they do to
    /// velocities.
    void substitute() {
        const auto root = node(tree_.count);
        const Real w = particles_.mobility[edge(tree_.count - 1).parent];
        forest_.moved[root] = {};
        if (w > Real(0)) {
            add_diagonal(forest_.stiffness[root], Real(1) / w);
            forest_.moved[root] = solve(forest_.stiffness[root], forest_.bias[root]);
        }
        for (std::uint32_t k = tree_.count; k-- > 0;) {
            const auto& e = edge(k);
            const auto n = node(k);
            if (forest_.pivot[n] == Real(0)) continue;
            const auto normal = forest_.normal[n], d = forest_.along[n];
            const Real s = (forest_.wanted[n] + dot(normal, forest_.moved[e.parent_node])) / forest_.pivot[n];
            if (particles_.mobility[e.child] > Real(0)) forest_.moved[n] += solve(forest_.stiffness[n], d) * s;
            pull(k, d, s);
        }
    }

    void pull(std::uint32_t k, const Vec<D, Real>& d, Real s) {
        const auto& e = edge(k);
        auto& lambda = distances_.multiplier[e.constraint];
        const Real sign = forest_.side[node(k)]; // one-sided: a rope never pushes, a strut never pulls
        Real next = clamp(lambda + s, -limit::measure<Real>, limit::measure<Real>);
        if (sign < Real(0)) next = minimum(next, Real(0));
        if (sign > Real(0)) next = maximum(next, Real(0));
        apply(e, d, next - lambda);
        lambda = next;
    }

    void apply(const TreeEdge& e, const Vec<D, Real>& d, Real change) {
        const auto kick = d * (change * per_h_);
        particles_.velocity[e.child] += kick * particles_.mobility[e.child];
        particles_.velocity[e.parent] -= kick * particles_.mobility[e.parent];
    }

    void take_back() {
        for (std::uint32_t k = 0; k < tree_.count; ++k) {
            auto& lambda = distances_.multiplier[edge(k).constraint];
            apply(edge(k), forest_.along[node(k)], -lambda);
            lambda = Real(0);
        }
    }

    static void add_diagonal(Matrix<D, Real>& m, Real s) {
        for (int i = 0; i < D; ++i) m.column[std::size_t(i)][i] += s;
    }
};

} // namespace

template <int D, class Real> void solve_trees(World<D, Real>& world, Real h, bool first_iteration) {
    auto& forest = world.forest;
    for (const auto& tree : forest.trees) {
        const bool solved = TreeSolver(world, tree, h, first_iteration).run();
        for (std::uint32_t k = 0; k < tree.count; ++k)
            forest.in_tree[forest.edges[tree.first + k].constraint] = char(solved);
    }
}

#define SINEW_DIRECT(D, Real) template void solve_trees(World<D, Real>&, Real, bool);
SINEW_INSTANTIATE(SINEW_DIRECT)

} // namespace sinew
