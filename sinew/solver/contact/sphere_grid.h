#pragma once

#include "sinew/math/scalar.h"
#include "sinew/math/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::detail {

/// Pairs of points nearer to each other than a common distance, by a counting sort into hashed cells. A row of cells
/// along the first axis is consecutive in memory. Memory is kept from one search to the next.
template <int D, class Real> class SphereGrid {
  public:
    using Vector = Vec<D, Real>;

    /// Calls visit(i, k) for each pair within the distance; a pair may come twice, in either order.
    template <class Visit> void each_pair(std::span<const Vector> points, Real distance, Visit&& visit) {
        sort(points, distance);
        const Real within = square(distance);
        for (std::uint32_t i = 0; i < points.size(); ++i)
            each_range_ahead(i, [&](std::uint32_t first, std::uint32_t last) {
                while (first < last) {
                    const auto end = std::min(last, first + at_once);
                    const auto near = find_near(i, first, end, within);
                    for (std::uint32_t k = 0; k < near; ++k) visit(number_[i], near_[k]);
                    first = end;
                }
            });
    }
    void reserve(std::size_t points) {
        for (auto* column : {&number_, &bucket_, &bucket_of_}) column->reserve(points);
        start_.reserve(2 * points + min_buckets + 1);
        sorted_.reserve(points);
    }

  private:
    static constexpr std::size_t min_buckets = 64;
    static constexpr std::array<std::uint32_t, 3> stride = {1, 73856093, 19349663}; ///< of the hash, by axis

    std::vector<std::uint32_t> start_;              ///< first point of each bucket
    std::vector<std::uint32_t> bucket_, bucket_of_; ///< of each point, sorted and as given
    std::vector<std::uint32_t> number_;             ///< sorted
    std::vector<Vector> sorted_;
    std::uint32_t mask_ = 0;
    static constexpr std::uint32_t at_once = 64;
    std::array<std::uint32_t, at_once> near_{}; ///< scratch

    /// Lists those of the sorted points [first, last) that are near point i; without branches, which would be taken at
    /// random. Returns their number.
    std::uint32_t find_near(std::uint32_t i, std::uint32_t first, std::uint32_t last, Real within) {
        const auto own = sorted_[i];
        std::uint32_t count = 0;
        for (auto k = first; k < last; ++k) {
            const auto away = sorted_[k] - own;
            near_[count] = number_[k]; // overwritten unless it counts
            count += dot(away, away) < within;
        }
        return count;
    }

    std::uint32_t bucket_at(const Vector& point, Real per_size) const {
        std::uint32_t sum = 0;
        for (int axis = 0; axis < D; ++axis) {
            const Real cell = std::floor(clamp(point[axis] * per_size, Real(-1e9), Real(1e9)));
            sum += stride[std::size_t(axis)] * std::uint32_t(std::int32_t(cell));
        }
        return sum & mask_;
    }

    void sort(std::span<const Vector> points, Real size) {
        std::size_t buckets = min_buckets;
        while (buckets < points.size()) buckets *= 2;
        mask_ = std::uint32_t(buckets - 1);
        start_.assign(buckets + 1, 0);
        bucket_of_.clear();
        for (const auto& point : points) {
            bucket_of_.push_back(bucket_at(point, Real(1) / size));
            ++start_[bucket_of_.back() + 1];
        }
        for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
        for (auto* column : {&number_, &bucket_}) column->resize(points.size());
        sorted_.resize(points.size());
        for (auto i = std::uint32_t(points.size()); i-- > 0;) { // from the end: start_ arrives at the beginnings
            const auto at = --start_[bucket_of_[i] + 1];
            number_[at] = i, bucket_[at] = bucket_of_[i], sorted_[at] = points[i];
        }
        start_.erase(start_.begin());
        start_.push_back(std::uint32_t(points.size()));
    }

    /// Calls visit(first, last) for the sorted points in the half of the cells around a point that comes after it.
    template <class Visit> void each_range_ahead(std::uint32_t i, Visit&& visit) const {
        const auto own = bucket_[i];
        visit(i + 1, start_[own + 1]);
        each_of_row(own + 1, 1, visit);
        if constexpr (D == 2) {
            each_of_row(own + stride[1] - 1, 3, visit);
        } else {
            each_of_row(own + stride[1] - 1, 3, visit);
            for (std::uint32_t y : {std::uint32_t(0) - stride[1], std::uint32_t(0), stride[1]})
                each_of_row(own + stride[2] + y - 1, 3, visit);
        }
    }
    template <class Visit> void each_of_row(std::uint32_t bucket, std::uint32_t count, Visit&& visit) const {
        const auto first = bucket & mask_;
        if (first + count <= mask_ + 1) return visit(start_[first], start_[first + count]);
        for (std::uint32_t k = 0; k < count; ++k) {
            const auto at = (first + k) & mask_;
            visit(start_[at], start_[at + 1]);
        }
    }
};

} // namespace sinew::detail
