#pragma once

#include "sinew/solver/contact/cluster_tensions.h"
#include "sinew/solver/contact/link_response.h"
#include "sinew/solver/contact/row_nodes.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/workers.h"

namespace sinew::detail {

/// Exact lengths of the rigid links of colliding figures (RATTLE: Andersen 1983), in the metric of the masses: with G
/// the gradients of the lengths of a component at the place of the factorisation,
///
///     velocities    d <- d - M^-1 G^T (G M^-1 G^T)^-1 G d
///     lengths       d <- d - M^-1 G^T (G M^-1 G^T)^-1 (|x + d| - L),    until the lengths are right
/// Clusters whose links make them rigid move as bodies, without a factor (simd/link_clusters.h).
///
/// A rope takes part while it pulls: an active set, kept from substep to substep. A projection of velocities never adds
/// energy. One of lengths may, where links lie in line: energy above that before is taken back once the particles have
/// moved. Components of equal structure are solved side by side in lanes (simd/link_projection.h).
template <int D, class Real> class LinkProjector {
  public:
    void find(const World<D, Real>& world, const Solver<D, Real>& solver, std::span<const char> takes_part,
              std::vector<char>& is_exact) {
        if (links_.find(world, solver, takes_part, is_exact)) {
            packs_.build(links_);
            inner_.build(links_);
        } else {
            packs_.set_active(links_);
        }
        list_clusters();
        weigh(world, solver.sweep_state);
        kernels_ = &kernels<D, Real>(solver.options.simd).links;
        is_current_ = false;
        is_marked_.assign(links_.components.size(), 0);
        marked_.reserve(links_.components.size());
    }
    const RigidLinks<D, Real>& links() const { return links_; }

    /// Factorises at the present places, unless that has been done. `mobilities_change`: drag changes them. `is_last`:
    /// `store` follows this substep.
    void begin(const SweepState<D, Real>& state, bool mobilities_change, bool is_last, int threads) {
        packs_.each_link(links_, [](const RigidLink&, const LinkPack<D>& pack, std::size_t k, std::size_t lane) {
            pack.of_link(k, LinkFields<D>::tension)[lane] = 0;
        });
        packs_.note_held(is_last);
        notes_pushes_ = is_last;
        if (is_last) inner_.forget(links_, packs_);
        if (!is_current_ || mobilities_change) run(kernels_->factorise, state, threads);
        run(kernels_->note, state, threads);
    }
    void project_velocities(SweepState<D, Real>& state, int threads) { run(kernels_->velocities, state, threads); }
    /// After a blow on a particle: energy for the component to keep.
    void note_blow(const SweepState<D, Real>& state, Row slot) { run_at(slot, kernels_->note, state); }
    /// A load of contact on a particle, of unknown work: the component may lose energy in the substep.
    void note_load(Row slot) {
        if (links_.component_of[slot] == RigidLinks<D, Real>::none) return;
        const auto [pack, lane] = packs_.place_of(links_.component_of[slot]);
        packs_.list[pack].least_energy()[lane] = LinkPack<D>::no_energy;
    }
    /// Clusters show their motions, for rows that act on these.
    void begin_rows(SweepState<D, Real>& state, int threads) { run(kernels_->begin_rows, state, threads); }
    /// `project_velocities` after such rows.
    void end_rows(SweepState<D, Real>& state, int threads) { run(kernels_->end_rows, state, threads); }
    ClusterMotions<D, Real> motions() { return {motions_.data(), cluster_of_.data(), notes_pushes_}; }
    /// Largest mass in the component of a particle, kg; 0 without links.
    Real heaviest(Row slot) const {
        const auto component = links_.component_of[slot];
        return component == links_.none ? Real(0) : heaviest_[component];
    }
    /// Bodies are components of rigid links, and particles without any.
    std::uint32_t body_of(Row slot) const {
        const auto component = links_.component_of[slot];
        return component != links_.none ? component : std::uint32_t(links_.components.size() + slot);
    }
    std::size_t bodies() const { return body_mass_.size(); }
    Real mass_of_body(std::uint32_t body) const { return body_mass_[body]; } ///< of its free particles, kg
    Real unevenness() const { return unevenness_; }                          ///< ratio of the masses of bodies
    bool is_in_cluster(Row slot) const { return cluster_of_[slot] != links_.none; }
    std::span<const std::uint32_t> cluster_of() const { return cluster_of_; }
    /// Right lengths at the end of the displacements.
    void project_lengths(SweepState<D, Real>& state, int threads) { run(kernels_->lengths, state, threads); }
    /// After the particles have moved: velocities that keep the lengths there, with no more energy than before the
    /// lengths were projected.
    void restore_energy(SweepState<D, Real>& state, int threads) {
        is_current_ = true;
        run(kernels_->restore, state, threads);
    }

    /// Displacements for impulses, with the lengths held.
    LinkResponse<D, Real> response(const SweepState<D, Real>& state) { return {links_, packs_, state}; }
    /// Projects the velocities of the component of a particle; true if a rope has let go or taken hold.
    bool project_velocities(SweepState<D, Real>& state, Row slot) {
        const auto before = ropes_that_pull(slot);
        run_at(slot, kernels_->velocities, state);
        return before != ropes_that_pull(slot);
    }
    /// Marks the component of a particle for `project_lengths_again`.
    void mark(Row slot) {
        const auto component = links_.component_of[slot];
        if (component == RigidLinks<D, Real>::none || is_marked_[component]) return;
        is_marked_[component] = 1;
        marked_.push_back(slot);
    }
    /// Holds the lengths of the marked components as they change at the end of the displacements.
    void turn_marked(const SweepState<D, Real>& state) {
        for (const Row slot : marked_) response(state).turn(links_.component_of[slot]);
    }
    /// Right lengths of the marked components, once more in the substep: the energy due stays as it was.
    void project_lengths_again(SweepState<D, Real>& state) {
        for (const Row slot : marked_) {
            run_at(slot, kernels_->again, state);
            is_marked_[links_.component_of[slot]] = 0;
        }
        marked_.clear();
    }

    /// Stores the multipliers, as of constraints of the sweep.
    void store(World<D, Real>& world, const SweepState<D, Real>& state) {
        auto& multipliers = std::get<kind_number<Distance, D>>(world.constraints).multiplier;
        const auto set = [&](Row row, double tension) {
            multipliers[row] = clamp(Real(-tension), -limit::multiplier<Real>, limit::multiplier<Real>);
        };
        packs_.each_link(links_, [&](const RigidLink& link, const LinkPack<D>& pack, std::size_t k, std::size_t lane) {
            set(link.row, pack.of_link(k, LinkFields<D>::tension)[lane]);
        });
        inner_.each_tension(links_, packs_, columns(state), *kernels_, set);
    }

  private:
    RigidLinks<D, Real> links_;
    LinkPacks<D, Real> packs_;
    ClusterTensions<D, Real> inner_;
    const LinkKernels<D, Real>* kernels_ = nullptr;
    std::vector<ClusterMotion<D, Real>> motions_;
    std::vector<std::uint32_t> cluster_of_; ///< per slot; `none` outside of clusters, and in those left to the sweep
    std::vector<Real> body_mass_;           ///< per body, kg
    Real unevenness_ = 0;                   ///< heaviest body per lightest
    std::vector<Real> heaviest_;            ///< mass per component, kg
    bool notes_pushes_ = false;             ///< on members of clusters
    std::vector<char> is_marked_;           ///< per component
    std::vector<Row> marked_;               ///< a particle of each marked component
    bool is_current_ = false;               ///< factorised at the present places

    void list_clusters() {
        motions_.resize(links_.clusters.clusters.size());
        cluster_of_.resize(links_.component_of.size());
        for (Row slot = 0; slot < cluster_of_.size(); ++slot)
            cluster_of_[slot] =
                links_.component_of[slot] == links_.none ? links_.none : links_.clusters.cluster_of(slot);
    }
    void weigh(const World<D, Real>& world, const SweepState<D, Real>& state) {
        heaviest_.assign(links_.components.size(), 0);
        body_mass_.assign(links_.components.size() + links_.component_of.size(), 0);
        for (Row slot = 0; slot < links_.component_of.size(); ++slot) {
            const Real mass = inverse_or_zero(world.particles.mobility[state.row_of[slot]]);
            body_mass_[body_of(slot)] += mass;
            if (const auto component = links_.component_of[slot]; component != links_.none)
                heaviest_[component] = max(heaviest_[component], mass);
        }
        Real lightest = std::numeric_limits<Real>::max(), most = 0;
        for (const Real mass : body_mass_)
            if (mass > Real(0)) lightest = min(lightest, mass), most = max(most, mass);
        unevenness_ = most / lightest;
    }
    LinkColumns<D, Real> columns(const SweepState<D, Real>& state) {
        const Real h = Real(1) / state.per_h;
        return {.position = state.position[0],
                .displacement = state.displacement[0],
                .stride = state.stride(),
                .mobility = state.mobility,
                .motions = motions_.data(),
                .furthest = double(max_displacement(h)),
                .fall = cast<double>(state.gravity) * square(double(h)),
                .only_falls = state.everyone_alike};
    }
    /// Hash of the set; 0 without ropes.
    std::uint64_t ropes_that_pull(Row slot) const {
        if (links_.component_of[slot] == RigidLinks<D, Real>::none) return 0;
        const auto [pack, lane] = packs_.place_of(links_.component_of[slot]);
        const auto& links = packs_.list[pack];
        std::uint64_t hash = 0;
        for (std::size_t k = 0; links.has_ropes && k < links.links; ++k)
            hash = hash * 1099511628211ULL + (links.of_link(k, LinkFields<D>::active)[lane] > 0 ? 1 : 2);
        return hash;
    }
    /// The component of a particle.
    void run_at(Row slot, typename LinkKernels<D, Real>::Project project, const SweepState<D, Real>& state) {
        if (links_.component_of[slot] == RigidLinks<D, Real>::none) return;
        const auto [pack, lane] = packs_.place_of(links_.component_of[slot]);
        project(columns(state), packs_.list[pack], lane);
    }
    /// Components share no movable particle; one chunk of packs a part of the work.
    void run(typename LinkKernels<D, Real>::Project project, const SweepState<D, Real>& state, int threads) {
        constexpr int chunks = 32;
        const auto count = packs_.list.size();
        if (count == 0) return;
        const auto in = columns(state);
        Workers::run(threads, chunks, [&](int chunk) {
            const auto last = count * std::size_t(chunk + 1) / chunks;
            for (auto i = count * std::size_t(chunk) / chunks; i < last; ++i) project(in, packs_.list[i], -1);
        });
    }
};

} // namespace sinew::detail
