#pragma once

#include "sinew/math/lane.h"
#include "sinew/math/limit.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/simd/lane_vec.h"
#include "sinew/solver/simd/transpose.h"

#include <limits>

/// Exchange of positions, velocities, and masses between the rows of particles and the nodes of blocks in lanes. A
/// whole pack is transposed at once; a single lane, as when one block of a crowd has taken longer, number by number.
namespace sinew {
namespace {

using namespace lane;

/// The two numbers of each row, row after row, as many as fit into V.
template <class V, class Real>
[[gnu::always_inline]] inline V pairs_from(const Real* rows, const std::uint32_t* row_of) {
    if constexpr (lanes_of<V> == 2)
        return load<V>(rows + std::size_t(row_of[0]) * 2);
    else
        return lanes_from<V>(pairs_from<Half<V>>(rows, row_of), pairs_from<Half<V>>(rows, row_of + lanes_of<V> / 4),
                             [](std::size_t i) { return i; });
}
template <class V, class Real>
[[gnu::always_inline]] inline void put_pairs(Real* rows, const std::uint32_t* row_of, const V& pack) {
    if constexpr (lanes_of<V> == 2) {
        store(rows + std::size_t(row_of[0]) * 2, pack);
    } else {
        constexpr std::size_t half = lanes_of<V> / 2;
        put_pairs(rows, row_of, lanes_from<Half<V>>(pack, pack, [](std::size_t i) { return i; }));
        put_pairs(rows, row_of + half / 2, lanes_from<Half<V>>(pack, pack, [](std::size_t i) { return half + i; }));
    }
}

template <int D, class V, class Real>
[[gnu::always_inline]] inline Arrow<D, V> read_rows(const Real* rows, const std::uint32_t* row_of) {
    if constexpr (D == 2) {
        constexpr std::size_t half = lanes_of<V> / 2;
        const V a = pairs_from<V>(rows, row_of), b = pairs_from<V>(rows, row_of + half);
        return {lanes_from<V>(a, b, [](std::size_t i) { return 2 * i; }),
                lanes_from<V>(a, b, [](std::size_t i) { return 2 * i + 1; })};
    } else {
        V a = four_from<V>(rows, row_of), b = four_from<V>(rows, row_of + 1), c = four_from<V>(rows, row_of + 2);
        V d = four_from<V>(rows, row_of + 3);
        turn(a, b, c, d);
        return {a, b, c};
    }
}
template <int D, class V, class Real>
[[gnu::always_inline]] inline void write_rows(Real* rows, const std::uint32_t* row_of, const Arrow<D, V>& to) {
    if constexpr (D == 2) {
        constexpr std::size_t width = lanes_of<V>;
        put_pairs(rows, row_of, lanes_from<V>(to.at[0], to.at[1], [](std::size_t i) { return i / 2 + i % 2 * width; }));
        put_pairs(rows, row_of + width / 2,
                  lanes_from<V>(to.at[0], to.at[1], [](std::size_t i) { return (width + i) / 2 + i % 2 * width; }));
    } else {
        V a = to.at[0], b = to.at[1], c = to.at[2], d{};
        turn(a, b, c, d);
        put_three(rows, row_of, a);
        put_three(rows, row_of + 1, b);
        put_three(rows, row_of + 2, c);
        put_three(rows, row_of + 3, d);
    }
}

template <int D, class Real, int width> class NodeExchangeKernel {
    static constexpr bool is_wide = width >= 4;
    using Narrow = Pack<Real, width>;
    using V = Pack<double, width>;

  public:
    explicit NodeExchangeKernel(const NodeExchange<D, Real>& exchange) : e_(exchange) {}

    void load(int first, int last) const {
        for (std::uint32_t i = 0; i < e_.count; ++i)
            if (turns_whole_pack(first, last))
                load_pack(i);
            else
                for (int l = first; l < last; ++l) load_lane(i, l);
    }
    void store(int first, int last) const {
        for (std::uint32_t i = 0; i < e_.count; ++i)
            if (turns_whole_pack(first, last))
                store_pack(i);
            else
                for (int l = first; l < last; ++l) store_lane(i, l);
    }

  private:
    const NodeExchange<D, Real>& e_;

    static constexpr double normal = std::numeric_limits<double>::min(); // a smaller mobility is none
    static constexpr double fastest = double(limit::speed<Real>), furthest = double(limit::coordinate<Real>);

    bool turns_whole_pack(int first, int last) const {
        return is_wide && last - first == width && e_.width == width && !e_.has_last_row;
    }
    const std::uint32_t* rows_of(std::uint32_t node) const { return e_.rows + node * std::size_t(e_.width); }
    double* numbers_of(std::uint32_t node) const { return e_.nodes + node * e_.numbers * std::size_t(e_.width); }

    void load_lane(std::uint32_t node, int l) const {
        const std::size_t row = rows_of(node)[l], stride = std::size_t(e_.width);
        double* to = numbers_of(node) + l;
        for (std::size_t k = 0; k < D; ++k, to += stride)
            *to = double(e_.position[row * D + k]) + double(e_.residual[row * D + k]);
        for (std::size_t k = 0; k < D; ++k, to += stride) *to = double(e_.velocity[row * D + k]);
        const double mobility = double(e_.inverse_mass[row]);
        *to = mobility >= normal ? 1 / mobility : 0;
    }
    void store_lane(std::uint32_t node, int l) const {
        const std::size_t row = rows_of(node)[l], stride = std::size_t(e_.width);
        const double* from = numbers_of(node) + l;
        for (std::size_t k = 0; k < D; ++k, from += stride) {
            const double position = within(*from, furthest);
            const auto held = Real(position);
            e_.position[row * D + k] = held;
            e_.residual[row * D + k] = Real(position - double(held));
        }
        for (std::size_t k = 0; k < D; ++k, from += stride) e_.velocity[row * D + k] = Real(within(*from, fastest));
    }

    static V wide(const Narrow& pack) { return __builtin_convertvector(pack, V); }
    static Narrow narrow(const V& pack) { return __builtin_convertvector(pack, Narrow); }

    void load_pack(std::uint32_t node) const {
        if constexpr (is_wide) {
            const auto* const rows = rows_of(node);
            double* const to = numbers_of(node);
            const auto position = read_rows<D, Narrow>(e_.position, rows),
                       rest = read_rows<D, Narrow>(e_.residual, rows);
            const auto velocity = read_rows<D, Narrow>(e_.velocity, rows);
            const V mobility = wide(gather_each(e_.inverse_mass, rows));
            for (int k = 0; k < D; ++k) {
                lane::store(to + k * width, V(wide(position.at[k]) + wide(rest.at[k])));
                lane::store(to + (D + k) * width, wide(velocity.at[k]));
            }
            lane::store(to + 2 * D * width, mobility >= spread<V>(normal) ? spread<V>(1.0) / mobility : V{});
        }
    }
    void store_pack(std::uint32_t node) const {
        if constexpr (is_wide) {
            const auto* const rows = rows_of(node);
            const double* const from = numbers_of(node);
            Arrow<D, Narrow> held, rest, velocity;
            for (int k = 0; k < D; ++k) {
                const V position = within(lane::load<V>(from + k * width), spread<V>(furthest));
                held.at[k] = narrow(position);
                rest.at[k] = narrow(position - wide(held.at[k]));
                velocity.at[k] = narrow(within(lane::load<V>(from + (D + k) * width), spread<V>(fastest)));
            }
            write_rows<D>(e_.position, rows, held);
            write_rows<D>(e_.residual, rows, rest);
            write_rows<D>(e_.velocity, rows, velocity);
        }
    }
    static Narrow gather_each(const Real* column, const std::uint32_t* rows) {
        Narrow pack{};
        for (int l = 0; l < width; ++l) put_lane(pack, l, column[rows[l]]);
        return pack;
    }
};

template <int D, class Real> void load_nodes(const NodeExchange<D, Real>& exchange, int first, int last) {
    NodeExchangeKernel<D, Real, widest<double>>(exchange).load(first, last);
}
template <int D, class Real> void store_nodes(const NodeExchange<D, Real>& exchange, int first, int last) {
    NodeExchangeKernel<D, Real, widest<double>>(exchange).store(first, last);
}

} // namespace
} // namespace sinew
