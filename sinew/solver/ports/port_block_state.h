#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>

namespace sinew::detail {

/// State of a block with ports in one substep: loaded from the sweep, and stored there at the end.
template <int D, class Real> class PortBlockState {
  public:
    using Vector = Vec<D, double>;

    PortBlockState(World<D, Real>& world, Solver<D, Real>& solver, Block& block, Real h)
        : swept_(solver.sweep_state), distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          angles_(std::get<kind_number<Angle, D>>(world.constraints)), blocks_(solver.blocks), block_(block),
          h_(double(h)) {}

    std::span<Port<D>> ports() const { return std::span(blocks_.ports.list).subspan(block_.first_port, block_.ports); }
    std::span<BlockNode<D>> nodes() const { return std::span(blocks_.nodes).subspan(block_.first_node, block_.nodes); }
    std::span<BlockNode<D>> unknowns() const { return nodes().first(block_.unknowns); }
    std::span<DistanceRow<D>> links() const {
        return std::span(blocks_.links).subspan(block_.first_link, block_.links);
    }
    /// All but the load tethers.
    std::span<DistanceRow<D>> own_links() const { return links().first(block_.links - block_.load_tethers); }
    std::span<AngleRow<D>> bends() const { return std::span(blocks_.bends).subspan(block_.first_bend, block_.bends); }
    Vector begin_of(const BlockNode<D>& node) const { return cast<double>(swept_.position_at(slot(node))); }
    /// Displacement of a node in the sweep.
    Vector displacement_of(const BlockNode<D>& node) const { return cast<double>(swept_.displacement_at(slot(node))); }
    /// Displacement of a node in the substep before.
    const Vector& last_displacement_of(const BlockNode<D>& node) const {
        return blocks_.ports.last_displacements[slot(node)];
    }
    double substep() const { return h_; }

    /// State at the begin of the substep, with the impulses at the ports.
    void load() {
        for (auto& node : unknowns()) {
            const auto s = slot(node);
            node.start = begin_of(node);
            node.velocity = blocks_.ports.free_moves[s] * (1 / h_);
            const double mass = inverse_or_zero(blocks_.ports.mobilities[s]);
            block_.is_factorised = block_.is_factorised && mass == node.mass;
            node.mass = mass;
            node.acceleration = {};
        }
        for (const auto& port : ports()) {
            auto& node = blocks_.nodes[port.node];
            node.acceleration = port.impulse * (inverse_or_zero(node.mass) / square(h_));
        }
        for (auto& node : nodes().subspan(block_.unknowns)) {
            node.velocity = node.displacement = {};
            node.start = begin_of(node);
            node.position = node.start + displacement_of(node); // moving pins
        }
    }

    void start_tensions() {
        const double per = inverse_or_zero(square(h_));
        for (auto& link : links()) link.tension = link.before;
        for (auto& link : own_links())
            link.tension = block_.braced() ? 0 : -double(distances_.multiplier[link.constraint]) * per / link.length;
        for (auto& bend : bends()) bend.tension = -double(angles_.multiplier[bend.constraint]) * per;
    }
    void forget_tensions() {
        for (auto& link : links()) link.tension = 0;
        for (auto& bend : bends()) bend.tension = 0;
    }

    /// Places of the ports before the sweep. Only the sweep's impulses move the block from here on.
    void show() {
        for (auto& node : unknowns()) swept_.mobility[slot(node)] = 0;
        for (auto& port : ports()) {
            port.impulse = {};
            const auto displacement = clamp_components(port.free_move, furthest());
            swept_.set_displacement(slot(blocks_.nodes[port.node]), cast<Real>(displacement));
        }
    }

    void store() {
        const auto drift = is_held() ? Vector{} : drift_of();
        for (auto& node : unknowns()) {
            const auto s = slot(node);
            const auto displacement = node.position - begin_of(node) - drift;
            swept_.set_displacement(s, cast<Real>(clamp_components(displacement, furthest())));
            swept_.mobility[s] = Real(blocks_.ports.mobilities[s]);
        }
        for (auto& link : links()) link.before = link.tension;
        for (const auto& link : own_links()) note(distances_.multiplier[link.constraint], link.tension * link.length);
        for (const auto& bend : bends()) note(angles_.multiplier[bend.constraint], bend.tension);
        for (auto& port : ports()) port.guess = port.impulse;
    }

    bool is_held() const { return block_.fixed() || is_tethered(); }
    /// Mean motion of a free block under the impulses at the ports.
    Vector mean_displacement() const {
        double mass = 0;
        Vector sum{};
        for (const auto& node : unknowns()) sum += blocks_.ports.free_moves[slot(node)] * node.mass, mass += node.mass;
        for (const auto& port : ports()) sum += port.impulse;
        return sum * inverse_or_zero(mass);
    }

    /// Energy within rounding and the tolerance of the solution.
    double trace(double gravity) const {
        double mass = 0, length = 0, kinetic = 0;
        for (const auto& node : unknowns())
            mass += node.mass, kinetic += 0.5 * node.mass * dot(node.velocity, node.velocity);
        for (const auto& link : links()) length += link.length;
        constexpr double share = 1e-6;
        return share * (mass * gravity * length + kinetic);
    }

  private:
    SweepState<D, Real>& swept_;
    Constraints<Distance<D>, Real>& distances_;
    Constraints<Angle<D>, Real>& angles_;
    Blocks<D>& blocks_;
    Block& block_;
    double h_;

    Row slot(const BlockNode<D>& node) const {
        SINEW_ASSERT(swept_.slot_of[node.row] != no_row, "the sweep sees the nodes of a block with ports");
        return swept_.slot_of[node.row];
    }
    /// Bound of a displacement within which float stays finite.
    double furthest() const { return double(max_displacement(Real(h_))); }

    bool is_tethered() const {
        const auto tethers = links().last(block_.load_tethers);
        return std::any_of(tethers.begin(), tethers.end(), [](const auto& tether) { return tether.length > 0; });
    }

    /// Momentum added by rounding, as a displacement: links only act within.
    Vector drift_of() const {
        double mass = 0;
        Vector sum{};
        for (const auto& node : unknowns()) sum += (node.position - begin_of(node)) * node.mass, mass += node.mass;
        return sum * inverse_or_zero(mass) - mean_displacement();
    }

    /// Force as a multiplier of the sweep.
    void note(Real& multiplier, double force) const {
        constexpr double max = double(limit::multiplier<Real>);
        multiplier = Real(clamp(-force * square(h_), -max, max));
    }
};

} // namespace sinew::detail
