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
        for (std::size_t k = 0; k < row_.levers; ++k) {
            const auto& lever = row_.lever[k];
            sum += lever.turned(row_.normal, state_.displacement_at(row_.slot[lever.b]) -
                                                 state_.displacement_at(row_.slot[lever.a]));
        }
        return sum;
    }
    /// 1 / response to a unit impulse in a direction, kg.
    Real mass_along(const Vector& direction) const {
        if (row_.levers == 0) return row_.mass;
        Real response = 0;
        for (std::size_t i = 0; i < row_.members; ++i) {
            const auto push = row_.on_member(i, direction);
            response += state_.mobility[row_.slot[i]] * dot(push, push);
        }
        return inverse_or_zero(response);
    }
    void push(const Vector& impulse) const {
        if (row_.levers == 0)
            for (std::size_t i = 0; i < row_.slot.size(); ++i) push(row_.slot[i], impulse * row_.weight[i]);
        else
            for (std::size_t i = 0; i < row_.members; ++i) push(row_.slot[i], row_.on_member(i, impulse));
    }

  private:
    SweepState<D, Real>& state_;
    const RowT& row_;
    Real furthest_;

    void push(Row slot, const Vector& impulse) const {
        const Real mobility = state_.mobility[slot];
        if (mobility == Real(0)) return; // another part may read an immovable particle
        state_.set_displacement(slot, clamp_components(state_.displacement_at(slot) + impulse * mobility, furthest_));
    }
};

/// Members of a row with the clusters that they belong to. Members of one cluster share a node.
template <int D, class Real> class ClusterNodes {
  public:
    using Vector = Vec<D, Real>;
    using RowT = ContactRow<D, Real>;
    using Motion = ClusterMotion<D, Real>;

    ClusterNodes(SweepState<D, Real>& state, const ClusterMotions<D, Real>& motions, const RowT& row, Real furthest)
        : state_(state), motions_(motions), row_(row), furthest_(furthest) {
        for (std::size_t i = 0; i < std::size_t(row.members); ++i) add(i);
        for (std::size_t k = 0; k < std::size_t(row.levers); ++k) add(row.lever[k]);
    }

    Vector displacement() const {
        Vector sum{};
        for (std::size_t i = 0; i < count_; ++i) {
            const auto& node = nodes_[i];
            sum += node.motion ? node.motion->move * node.weight + turning(node.motion->turn, node.arm)
                               : row_.by_member(node.member, state_.displacement_at(row_.slot[node.member]));
        }
        return sum;
    }
    Real mass_along(const Vector& direction) const {
        Real response = 0;
        const Real size = dot(direction, direction);
        for (std::size_t i = 0; i < count_; ++i) {
            const auto& node = nodes_[i];
            if (node.motion) {
                const auto lever = moment(node.arm, direction);
                response += size * square(node.weight) * node.motion->per_mass;
                response += dot(lever, node.motion->turned_by(lever));
            } else {
                const auto push = row_.on_member(node.member, direction);
                response += state_.mobility[row_.slot[node.member]] * dot(push, push);
            }
        }
        return inverse_or_zero(response);
    }
    void push(const Vector& impulse) const {
        for (std::size_t i = 0; i < count_; ++i) {
            const auto& node = nodes_[i];
            if (node.motion)
                push(*node.motion, node, impulse);
            else
                push_member(node.member, impulse);
        }
        if (motions_.notes_pushes) note_push(impulse);
    }

  private:
    struct Node {
        Motion* motion = nullptr;
        std::size_t member = 0; ///< outside of clusters
        Real weight = 0;
        Vector arm{}; ///< from the centre of mass, times the weight
    };
    SweepState<D, Real>& state_;
    const ClusterMotions<D, Real>& motions_;
    const RowT& row_;
    Real furthest_;
    std::array<Node, RowT::most> nodes_{};
    std::size_t count_ = 0;

    Motion* motion_of(std::size_t member) const {
        const auto cluster = motions_.of_slot[row_.slot[member]];
        return cluster == motions_.none ? nullptr : motions_.list + cluster;
    }
    void add(std::size_t member) {
        auto* const motion = motion_of(member);
        if (!motion) {
            nodes_[count_++] = {.member = member};
            return;
        }
        const Real weight = row_.weight[member];
        const auto arm = (state_.position_at(row_.slot[member]) - motion->centre) * weight;
        if (auto* const node = find(motion))
            node->weight += weight, node->arm += arm;
        else
            nodes_[count_++] = {.motion = motion, .weight = weight, .arm = arm};
    }
    /// Both ends of a link with a lever are of one cluster, or of none.
    void add(const ContactLever<D, Real>& lever) {
        if (auto* const node = find(motion_of(lever.a))) node->arm -= row_.normal * (lever.radius * row_.arm);
    }
    Node* find(const Motion* motion) {
        if (!motion) return nullptr;
        const auto end = nodes_.begin() + std::ptrdiff_t(count_);
        const auto found = std::find_if(nodes_.begin(), end, [&](const Node& node) { return node.motion == motion; });
        return found == end ? nullptr : &*found;
    }
    void note_push(const Vector& impulse) const {
        for (std::size_t i = 0; i < std::size_t(row_.members); ++i)
            if (motion_of(i)) push_member(i, impulse);
    }
    void push_member(std::size_t member, const Vector& impulse) const {
        const Row slot = row_.slot[member];
        const Real mobility = state_.mobility[slot];
        if (mobility == Real(0)) return; // another part may read an immovable particle
        const auto by = row_.on_member(member, impulse) * mobility;
        state_.set_displacement(slot, moved(state_.displacement_at(slot), by));
    }
    void push(Motion& motion, const Node& node, const Vector& impulse) const {
        motion.move = moved(motion.move, impulse * (node.weight * motion.per_mass));
        motion.turn = clamp_components(motion.turn + motion.turned_by(moment(node.arm, impulse)), furthest_);
    }
    Vector moved(const Vector& from, const Vector& by) const { return clamp_components(from + by, furthest_); }
};

} // namespace sinew::detail
