#include "sinew/solver/phases.h"
#include "sinew/solver/tree_solve.h"

namespace sinew {
namespace {

/// Hands a tree's particles and constraints to the solve and takes back what came of it.
template <int D, class Real> class Exchange {
  public:
    Exchange(World<D, Real>& world, const Tree& tree)
        : p_(world.particles), d_(std::get<kind_number<Distance, D>>(world.constraints)), f_(world.forest),
          tree_(tree) {}

    void hand_over(bool first_iteration) {
        for (std::uint32_t k = 0; k < tree_.count; ++k) {
            const auto n = tree_.first_node + k;
            const Row c = edge(k).constraint;
            hand_over_node(n, edge(k).child);
            f_.low[n] = double(d_.low[c]);
            f_.high[n] = double(d_.high[c]);
            f_.compliance[n] = double(d_.compliance[c]);
            f_.warm[n] = double(d_.multiplier[c]);
            f_.multiplier[n] = first_iteration ? 0 : f_.warm[n];
        }
        hand_over_node(root(), root_row());
    }

    /// The start of the solve again, as if nothing had been tried.
    void begin_again() {
        for (auto n = tree_.first_node; n <= root(); ++n) {
            f_.velocity[n] = f_.predicted[n];
            f_.multiplier[n] = 0;
        }
    }

    void take_back(bool solved) {
        for (std::uint32_t k = 0; k < tree_.count; ++k) {
            const Row c = edge(k).constraint;
            f_.solved[c] = char(solved);
            if (!solved) continue;
            constexpr double most = double(limit::measure<Real>);
            d_.multiplier[c] = Real(clamp(f_.multiplier[tree_.first_node + k], -most, most));
            take_back_node(tree_.first_node + k, edge(k).child);
        }
        if (solved) take_back_node(root(), root_row());
    }

  private:
    Particles<D, Real>& p_;
    Constraints<Distance<D>, Real>& d_;
    Forest<D>& f_;
    const Tree& tree_;

    const TreeEdge& edge(std::uint32_t k) const { return f_.edges[tree_.first_edge + k]; }
    std::uint32_t root() const { return tree_.first_node + tree_.count; }
    Row root_row() const { return edge(tree_.count - 1).parent; }

    void hand_over_node(std::uint32_t n, Row row) {
        f_.place[n] = cast<double>(p_.position[row]) + cast<double>(p_.residual[row]);
        f_.velocity[n] = f_.predicted[n] = cast<double>(p_.velocity[row]);
        f_.mobility[n] = double(p_.mobility[row]);
    }

    void take_back_node(std::uint32_t n, Row row) {
        if (f_.mobility[n] > 0)
            p_.velocity[row] = cast<Real>(clamp_components(f_.velocity[n], double(limit::speed<Real>)));
    }
};

} // namespace

template <int D, class Real> void solve_trees(World<D, Real>& world, Real h, bool first_iteration) {
    for (const auto& tree : world.forest.trees) {
        Exchange exchange(world, tree);
        exchange.hand_over(first_iteration);
        bool solved = detail::SwingSolve<D>(world.forest, tree, double(h)).run();
        if (!solved) {
            exchange.begin_again();
            solved = detail::StiffSolve<D>(world.forest, tree, double(h)).run();
        }
        exchange.take_back(solved);
    }
}

#define SINEW_DIRECT(D, Real) template void solve_trees(World<D, Real>&, Real, bool);
SINEW_INSTANTIATE(SINEW_DIRECT)

} // namespace sinew
