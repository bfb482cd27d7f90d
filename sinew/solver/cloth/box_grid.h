#pragma once

#include "sinew/collide/bounding_box.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::detail {

/// Pairs of boxes that overlap, by a counting sort of the cells that each covers into hashed buckets. A pair is found
/// in the cell that is the lowest of one of its boxes on each axis, hence once. Memory is kept from one search to the
/// next.
template <class Real> class BoxGrid {
  public:
    using Box = collide::BoundingBox<3, Real>;

    void reserve(std::size_t boxes) {
        constexpr std::size_t cells_each = 24;
        start_.reserve(4 * boxes + min_buckets + 1);
        entries_.reserve(cells_each * boxes);
    }
    /// Sorts the boxes of these numbers.
    void fill(std::span<const Box> boxes, std::span<const std::uint32_t> numbers, Real cell) {
        per_cell_ = inverse_or_zero(cell);
        large_.clear();
        std::size_t buckets = min_buckets;
        while (buckets < 2 * numbers.size()) buckets *= 2;
        mask_ = std::uint32_t(buckets - 1);
        start_.assign(buckets + 1, 0);
        for (const auto i : numbers)
            if (is_large(boxes[i]))
                large_.push_back({i, 0, 0, boxes[i]});
            else
                each_cell(boxes[i], [&](std::uint32_t bucket, std::uint32_t, std::uint32_t) { ++start_[bucket]; });
        for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
        entries_.resize(start_.back());
        for (auto k = numbers.size(); k-- > 0;) // from the end: start_ arrives at the beginnings
            if (const auto i = numbers[k]; !is_large(boxes[i]))
                each_cell(boxes[i], [&](std::uint32_t bucket, std::uint32_t key, std::uint32_t lowest) {
                    entries_[--start_[bucket]] = {i, key, lowest, boxes[i]};
                });
    }

    /// Calls visit(i, k) for each pair of the sorted boxes.
    template <class Visit> void each_pair(Visit&& visit) const {
        for (std::size_t bucket = 0; bucket + 1 < start_.size(); ++bucket)
            for (auto i = start_[bucket]; i < start_[bucket + 1]; ++i)
                for (auto k = i + 1; k < start_[bucket + 1]; ++k)
                    if (is_pair(entries_[i], entries_[k])) visit(entries_[i].number, entries_[k].number);
        for (std::size_t i = 0; i < large_.size(); ++i) {
            for (std::size_t k = i + 1; k < large_.size(); ++k)
                if (large_[i].box.overlaps(large_[k].box)) visit(large_[i].number, large_[k].number);
            for (const auto& entry : entries_)
                if (entry.is_first() && entry.box.overlaps(large_[i].box)) visit(large_[i].number, entry.number);
        }
    }
    /// Calls visit(k) for each of the sorted boxes that overlaps another one.
    template <class Visit> void each_near(const Box& box, Visit&& visit) const {
        for (const auto& entry : large_)
            if (entry.box.overlaps(box)) visit(entry.number);
        if (is_large(box)) {
            for (const auto& entry : entries_)
                if (entry.is_first() && entry.box.overlaps(box)) visit(entry.number);
            return;
        }
        each_cell(box, [&](std::uint32_t bucket, std::uint32_t key, std::uint32_t lowest) {
            const Entry own{0, key, lowest, box};
            for (auto k = start_[bucket]; k < start_[bucket + 1]; ++k)
                if (is_pair(own, entries_[k])) visit(entries_[k].number);
        });
    }

  private:
    static constexpr std::size_t min_buckets = 64;
    static constexpr Real max_cells = 1024; ///< of a box; larger ones are compared with all

    struct Entry {
        std::uint32_t number = 0;
        std::uint32_t key = 0;    ///< low bits of the cell's coordinates
        std::uint32_t lowest = 0; ///< axes on which the cell is the box's lowest, as bits
        Box box{};

        /// True for one of the entries of a box.
        bool is_first() const { return lowest == 7; }
    };
    std::vector<std::uint32_t> start_; ///< first entry of each bucket
    std::vector<Entry> entries_, large_;
    std::uint32_t mask_ = 0;
    Real per_cell_ = 1;

    static bool is_pair(const Entry& a, const Entry& b) {
        return a.key == b.key && (a.lowest | b.lowest) == 7 && a.box.overlaps(b.box);
    }
    std::int32_t cell_of(Real coordinate) const {
        return std::int32_t(std::floor(clamp(coordinate * per_cell_, Real(-1e9), Real(1e9))));
    }
    bool is_large(const Box& box) const {
        Real cells = 1;
        for (int axis = 0; axis < 3; ++axis) cells *= (box.high[axis] - box.low[axis]) * per_cell_ + Real(1);
        return !(cells < max_cells);
    }
    /// Calls visit(bucket, key, lowest) for the cells of a box.
    template <class Visit> void each_cell(const Box& box, Visit&& visit) const {
        std::array<std::int32_t, 3> low, high;
        for (int axis = 0; axis < 3; ++axis)
            low[std::size_t(axis)] = cell_of(box.low[axis]), high[std::size_t(axis)] = cell_of(box.high[axis]);
        for (auto z = low[2]; z <= high[2]; ++z)
            for (auto y = low[1]; y <= high[1]; ++y)
                for (auto x = low[0]; x <= high[0]; ++x) {
                    const auto ux = std::uint32_t(x), uy = std::uint32_t(y), uz = std::uint32_t(z);
                    const auto bucket = ((ux * 73856093U ^ uy * 19349663U ^ uz * 83492791U) >> 3) & mask_;
                    const auto key = (ux & 1023U) | (uy & 1023U) << 10 | (uz & 1023U) << 20;
                    visit(bucket, key,
                          std::uint32_t(x == low[0]) | std::uint32_t(y == low[1]) << 1 |
                              std::uint32_t(z == low[2]) << 2);
                }
    }
};

} // namespace sinew::detail
