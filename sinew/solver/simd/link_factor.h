#pragma once

#include "sinew/math/scalar.h"
#include "sinew/solver/simd/lane_vec.h"
#include "sinew/solver/simd/link_pack.h"

#include <algorithm>
#include <limits>

namespace sinew {
namespace {

/// Factorisation L D L^T of G M^-1 G^T, with G the gradients of the lengths of a component's links, within the skyline;
/// V holds a number for each of the lanes from `lane` on.
template <int D, class V> class LinkLanes {
  public:
    using Fields = LinkFields<D>;
    static constexpr int spins = int(Fields::spins);
    using Vector = lane::Arrow<D, V>;
    using Spin = lane::Arrow<spins, V>;
    using Mask = decltype(V{} < V{});

    LinkLanes(const LinkPack<D>& pack, std::size_t first_lane) : pack_(pack), lane_(first_lane) {}

    V particle(std::size_t i, std::size_t field) const { return get(pack_.of_particle(i, field)); }
    void set_particle(std::size_t i, std::size_t field, const V& to) const { put(pack_.of_particle(i, field), to); }
    V link(std::size_t i, std::size_t field) const { return get(pack_.of_link(i, field)); }
    void set_link(std::size_t i, std::size_t field, const V& to) const { put(pack_.of_link(i, field), to); }
    V cluster(std::size_t i, std::size_t field) const { return get(pack_.of_cluster(i, field)); }
    void set_cluster(std::size_t i, std::size_t field, const V& to) const { put(pack_.of_cluster(i, field), to); }
    V energy() const { return get(pack_.energy()); }
    void set_energy(const V& to) const { put(pack_.energy(), to); }
    V least_energy() const { return get(pack_.least_energy()); }
    void set_least_energy(const V& to) const { put(pack_.least_energy(), to); }
    V may_turn() const { return get(pack_.may_turn()); }

    Vector particle_vector(std::size_t i, std::size_t field) const {
        return get_numbers<D>(pack_.of_particle(i, field));
    }
    void set_particle_vector(std::size_t i, std::size_t field, const Vector& to) const {
        put_numbers(pack_.of_particle(i, field), to);
    }
    Vector link_vector(std::size_t i, std::size_t field) const { return get_numbers<D>(pack_.of_link(i, field)); }
    void set_link_vector(std::size_t i, std::size_t field, const Vector& to) const {
        put_numbers(pack_.of_link(i, field), to);
    }
    Spin link_spin(std::size_t i, std::size_t field) const { return get_numbers<spins>(pack_.of_link(i, field)); }
    void set_link_spin(std::size_t i, std::size_t field, const Spin& to) const {
        put_numbers(pack_.of_link(i, field), to);
    }
    Vector cluster_vector(std::size_t i, std::size_t field) const { return get_numbers<D>(pack_.of_cluster(i, field)); }
    void set_cluster_vector(std::size_t i, std::size_t field, const Vector& to) const {
        put_numbers(pack_.of_cluster(i, field), to);
    }
    Spin cluster_spin(std::size_t i, std::size_t field) const { return get_numbers<spins>(pack_.of_cluster(i, field)); }
    void set_cluster_spin(std::size_t i, std::size_t field, const Spin& to) const {
        put_numbers(pack_.of_cluster(i, field), to);
    }

    static V number(double x) { return lane::spread<V>(x); }
    static V inverse_or_zero(const V& x) {
        return x >= number(std::numeric_limits<double>::min()) ? number(1) / x : V{};
    }

    /// Factors of the lanes of a mask; others keep theirs.
    [[gnu::flatten, gnu::noinline]] void factorise(const Mask& mask) const {
        const LinkLanes here = *this;
        V least = number(1);
        for (std::uint32_t k = 0; k < here.pack_.links; ++k) least = lane::min(least, here.factorise_row(k, mask));
        here.put(mask, here.pack_.may_turn(), turn_of(least));
    }
    /// Angle by which links may turn without new factors, for the least pivot as a share of its diagonal entry: the
    /// solution then leaves a thousandth of their rates, and of those nearly singular, such as across a straight rope
    /// held at both ends, angle^2 / pivot, a ten thousandth.
    static V turn_of(const V& least_pivot) {
        return lane::min(number(1e-3), number(1e-2) * lane::root(lane::max(least_pivot, V{})));
    }

    /// Replaces the right side by the solution.
    [[gnu::flatten, gnu::noinline]] void solve() const {
        const LinkPack<D> pack = pack_;
        const double* const pivots = pack.of_link(0, Fields::pivot) + lane_;
        double* const right = pack.of_link(0, Fields::right) + lane_;
        const double* const entries = pack.entry(0) + lane_;
        const std::size_t apart = Fields::of_link * pack.stride, stride = pack.stride, links = pack.links;
        for (std::size_t k = 0; k < links; ++k) {
            const double* entry = entries + pack.rows[k].start * stride;
            const double* other = right + pack.rows[k].first * apart;
            V sum = lane::load<V>(right + k * apart);
#pragma GCC unroll 4
            for (std::size_t count = k - pack.rows[k].first; count > 0; --count, entry += stride, other += apart)
                sum = sum - lane::load<V>(entry) * lane::load<V>(other);
            lane::store(right + k * apart, sum);
        }
        for (std::size_t k = 0; k < links; ++k)
            lane::store(right + k * apart, V(lane::load<V>(right + k * apart) * lane::load<V>(pivots + k * apart)));
        for (auto k = links; k-- > 0;) {
            const double* entry = entries + pack.rows[k].start * stride;
            double* other = right + pack.rows[k].first * apart;
            const V own = lane::load<V>(right + k * apart);
#pragma GCC unroll 4
            for (std::size_t count = k - pack.rows[k].first; count > 0; --count, entry += stride, other += apart)
                lane::store(other, V(lane::load<V>(other) - lane::load<V>(entry) * own));
        }
    }

  protected:
    const LinkPack<D> pack_; ///< a copy: stores of numbers might change other memory
    std::size_t lane_;

  private:
    V get(const double* from) const {
        return lane::load<V>(from + lane_);
    }
    void put(double* to, const V& number) const {
        lane::store(to + lane_, number);
    }
    void put(const Mask& mask, double* to, const V& number) const {
        put(to, mask ? number : get(to));
    }

  protected:
    template <int N> lane::Arrow<N, V> get_numbers(const double* from) const {
        lane::Arrow<N, V> v;
        for (std::size_t k = 0; k < N; ++k) v.at[k] = get(from + k * pack_.stride);
        return v;
    }
    template <int N> void put_numbers(double* to, const lane::Arrow<N, V>& v) const {
        for (std::size_t k = 0; k < N; ++k) put(to + k * pack_.stride, v.at[k]);
    }

  private:
    /// End of a link, for rows that couple there.
    struct End {
        std::uint32_t particle, cluster;
        std::size_t weight, lever, turned;
        bool is_of_body(const End& other) const {
            return cluster == LinkRow::none ? particle == other.particle : cluster == other.cluster;
        }
    };
    static End end_a(const LinkRow& row) {
        return {row.a, row.cluster_a, Fields::weight_a, Fields::lever_a, Fields::turned_a};
    }
    static End end_b(const LinkRow& row) {
        return {row.b, row.cluster_b, Fields::weight_b, Fields::lever_b, Fields::turned_b};
    }
    V coupling(std::uint32_t i, std::uint32_t j) const {
        const auto &k = pack_.rows[i], &m = pack_.rows[j];
        V weight{}, turned{};
        bool any = false;
        const auto couple = [&](const End& one, const End& other, const V& sign) {
            if (!one.is_of_body(other)) return;
            any = true;
            weight = weight + sign * link(i, one.weight);
            if (one.cluster != LinkRow::none)
                turned = turned + sign * dot(link_spin(i, one.lever), link_spin(j, other.turned));
        };
        couple(end_a(k), end_a(m), number(1)), couple(end_b(k), end_b(m), number(1));
        couple(end_a(k), end_b(m), number(-1)), couple(end_b(k), end_a(m), number(-1));
        if (!any) return weight;
        const V sum = weight * dot(link_vector(i, Fields::along), link_vector(j, Fields::along)) + turned;
        return sum * (link(i, Fields::active) * link(j, Fields::active));
    }
    /// Effective inverse mass of a link.
    V weight_of(std::uint32_t k, const LinkRow& row) const {
        V weight = link(k, Fields::weight_a) + link(k, Fields::weight_b);
        for (const auto& end : {end_a(row), end_b(row)})
            if (end.cluster != LinkRow::none) weight = weight + dot(link_spin(k, end.lever), link_spin(k, end.turned));
        return weight;
    }

    /// The diagonal is raised by a little: redundant links share their load, and the links of a straight rope held at
    /// both ends, singular across it, do not kick. The kick falls with the root of the softness; long or heavily loaded
    /// chains converge more slowly. A plane, whose rows keep their sides, gets by with less.
    /// Returns the pivot as a share of the diagonal entry.
    V factorise_row(std::uint32_t k, const Mask& mask) const {
        constexpr double softness = D == 3 ? 1e-6 : 1e-7;
        const auto& row = pack_.rows[k];
        const V weight = weight_of(k, row);
        V pivot = weight * number(1 + softness);
        for (auto m = row.first; m < k; ++m) {
            const auto& other = pack_.rows[m];
            V sum = coupling(k, m);
            for (auto j = std::max(row.first, other.first); j < m; ++j)
                sum = sum -
                      get(pack_.entry(row.start + (j - row.first))) * get(pack_.entry(other.start + (j - other.first)));
            put(mask, pack_.entry(row.start + (m - row.first)), sum); // times the pivot, for now
        }
        for (auto m = row.first; m < k; ++m) {
            double* const entry = pack_.entry(row.start + (m - row.first));
            const V scaled = get(entry) * link(m, Fields::pivot);
            pivot = pivot - get(entry) * scaled;
            put(mask, entry, scaled);
        }
        const Mask holds = link(k, Fields::active) > V{};
        put(mask, pack_.of_link(k, Fields::pivot), holds ? inverse_or_zero(lane::max(pivot, V{})) : V{});
        return holds ? pivot * inverse_or_zero(weight) : number(1);
    }
};

} // namespace
} // namespace sinew
