#pragma once

#include "sinew/solver/direct.h"

#include <algorithm>

/// Two ways to solve a tree in time linear in its edges: one that keeps a swing's energy, and one that stands anything.
namespace sinew::detail {

/// One tree of a forest with the names of the equations. Edge k joins node k, the child, to its parent.
template <int D> class TreeView {
  public:
    using Vector = Vec<D, double>;

    TreeView(Forest<D>& forest, const Tree& tree, double substep)
        : f(forest), h(substep), per_h(1 / substep), tree_(tree) {}

    std::uint32_t edges() const { return tree_.count; }
    std::uint32_t node(std::uint32_t k) const { return tree_.first_node + k; }
    std::uint32_t root() const { return node(tree_.count); }
    std::uint32_t parent(std::uint32_t k) const { return f.edges[tree_.first_edge + k].parent_node; }

    Vector end_of(std::uint32_t n) const { return f.place[n] + f.velocity[n] * h; }
    Vector span(std::uint32_t k) const { return end_of(node(k)) - end_of(parent(k)); }
    double alpha(std::uint32_t n) const { return f.compliance[n] * per_h * per_h; }

    /// How far the worst rigid edge is outside its limits, relative to its length.
    double worst_strain() const {
        double worst = 0;
        for (std::uint32_t k = 0; k < edges(); ++k) {
            const auto n = node(k);
            if (f.compliance[n] > 0) continue;
            const double length = norm(span(k)), nearest = clamp(length, f.low[n], f.high[n]);
            worst = maximum(worst, absolute(length - nearest) * inverse_or_zero(nearest));
        }
        return worst;
    }

    Forest<D>& f;
    const double h, per_h;

  private:
    const Tree& tree_;
};

/// Newton on the multipliers. An edge e joins a child c to its parent q with unit normal n (from q to c) and is
/// corrected along d, its direction when the substep began, as a sweep would (SHAKE; see step.cpp). Its multiplier
/// changes by s so that, to first order, error + n . (move_c - move_q) + alpha s = 0, while every particle obeys m move
/// = sum of d s over its edges. Eliminated from the leaves to the root (Baraff 1996):
///
///     a node with its subtree:   K move = bias + d s of its own edge,    K = m + sum over children d n^T / pivot
///     pivot = n . K_c^-1 d + alpha                                       wanted = -error - n . K_c^-1 bias_c
///     for the parent:            K_q += d n^T / pivot,                   bias_q -= d wanted / pivot
///     back to the leaves:        s = (wanted + n . move_q) / pivot,      move_c = K_c^-1 (bias_c + d s)
template <int D> class SwingSolve : TreeView<D> {
  public:
    using TreeView<D>::TreeView;

    /// False where Newton did not settle or its solution would not be stable.
    bool run() {
        double before = largest;
        for (int i = 0; i <= most_steps; ++i) {
            const double worst = linearise(i == 0);
            if (worst <= good_enough) break;
            if (i == most_steps || worst > 2 * before) {
                if (worst > acceptable) return false;
                break;
            }
            before = minimum(before, worst);
            eliminate();
            substitute();
        }
        return stable();
    }

  private:
    using Base = TreeView<D>;
    using Base::f, Base::edges, Base::node, Base::parent, Base::root, Base::span, Base::alpha, Base::per_h;
    using typename Base::Vector;

    static constexpr int most_steps = 8;
    static constexpr double good_enough = 1e-11; ///< relative error of a length: what rounding leaves
    static constexpr double acceptable = 1e-6;   ///< where Newton has run out of steps
    static constexpr double largest = 1e300;
    /// A chain between two fixed points has nothing left to give at the second; this share of what moves stands in for
    /// it.
    static constexpr double least_pivot = 1e-9;

    /// Where the particles are going to be: normals and errors; in the first round also directions. Returns the largest
    /// error, relative to its length.
    double linearise(bool choose_directions) {
        constexpr double least_agreement = 0.99; // as in step.cpp
        double worst = 0;
        for (std::uint32_t k = 0; k < edges(); ++k) {
            const auto n = node(k), q = parent(k);
            const auto now = span(k);
            const double length = norm(now);
            f.normal[n] = now * inverse_or_zero(length);
            if (choose_directions) {
                const auto then = direction(f.place[n] - f.place[q]);
                f.along[n] = dot(then, f.normal[n]) >= least_agreement ? then : f.normal[n];
            }
            const double given = alpha(n) * f.multiplier[n];
            const double below = length - f.low[n] + given, above = length - f.high[n] + given;
            // the limit that holds, or that is passed; neither: slack
            const bool pulls = above > 0 || f.multiplier[n] < 0, pushes = below < 0 || f.multiplier[n] > 0;
            const double error = pulls ? above : pushes ? below : 0;
            f.wanted[n] = -error;
            f.pivot[n] = pulls || pushes ? 1 : 0;
            worst = maximum(worst, absolute(error) * inverse_or_zero(pulls ? f.high[n] : f.low[n]));
        }
        return worst;
    }

    void eliminate() {
        for (auto n = node(0); n <= root(); ++n) {
            f.stiffness[n] = Matrix<D, double>::diagonal(inverse_or_zero(f.mobility[n]));
            f.bias[n] = {};
        }
        for (std::uint32_t k = 0; k < edges(); ++k) {
            const auto n = node(k), q = parent(k);
            const bool moves = f.mobility[n] > 0;
            f.moved[n] = moves ? solve(f.stiffness[n], f.bias[n]) : Vector{};
            if (f.pivot[n] == 0) continue; // slack: the subtree is on its own
            const auto yields = moves ? solve(f.stiffness[n], f.along[n]) : Vector{};
            const double least = least_pivot * maximum(f.mobility[n], f.mobility[q]);
            f.pivot[n] = maximum(dot(f.normal[n], yields) + alpha(n), least);
            f.wanted[n] -= dot(f.normal[n], f.moved[n]);
            const double per_pivot = inverse_or_zero(f.pivot[n]);
            add_outer(f.stiffness[q], f.along[n] * per_pivot, f.normal[n]);
            f.bias[q] -= f.along[n] * (f.wanted[n] * per_pivot);
        }
    }

    void substitute() {
        f.moved[root()] = f.mobility[root()] > 0 ? solve(f.stiffness[root()], f.bias[root()]) : Vector{};
        for (std::uint32_t k = edges(); k-- > 0;) {
            const auto n = node(k), q = parent(k);
            if (f.pivot[n] == 0) continue;
            const double s = (f.wanted[n] + dot(f.normal[n], f.moved[q])) * inverse_or_zero(f.pivot[n]);
            if (f.mobility[n] > 0) f.moved[n] += solve(f.stiffness[n], f.along[n]) * s;
            pull(n, q, s);
        }
    }

    /// A rope never pushes, a strut never pulls: the multiplier stays on the side its limit acts on.
    void pull(std::uint32_t n, std::uint32_t q, double s) {
        const double before = f.multiplier[n];
        double after = before + s;
        if (f.low[n] < f.high[n]) {
            const bool pulls = before < 0 || (before == 0 && s < 0);
            after = pulls ? minimum(after, 0.0) : maximum(after, 0.0);
        }
        f.multiplier[n] = after;
        const auto kick = f.along[n] * ((after - before) * per_h);
        f.velocity[n] += kick * f.mobility[n];
        f.velocity[q] -= kick * f.mobility[q];
    }

    /// Across a taut edge Verlet is stable while tension h^2 < m length. Beyond, a light rope under a heavy weight
    /// would hum itself to pieces.
    bool stable() const {
        for (std::uint32_t k = 0; k < edges(); ++k)
            if (-f.multiplier[node(k)] * (f.mobility[node(k)] + f.mobility[parent(k)]) > norm(span(k))) return false;
        return true;
    }
};

/// Newton on the augmented Lagrangian in places,
///
///     sum m / (2 h^2) |x - y|^2 + sum tension C + k/2 C^2
///
/// y where the particles would go by themselves, the geometric stiffness max(0, tension) / length (1 - n n^T) kept and
/// the tensions of the last substep for a start; eliminated from the leaves up. It corrects along the new directions,
/// so it loses energy like any position-based solver, but it is implicit: no weight, whip or knot shakes it.
template <int D> class StiffSolve : TreeView<D> {
  public:
    using TreeView<D>::TreeView;

    bool run() {
        k_most_ = relative_stiffness * total_mass() * per_h * per_h;
        for (auto n = node(0); n < root(); ++n) f.warm[n] = -f.warm[n] * per_h * per_h; // tensions
        for (int i = 0; i < most_steps; ++i) {
            assemble();
            eliminate();
            substitute();
            if (this->worst_strain() <= good_enough) break;
        }
        for (auto n = node(0); n < root(); ++n) f.multiplier[n] = -f.warm[n] * h * h;
        return this->worst_strain() <= acceptable;
    }

  private:
    using Base = TreeView<D>;
    using Base::f, Base::edges, Base::node, Base::parent, Base::root, Base::span, Base::h, Base::per_h;
    using typename Base::Vector;

    static constexpr int most_steps = 10;
    static constexpr double relative_stiffness =
        1e4; ///< of the penalty, over all mass / h^2: each step gains four digits
    static constexpr double good_enough = 1e-6, acceptable = 1e-2;
    double k_most_ = 0;

    double total_mass() const {
        double sum = 0;
        for (auto n = node(0); n <= root(); ++n) sum += inverse_or_zero(f.mobility[n]);
        return sum;
    }

    void assemble() {
        for (auto n = node(0); n <= root(); ++n) {
            const double m = inverse_or_zero(f.mobility[n]) * per_h * per_h;
            f.stiffness[n] = Matrix<D, double>::diagonal(m);
            f.bias[n] = (f.predicted[n] - f.velocity[n]) * (m * h);
        }
        for (std::uint32_t e = 0; e < edges(); ++e) {
            const auto n = node(e), q = parent(e);
            const auto now = span(e);
            const double length = norm(now);
            f.normal[n] = now * inverse_or_zero(length);
            const bool soft = f.compliance[n] * k_most_ > 1;
            const double k = soft ? 1 / f.compliance[n] : k_most_;
            if (soft) f.warm[n] = 0; // a spring's force is what it is: no multiplier
            const double above = f.warm[n] + k * (length - f.high[n]), below = f.warm[n] + k * (length - f.low[n]);
            f.wanted[n] = maximum(above, 0.0) + minimum(below, 0.0);
            const bool taut = f.wanted[n] != 0;
            f.pivot[n] = taut ? k : 0;
            const double across = taut ? maximum(f.warm[n], 0.0) * inverse_or_zero(length) : 0;
            f.coupling[n] = Matrix<D, double>::diagonal(across);
            add_outer(f.coupling[n], f.normal[n] * (f.pivot[n] - across), f.normal[n]);
            f.stiffness[n] += f.coupling[n];
            f.stiffness[q] += f.coupling[n];
            f.bias[n] -= f.normal[n] * f.wanted[n];
            f.bias[q] += f.normal[n] * f.wanted[n];
        }
    }

    void eliminate() {
        for (std::uint32_t e = 0; e < edges(); ++e) {
            const auto n = node(e), q = parent(e);
            if (f.mobility[n] == 0) continue;
            f.stiffness[q] -= f.coupling[n] * solve(f.stiffness[n], f.coupling[n]);
            f.bias[q] += f.coupling[n] * solve(f.stiffness[n], f.bias[n]);
        }
    }

    void substitute() {
        move(root(), Vector{});
        for (std::uint32_t e = edges(); e-- > 0;) {
            const auto n = node(e), q = parent(e);
            move(n, f.coupling[n] * f.moved[q]);
            f.warm[n] = f.wanted[n] + f.pivot[n] * dot(f.normal[n], f.moved[n] - f.moved[q]);
        }
    }

    void move(std::uint32_t n, const Vector& pulled) {
        f.moved[n] = f.mobility[n] > 0 ? solve(f.stiffness[n], f.bias[n] + pulled) : Vector{};
        f.velocity[n] += f.moved[n] * per_h;
    }
};

} // namespace sinew::detail
