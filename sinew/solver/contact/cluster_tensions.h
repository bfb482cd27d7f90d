#pragma once

#include "sinew/solver/contact/link_packs.h"
#include "sinew/solver/simd/link_factor.h"

#include <utility>

namespace sinew::detail {

/// Tensions of the links within rigid clusters: the smallest, by the masses, that move the particles as the clusters
/// have, G M^-1 G^T tension = G (displacement by the links).
template <int D, class Real> class ClusterTensions {
  public:
    void build(const RigidLinks<D, Real>& links) {
        links.list_inner(links_);
        packs_.build(links_);
        held_.resize(links.component_of.size());
    }
    /// Begins a substep.
    void forget(const RigidLinks<D, Real>& links, const LinkPacks<D, Real>& packs) const {
        each_member(links, packs, [](Row, const LinkPack<D>& pack, std::uint32_t i, std::size_t lane) {
            for (std::size_t k = 0; k < D; ++k) pack.of_particle(i, Fields::held + k)[lane] = 0;
        });
    }
    /// Calls visit(row, tension) at the end of a step, after a substep. `packs`: of `links`.
    template <class Visit>
    void each_tension(const RigidLinks<D, Real>& links, const LinkPacks<D, Real>& packs,
                      const LinkColumns<D, Real>& columns, const LinkKernels<D, Real>& kernels, const Visit& visit) {
        if (links_.components.empty()) return;
        each_member(links, packs, [&](Row slot, const LinkPack<D>& pack, std::uint32_t i, std::size_t lane) {
            for (std::size_t k = 0; k < D; ++k) held_[slot].at[k] = pack.of_particle(i, Fields::held + k)[lane];
        });
        for (const auto& pack : packs_.list) kernels.factorise(columns, pack, -1);
        for (std::uint32_t c = 0; c < links_.components.size(); ++c) {
            const auto place = packs_.place_of(c);
            solve(links_.components[c], {packs_.list[place.pack], std::size_t(place.lane)}, visit);
        }
    }

  private:
    using Fields = LinkFields<D>;
    using Lane = LinkLanes<D, double>;
    RigidLinks<D, Real> links_; ///< a component for each cluster
    LinkPacks<D, Real> packs_;
    std::vector<typename Lane::Vector> held_; ///< per slot

    template <class Visit> void solve(const LinkComponent& component, const Lane& lane, const Visit& visit) const {
        const auto each = [&](const auto& work) {
            for (auto k = component.first_link; k < component.last_link; ++k)
                work(links_.list[k], k - component.first_link);
        };
        each([&](const RigidLink& link, std::uint32_t k) {
            const auto change = dot(lane.link_vector(k, Fields::along), held_[link.b] - held_[link.a]);
            lane.set_link(k, Fields::right, link.is_active ? -change : 0);
        });
        lane.solve();
        each([&](const RigidLink& link, std::uint32_t k) { visit(link.row, lane.link(k, Fields::right)); });
    }
    template <class Visit>
    static void each_member(const RigidLinks<D, Real>& links, const LinkPacks<D, Real>& packs, const Visit& visit) {
        for (std::uint32_t i = 0; i < links.components.size(); ++i) {
            if (links.components[i].first_cluster == links.components[i].last_cluster) continue;
            const auto place = packs.place_of(i);
            const auto& pack = packs.list[place.pack];
            for (std::uint32_t m = 0; m < pack.cluster[pack.clusters - 1].last; ++m) {
                const auto particle = pack.members[m];
                const auto lane = std::size_t(place.lane);
                visit(pack.slots[particle * pack.stride + lane], pack, particle, lane);
            }
        }
    }
};

} // namespace sinew::detail
