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
    using Vector = lane::Arrow<D, V>;

    LinkLanes(const LinkPack<D>& pack, std::size_t first_lane) : pack_(pack), lane_(first_lane) {}

    V particle(std::size_t i, std::size_t field) const { return get(pack_.of_particle(i, field)); }
    void set_particle(std::size_t i, std::size_t field, const V& to) const { put(pack_.of_particle(i, field), to); }
    V link(std::size_t i, std::size_t field) const { return get(pack_.of_link(i, field)); }
    void set_link(std::size_t i, std::size_t field, const V& to) const { put(pack_.of_link(i, field), to); }
    V energy() const { return get(pack_.energy()); }
    void set_energy(const V& to) const { put(pack_.energy(), to); }

    Vector particle_vector(std::size_t i, std::size_t field) const { return get_vector(pack_.of_particle(i, field)); }
    void set_particle_vector(std::size_t i, std::size_t field, const Vector& to) const {
        put_vector(pack_.of_particle(i, field), to);
    }
    Vector link_vector(std::size_t i, std::size_t field) const { return get_vector(pack_.of_link(i, field)); }
    void set_link_vector(std::size_t i, std::size_t field, const Vector& to) const {
        put_vector(pack_.of_link(i, field), to);
    }

    // --- clusters ----------------------------------------------------------------------------------------------------
    using Spin = lane::Arrow<spins<D>, V>;
    Spin end(std::size_t link, std::size_t field) const { return get_vector<spins<D>>(pack_.of_end(link, field)); }
    void set_end(std::size_t link, std::size_t field, const Spin& to) const {
        put_vector(pack_.of_end(link, field), to);
    }

    static V number(double x) { return lane::spread<V>(x); }
    static V inverse_or_zero(const V& x) {
        return x >= number(std::numeric_limits<double>::min()) ? number(1) / x : V{};
    }

    [[gnu::flatten, gnu::noinline]] void factorise() const {
        const LinkLanes here = *this;
        for (std::uint32_t k = 0; k < here.pack_.links; ++k) here.factorise_row(k);
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
    const LinkPack<D> pack_; ///< a copy: stores of numbers might change what lies elsewhere
    std::size_t lane_;

    V get(const double* from) const { return lane::load<V>(from + lane_); }
    void put(double* to, const V& number) const { lane::store(to + lane_, number); }
    template <int N = D> lane::Arrow<N, V> get_vector(const double* from) const {
        lane::Arrow<N, V> v;
        for (std::size_t k = 0; k < std::size_t(N); ++k) v.at[k] = get(from + k * pack_.stride);
        return v;
    }
    template <int N> void put_vector(double* to, const lane::Arrow<N, V>& v) const {
        for (std::size_t k = 0; k < std::size_t(N); ++k) put(to + k * pack_.stride, v.at[k]);
    }

  private:

    /// n_i^T W n_j, W being the displacement of the ends by impulses on them: of particles, or of a cluster
    ///
    ///     1 / m + (r_i x n_i)^T I^-1 (r_j x n_j)
    V cluster_coupling(std::uint32_t i, std::uint32_t j) const {
        const auto &k = pack_.rows[i], &m = pack_.rows[j];
        V weights{}, turns{};
        const auto meet = [&](std::uint32_t a, std::uint32_t in_a, std::uint32_t b, std::uint32_t in_b,
                              std::size_t weight, std::size_t turn, std::size_t arm, double sign) {
            if (in_a != in_b || (in_a == no_member && a != b)) return;
            weights = weights + link(i, weight) * number(sign);
            if (in_a != no_member) turns = turns + dot(end(i, turn), end(j, arm)) * number(sign);
        };
        meet(k.a, k.cluster_a, m.a, m.cluster_a, Fields::weight_a, Fields::turn_a, Fields::arm_a, 1);
        meet(k.b, k.cluster_b, m.b, m.cluster_b, Fields::weight_b, Fields::turn_b, Fields::arm_b, 1);
        meet(k.a, k.cluster_a, m.b, m.cluster_b, Fields::weight_a, Fields::turn_a, Fields::arm_b, -1);
        meet(k.b, k.cluster_b, m.a, m.cluster_a, Fields::weight_b, Fields::turn_b, Fields::arm_a, -1);
        const V sum = weights * dot(link_vector(i, Fields::along), link_vector(j, Fields::along)) + turns;
        return sum * (link(i, Fields::active) * link(j, Fields::active));
    }
    V coupling(std::uint32_t i, std::uint32_t j) const {
        if (pack_.clusters > 0) return cluster_coupling(i, j);
        const auto &k = pack_.rows[i], &m = pack_.rows[j];
        V sum{};
        if (k.a == m.a) sum = sum + link(i, Fields::weight_a);
        if (k.b == m.b) sum = sum + link(i, Fields::weight_b);
        if (k.a == m.b) sum = sum - link(i, Fields::weight_a);
        if (k.b == m.a) sum = sum - link(i, Fields::weight_b);
        if (k.a != m.a && k.b != m.b && k.a != m.b && k.b != m.a) return sum;
        sum = sum * dot(link_vector(i, Fields::along), link_vector(j, Fields::along));
        return sum * (link(i, Fields::active) * link(j, Fields::active));
    }

    /// The diagonal is raised by a little: redundant links share their load, and the links of a straight rope held at
    /// both ends, singular across it, do not kick. The kick falls with the root of the softness; long or heavily loaded
    /// chains converge more slowly. A plane, whose rows keep their sides, gets by with less.
    void factorise_row(std::uint32_t k) const {
        constexpr double softness = D == 3 ? 1e-6 : 1e-7;
        const auto& row = pack_.rows[k];
        V pivot = link(k, Fields::weight_a) + link(k, Fields::weight_b);
        if (row.cluster_a != no_member) pivot = pivot + dot(end(k, Fields::turn_a), end(k, Fields::arm_a));
        if (row.cluster_b != no_member) pivot = pivot + dot(end(k, Fields::turn_b), end(k, Fields::arm_b));
        if (row.cluster_a != no_member && row.cluster_a == row.cluster_b)
            pivot = cluster_coupling(k, k);
        pivot = pivot * number(1 + softness);
        for (auto m = row.first; m < k; ++m) {
            const auto& other = pack_.rows[m];
            V sum = coupling(k, m);
            for (auto j = std::max(row.first, other.first); j < m; ++j)
                sum = sum -
                      get(pack_.entry(row.start + (j - row.first))) * get(pack_.entry(other.start + (j - other.first)));
            put(pack_.entry(row.start + (m - row.first)), sum); // times the pivot, for now
        }
        for (auto m = row.first; m < k; ++m) {
            double* const entry = pack_.entry(row.start + (m - row.first));
            const V scaled = get(entry) * link(m, Fields::pivot);
            pivot = pivot - get(entry) * scaled;
            put(entry, scaled);
        }
        set_link(k, Fields::pivot, link(k, Fields::active) > V{} ? inverse_or_zero(lane::max(pivot, V{})) : V{});
    }
};

} // namespace
} // namespace sinew
