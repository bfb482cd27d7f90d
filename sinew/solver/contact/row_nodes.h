#pragma once

#include "sinew/solver/contact/contact_row.h"
#include "sinew/solver/simd/link_pack.h"
#include "sinew/solver/sweep_state.h"

/// Nodes of a row of contact: particles, each for itself, or with them the rigid clusters that they belong to.
namespace sinew::detail {

/// Motions of the clusters in a substep, and the cluster of each slot of the sweep.
template <int D, class Real> struct ClusterMotions {
    static constexpr std::uint32_t none = ~std::uint32_t(0);
    ClusterMotion<D, Real>* list = nullptr;
    const std::uint32_t* of_slot = nullptr; ///< `none` outside of clusters
    bool notes_pushes = false;              ///< pushes on members are of interest, too
};

/// Members of a row as particles.
template <int D, class Real> class ParticleNodes {
  public:
    using Vector = Vec<D, Real>;
    using RowT = ContactRow<D, Real>;

    /// `furthest`: bound on the components of a displacement.
    ParticleNodes(SweepState<D, Real>& state, const RowT& row, Real furthest)
        : state_(state), row_(row), furthest_(furthest) {}

    Vector displacement() const {
        auto sum = state_.displacement_at(row_.slot[0]) * row_.weight[0];
        for (std::size_t i = 1; i < row_.slot.size(); ++i) sum += state_.displacement_at(row_.slot[i]) * row_.weight[i];
        return sum;
    }
    /// 1 / response to a unit impulse in a direction, kg.
    Real mass_along(const Vector&) const { return row_.mass; }
    void push(const Vector& impulse) const {
        for (std::size_t i = 0; i < row_.slot.size(); ++i) {
            const Real mobility = state_.mobility[row_.slot[i]];
            if (mobility == Real(0)) continue; // another part may read an immovable particle
            const auto moved = state_.displacement_at(row_.slot[i]) + impulse * (row_.weight[i] * mobility);
            state_.set_displacement(row_.slot[i], clamp_components(moved, furthest_));
        }
    }

  private:
    SweepState<D, Real>& state_;
    const RowT& row_;
    Real furthest_;
};

/// Members of a row with the clusters that they belong to. Members of one cluster share a node.
template <int D, class Real> class ClusterNodes {
  public:
    using Vector = Vec<D, Real>;
    using RowT = ContactRow<D, Real>;
    using Motion = ClusterMotion<D, Real>;

    ClusterNodes(SweepState<D, Real>& state, const ClusterMotions<D, Real>& motions, const RowT& row, Real furthest)
        : state_(state), motions_(motions), row_(row), furthest_(furthest) {
        for (std::size_t i = 0; i < std::size_t(row.members); ++i) add(row.slot[i], row.weight[i]);
    }

    Vector displacement() const {
        Vector sum{};
        for (std::size_t i = 0; i < count_; ++i) {
            const auto& node = nodes_[i];
            sum += node.motion ? node.motion->move * node.weight + turning(node.motion->turn, node.arm)
                               : state_.displacement_at(node.slot) * node.weight;
        }
        return sum;
    }
    Real mass_along(const Vector& direction) const {
        Real response = 0;
        const Real size = dot(direction, direction);
        for (std::size_t i = 0; i < count_; ++i) {
            const auto& node = nodes_[i];
            const Real lightness = node.motion ? node.motion->per_mass : state_.mobility[node.slot];
            response += size * square(node.weight) * lightness;
            if (!node.motion) continue;
            const auto lever = moment(node.arm, direction);
            response += dot(lever, node.motion->turned_by(lever));
        }
        return inverse_or_zero(response);
    }
    void push(const Vector& impulse) const {
        for (std::size_t i = 0; i < count_; ++i) {
            const auto& node = nodes_[i];
            if (node.motion)
                push(*node.motion, node, impulse);
            else
                push(node.slot, node.weight, impulse);
        }
        if (motions_.notes_pushes) note_push(impulse);
    }

  private:
    struct Node {
        Motion* motion = nullptr;
        Row slot = 0;
        Real weight = 0;
        Vector arm{}; ///< from the centre of mass, times the weight
    };
    SweepState<D, Real>& state_;
    const ClusterMotions<D, Real>& motions_;
    const RowT& row_;
    Real furthest_;
    std::array<Node, D + 1> nodes_{};
    std::size_t count_ = 0;

    void add(Row slot, Real weight) {
        const auto cluster = motions_.of_slot[slot];
        if (cluster == motions_.none) {
            nodes_[count_++] = {.slot = slot, .weight = weight};
            return;
        }
        auto* const motion = motions_.list + cluster;
        const auto arm = (state_.position_at(slot) - motion->centre) * weight;
        for (std::size_t i = 0; i < count_; ++i)
            if (nodes_[i].motion == motion) {
                nodes_[i].weight += weight, nodes_[i].arm += arm;
                return;
            }
        nodes_[count_++] = {.motion = motion, .slot = slot, .weight = weight, .arm = arm};
    }
    void note_push(const Vector& impulse) const {
        for (std::size_t i = 0; i < std::size_t(row_.members); ++i)
            if (const Row slot = row_.slot[i]; motions_.of_slot[slot] != motions_.none)
                push(slot, row_.weight[i], impulse);
    }
    void push(Row slot, Real weight, const Vector& impulse) const {
        const Real mobility = state_.mobility[slot];
        if (mobility == Real(0)) return; // another part may read an immovable particle
        state_.set_displacement(slot, moved(state_.displacement_at(slot), impulse * (weight * mobility)));
    }
    void push(Motion& motion, const Node& node, const Vector& impulse) const {
        motion.move = moved(motion.move, impulse * (node.weight * motion.per_mass));
        motion.turn = clamp_components(motion.turn + motion.turned_by(moment(node.arm, impulse)), furthest_);
    }
    Vector moved(const Vector& from, const Vector& by) const { return clamp_components(from + by, furthest_); }
};

} // namespace sinew::detail
