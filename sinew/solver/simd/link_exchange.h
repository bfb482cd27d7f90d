#pragma once

#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/simd/link_solution.h"

namespace sinew {
namespace {

/// Exchange of a pack's lanes with the columns of the particles, and with the motions of clusters.
template <int D, class Real, class V> class LinkExchange : protected LinkSolution<D, V> {
  protected:
    using Solution = LinkSolution<D, V>;
    using Fields = LinkFields<D>;
    using Solution::number, Solution::lane_, Solution::pack_, Solution::particle, Solution::set_particle,
        Solution::width;
    using typename Solution::Mask;

    LinkExchange(const LinkColumns<D, Real>& columns, const LinkPack<D>& pack, std::size_t first_lane, int only)
        : Solution(pack, first_lane), columns_(columns), first_(only < 0 ? 0 : std::size_t(only) - first_lane),
          last_(only < 0 ? std::min(width, pack.count - first_lane) : first_ + 1) {}

    const LinkColumns<D, Real>& columns_;
    std::size_t first_, last_; ///< lanes in use

    Mask lanes_in_use() const {
        V flags{};
        for (std::size_t i = first_; i < last_; ++i) lane::put_lane(flags, int(i), 1.0);
        return flags > V{};
    }
    V gather(const Real* column, std::size_t i) const {
        const std::uint32_t* const slots = pack_.slots + i * pack_.stride + lane_;
        if constexpr (width > 1)
            if (are_adjacent(slots))
                return __builtin_convertvector((lane::load<lane::Pack<Real, int(width)>>(column + slots[0])), V);
        if constexpr (width == 1)
            return double(column[slots[0]]);
        else if constexpr (width == 2)
            return V{double(column[slots[0]]), double(column[slots[1]])};
        else
            return __builtin_convertvector((lane::gather<lane::Pack<Real, int(width)>, Real>(column, slots)), V);
    }
    /// Displacements, but for those of particles that move so (LinkPack::moves).
    [[gnu::flatten, gnu::noinline]] void load(char without = -1) const {
        const LinkExchange here = *this;
        here.load_here(without);
    }
    [[gnu::always_inline]] void load_here(char without) const {
        for (std::size_t i = 0; i < pack_.particles; ++i) {
            if (pack_.moves[i] == without) continue;
            const std::uint32_t* const slots = pack_.slots + i * pack_.stride + lane_;
            if constexpr (width > 1)
                if (are_adjacent(slots)) {
                    for (std::size_t k = 0; k < D; ++k)
                        set_particle(
                            i, Fields::displacement + k,
                            __builtin_convertvector((lane::load<lane::Pack<Real, int(width)>>(
                                                        columns_.displacement + k * columns_.stride + slots[0])),
                                                    V));
                    continue;
                }
            for (std::size_t k = 0; k < D; ++k)
                set_particle(i, Fields::displacement + k, gather(columns_.displacement + k * columns_.stride, i));
        }
    }
    /// True if the lanes lie side by side in the columns, as those of copies do.
    [[gnu::always_inline]] static bool are_adjacent(const std::uint32_t* slots) {
        std::uint32_t off = 0;
        for (std::size_t l = 1; l < width; ++l) off |= slots[l] ^ (slots[0] + std::uint32_t(l));
        return off == 0;
    }
    [[gnu::flatten, gnu::noinline]] void store() const {
        const LinkExchange here = *this;
        here.store_here();
    }
    [[gnu::always_inline]] void store_here() const {
        for (std::size_t i = 0; i < pack_.particles; ++i) {
            if (!pack_.moves[i]) continue; // another pack may read an immovable particle
            const std::uint32_t* const slots = pack_.slots + i * pack_.stride + lane_;
            if constexpr (width > 1)
                if (first_ == 0 && last_ == width && are_adjacent(slots)) {
                    for (std::size_t k = 0; k < D; ++k)
                        lane::store(columns_.displacement + k * columns_.stride + slots[0],
                                    __builtin_convertvector(particle(i, Fields::displacement + k),
                                                            lane::Pack<Real, int(width)>));
                    continue;
                }
            for (std::size_t k = 0; k < D; ++k) {
                const V numbers = particle(i, Fields::displacement + k);
                for (auto l = first_; l < last_; ++l)
                    columns_.displacement[k * columns_.stride + slots[l]] = Real(lane::lane_of(numbers, int(l)));
            }
        }
    }

    // --- clusters ----------------------------------------------------------------------------------------------------

    void show_motions() const {
        each_motion([&](ClusterMotion<D, Real>& motion, std::uint32_t c, std::size_t lane) {
            const auto numbers = [&](std::size_t field) {
                return [&, field](int k) { return Real(pack_.of_cluster(c, field + std::size_t(k))[lane]); };
            };
            motion.centre = centre(c, lane);
            motion.move = Vec<D, Real>::map(numbers(Fields::move));
            motion.turn = ClusterMotion<D, Real>::Spin::map(numbers(Fields::turn));
            motion.per_mass = numbers(Fields::per_mass)(0);
            const auto per_inertia = numbers(Fields::per_inertia);
            std::size_t next = 0;
            for (int i = 0; i < sinew::spins<D>; ++i)
                for (int j = i; j < sinew::spins<D>; ++j)
                    motion.per_inertia[next++] = per_inertia(i * sinew::spins<D> + j);
        });
    }
    void take_motions() const {
        each_motion([&](const ClusterMotion<D, Real>& motion, std::uint32_t c, std::size_t lane) {
            const auto put = [&](std::size_t field, const auto& numbers) {
                for (const Real x : numbers) pack_.of_cluster(c, field++)[lane] = double(x);
            };
            put(Fields::move, motion.move.component), put(Fields::turn, motion.turn.component);
        });
    }

  private:
    template <class Visit> void each_motion(const Visit& visit) const {
        for (std::uint32_t c = 0; c < pack_.clusters; ++c)
            for (auto l = first_; l < last_; ++l)
                visit(columns_.motions[pack_.first_cluster[lane_ + l] + c], c, lane_ + l);
    }
    /// Centre of mass, from the first member.
    Vec<D, Real> centre(std::uint32_t c, std::size_t lane) const {
        const auto first = pack_.members[pack_.cluster[c].first];
        const auto slot = pack_.slots[first * pack_.stride + lane];
        return Vec<D, Real>::map([&](int i) {
            const auto k = std::size_t(i);
            return Real(double(columns_.position[k * columns_.stride + slot]) +
                        pack_.of_particle(first, Fields::off + k)[lane] -
                        pack_.of_particle(first, Fields::arm + k)[lane]);
        });
    }
};

} // namespace
} // namespace sinew
