#include "sinew/solver/simd/kernel.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <vector>

/// The kernels that every kind of processor has for itself.
namespace sinew::SINEW_TEST_FILE {
namespace {

/// With each kind that this processor has.
template <class Check> void on_each(Check&& check) {
    for (const Simd simd : {Simd::one, Simd::sse2, Simd::avx2, Simd::avx512})
        if (has_simd(simd)) {
            SCOPED_TRACE(name_of(simd));
            check(simd);
        }
}

template <class Real> void expect_found(Simd simd, Real number, Real limit, bool in_limits, bool and_positive) {
    for (const std::size_t count : {1U, 3U, 8U, 21U, 64U})
        for (std::size_t at = 0; at < count; ++at) {
            std::vector<Real> numbers(count, limit);
            numbers[at] = number;
            const auto& kernel = kernels<3, Real>(simd);
            EXPECT_EQ(kernel.all_within(numbers.data(), count, limit), in_limits) << number << " at " << at;
            EXPECT_EQ(kernel.all_within_and_positive(numbers.data(), count, limit), and_positive) << number;
        }
}
template <class Real> void expect_all_found(Simd simd) {
    using Limits = std::numeric_limits<Real>;
    const Real limit = Real(1e8), above = std::nextafter(limit, Limits::max());
    for (const Real fine : {Real(0), -Real(0), Limits::denorm_min(), limit})
        expect_found(simd, fine, limit, true, true);
    for (const Real negative : {-Limits::denorm_min(), Real(-1), -limit})
        expect_found(simd, negative, limit, true, false);
    for (const Real wrong : {above, -above, Limits::max(), Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(),
                             -Limits::quiet_NaN()})
        expect_found(simd, wrong, limit, false, false);
}

TEST(Kernels, FindWhatIsInNoLimitsWhereverItIs) {
    on_each(expect_all_found<float>);
    on_each(expect_all_found<double>);
}

/// Rows in some order, each with numbers of its own.
template <int D, class Real> void expect_turned(Simd simd) {
    constexpr std::uint32_t size = 45, stride = 64, room = 16;
    std::vector<std::uint32_t> row_of(size);
    for (std::uint32_t slot = 0; slot < size; ++slot) row_of[slot] = 7 * slot % size;
    std::vector<Real> rows(size * D);
    std::iota(rows.begin(), rows.end(), Real(-50));
    for (const std::uint32_t first : {0U, 1U, 5U})
        for (std::uint32_t last = first; last <= size; ++last) {
            std::vector<Real> columns(D * stride + room, Real(1000)), back(rows.size(), Real(1000));
            Transposition<D, Real> turning{};
            turning.rows = rows.data(), turning.columns = columns.data(), turning.stride = stride;
            turning.row_of = row_of.data();
            turning.slot_of_last = std::uint32_t(std::find(row_of.begin(), row_of.end(), size - 1) - row_of.begin());
            turning.by = 2, turning.max = 60;
            kernels<D, Real>(simd).to_columns(turning, first, last);
            turning.rows = back.data(), turning.by = Real(0.5), turning.max = 20;
            kernels<D, Real>(simd).to_rows(turning, first, last);
            for (std::uint32_t slot = 0; slot < size; ++slot)
                for (unsigned k = 0; k < D; ++k) {
                    const Real was = rows[D * row_of[slot] + k], twice = std::clamp(2 * was, Real(-60), Real(60));
                    const bool turned = slot >= first && slot < last;
                    EXPECT_EQ(columns[k * stride + slot], turned ? twice : Real(1000)) << first << ' ' << last;
                    EXPECT_EQ(back[D * row_of[slot] + k],
                              turned ? std::clamp(twice / 2, Real(-20), Real(20)) : Real(1000))
                        << first << ' ' << last;
                }
        }
}

TEST(Kernels, TurnRowsIntoColumnsAndBackAndTouchNothingElse) {
    on_each(expect_turned<2, float>);
    on_each(expect_turned<3, float>);
    on_each(expect_turned<2, double>);
    on_each(expect_turned<3, double>);
}

/// Quarantine looks for them in rows.
template <int D, class Real> void expect_none_kept(Simd simd) {
    constexpr std::uint32_t size = 17, stride = 32;
    std::vector<std::uint32_t> row_of(size);
    std::iota(row_of.begin(), row_of.end(), 0U);
    std::vector<Real> columns(D * stride, std::numeric_limits<Real>::quiet_NaN()), rows(size * D);
    Transposition<D, Real> turning{};
    turning.rows = rows.data(), turning.columns = columns.data(), turning.stride = stride;
    turning.row_of = row_of.data(), turning.slot_of_last = size - 1, turning.max = 20;
    kernels<D, Real>(simd).to_rows(turning, 0, size);
    for (const Real number : rows) EXPECT_TRUE(std::isnan(number));
}

TEST(Kernels, ToRowsKeepsWhatIsNoNumber) {
    on_each(expect_none_kept<2, float>);
    on_each(expect_none_kept<3, float>);
    on_each(expect_none_kept<2, double>);
    on_each(expect_none_kept<3, double>);
}

/// Particles, each with numbers of its own; the third is immovable.
template <int D, class Real> struct ExchangedParticles {
    static constexpr std::uint32_t size = 40;
    std::vector<Real> position = std::vector<Real>(size * D), residual = position, velocity = position;
    std::vector<Real> inverse_mass = std::vector<Real>(size);

    ExchangedParticles() {
        std::iota(position.begin(), position.end(), Real(-50));
        std::iota(velocity.begin(), velocity.end(), Real(1000));
        for (std::uint32_t i = 0; i < size * D; ++i) residual[i] = Real(1e-6) * Real(i % 7);
        for (std::uint32_t i = 0; i < size; ++i) inverse_mass[i] = i == 2 ? Real(0) : 1 / Real(1 + i);
    }
    bool operator==(const ExchangedParticles&) const = default;
};

/// Nodes of all lanes at once, or of one lane; with and without the last particle.
template <int D, class Real> void expect_exchanged(Simd simd) {
    using Particles = ExchangedParticles<D, Real>;
    constexpr std::size_t numbers = 2 * D + 3, count = 4;
    const auto& kernel = kernels<D, Real>(simd);
    const auto width = std::size_t(kernel.block_lanes);
    for (const std::uint32_t furthest : {Particles::size - 1, Particles::size - 2})
        for (int first = 0; first < int(width); ++first)
            for (const int last : {first + 1, int(width)}) {
                Particles particles;
                std::vector<double> nodes(count * numbers * width, 7.0);
                std::vector<std::uint32_t> rows(count * width);
                for (std::uint32_t i = 0; i < rows.size(); ++i) rows[i] = furthest - i;
                const NodeExchange<D, Real> exchange{.nodes = nodes.data(),
                                                     .numbers = numbers,
                                                     .count = count,
                                                     .width = int(width),
                                                     .rows = rows.data(),
                                                     .has_last_row = furthest + 1 == Particles::size,
                                                     .position = particles.position.data(),
                                                     .residual = particles.residual.data(),
                                                     .velocity = particles.velocity.data(),
                                                     .inverse_mass = particles.inverse_mass.data()};
                kernel.load_nodes(exchange, first, last);
                for (std::size_t i = 0; i < nodes.size(); ++i) {
                    const std::size_t lane = i % width, number = i / width % numbers, node = i / width / numbers;
                    const std::size_t row = rows[node * width + lane], k = number % D;
                    double expected = 7;
                    if (int(lane) < first || int(lane) >= last || number > 2 * D)
                        expected = 7;
                    else if (number < D)
                        expected = double(particles.position[row * D + k]) + double(particles.residual[row * D + k]);
                    else if (number < 2 * D)
                        expected = double(particles.velocity[row * D + k]);
                    else
                        expected = row == 2 ? 0 : 1 / double(particles.inverse_mass[row]);
                    EXPECT_EQ(nodes[i], expected) << "number " << number << " of node " << node << ", lane " << lane;
                }
                for (auto& number : nodes) number += 1e-3;
                Particles expected = particles;
                for (std::size_t node = 0; node < count; ++node)
                    for (auto lane = std::size_t(first); lane < std::size_t(last); ++lane)
                        for (std::size_t k = 0; k < D; ++k) {
                            const std::size_t to = std::size_t(rows[node * width + lane]) * D + k;
                            const double* const from = nodes.data() + node * numbers * width + lane;
                            expected.position[to] = Real(from[k * width]);
                            expected.residual[to] = Real(from[k * width] - double(Real(from[k * width])));
                            expected.velocity[to] = Real(from[(D + k) * width]);
                        }
                kernel.store_nodes(exchange, first, last);
                EXPECT_EQ(particles, expected) << first << ' ' << last;
            }
}

TEST(Kernels, ExchangeNodesWithParticlesAndTouchNothingElse) {
    on_each(expect_exchanged<2, float>);
    on_each(expect_exchanged<3, float>);
    on_each(expect_exchanged<2, double>);
    on_each(expect_exchanged<3, double>);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
