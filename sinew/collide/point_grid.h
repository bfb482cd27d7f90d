#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/grid_cell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::collide {

/// Points by hashed cells, after a counting sort; memory is kept from one use to the next.
template <int D, class Real> class PointGrid {
  public:
    using Vector = Vec<D, Real>;

    void fill(std::span<const Vector> points, Real size) {
        per_size_ = Real(1) / size;
        std::size_t buckets = 64;
        while (buckets < points.size()) buckets *= 2;
        mask_ = std::uint32_t(buckets - 1);
        start_.assign(buckets + 2, 0);
        cell_of_.clear();
        for (const auto& point : points) {
            cell_of_.push_back(cell_at(point));
            ++start_[bucket_at(cell_of_.back()) + 2];
        }
        for (std::size_t i = 2; i < start_.size(); ++i) start_[i] += start_[i - 1];
        sorted_.resize(points.size());
        for (std::uint32_t i = 0; i < points.size(); ++i)
            sorted_[start_[bucket_at(cell_of_[i]) + 1]++] = {cell_of_[i], i};
    }

    /// Calls visit(i) for every point in a cell that the box meets, in no useful order.
    template <class Visit> void each_near(const BoundingBox<D, Real>& box, Visit&& visit) const {
        const auto low = cell_at(box.low), high = cell_at(box.high);
        if (cells_between(low, high) > Real(sorted_.size())) {
            for (const auto& entry : sorted_) visit(entry.point);
            return;
        }
        each_cell(low, high, [&](const Cell& cell) {
            const auto bucket = bucket_at(cell);
            for (auto k = start_[bucket]; k < start_[bucket + 1]; ++k)
                if (is_same(sorted_[k].cell, cell)) visit(sorted_[k].point);
        });
    }

  private:
    using Cell = std::array<std::int32_t, D>;
    struct Entry {
        Cell cell{};
        std::uint32_t point = 0;
    };
    Real per_size_ = 1;
    std::uint32_t mask_ = 0;
    std::vector<std::uint32_t> start_; ///< first entry of each bucket
    std::vector<Cell> cell_of_;        ///< per point
    std::vector<Entry> sorted_;

    /// Without a call of memcmp, into which g++ turns the comparison of arrays.
    static bool is_same(const Cell& a, const Cell& b) {
        std::int32_t off = 0;
        for (std::size_t i = 0; i < D; ++i) off |= a[i] ^ b[i];
        return off == 0;
    }
    Cell cell_at(const Vector& point) const { return collide::cell_at<std::int32_t>(point, per_size_); }
    std::uint32_t bucket_at(const Cell& cell) const {
        constexpr std::array<std::uint32_t, 3> factor = {0x9e3779b1U, 0x85ebca77U, 0xc2b2ae3dU};
        std::uint32_t hash = 0;
        for (std::size_t i = 0; i < D; ++i) hash ^= std::uint32_t(cell[i]) * factor[i];
        return (hash ^ hash >> 15U) & mask_;
    }
    static Real cells_between(const Cell& low, const Cell& high) {
        Real cells = 1;
        for (std::size_t i = 0; i < D; ++i) cells *= Real(high[i]) - Real(low[i]) + Real(1);
        return cells;
    }
    template <class Visit> static void each_cell(const Cell& low, const Cell& high, Visit&& visit) {
        Cell cell = low;
        for (std::size_t axis = 0; axis < D;) {
            visit(cell);
            for (axis = 0; axis < D; ++axis) {
                if (++cell[axis] <= high[axis]) break;
                cell[axis] = low[axis];
            }
        }
    }
};

} // namespace sinew::collide
