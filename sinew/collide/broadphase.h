#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/math/random.h"
#include "sinew/math/sort.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::collide {

/// Pairs of overlapping boxes, found in a hashed grid. Pairs come in ascending order, whatever the grid looks like;
/// memory is kept from one search to the next.
template <int D, class Real> class Broadphase {
  public:
    using BoxT = BoundingBox<D, Real>;
    struct Pair {
        std::uint32_t first = 0, second = 0;
        friend constexpr auto operator<=>(const Pair&, const Pair&) = default;
    };

    /// All pairs first < second of overlapping boxes for which wanted(first, second).
    template <class Wanted> const std::vector<Pair>& find(std::span<const BoxT> boxes, Wanted&& wanted) {
        pairs_.clear();
        fill(boxes);
        for (std::size_t cell = 0; cell + 1 < start_.size(); ++cell) pair_up(boxes, cell, wanted);
        for (const auto i : large_) pair_large(boxes, i, wanted);
        sinew::sort(pairs_.begin(), pairs_.end());
        return pairs_;
    }

    /// Room for so many boxes, each near a few others.
    void reserve(std::size_t boxes) {
        constexpr std::size_t few = 8;
        std::size_t cells = 64;
        while (cells < boxes) cells *= 2;
        start_.reserve(cells + 2);
        large_.reserve(boxes), is_large_.reserve(boxes);
        entries_.reserve(few * boxes), sorted_.reserve(few * boxes), pairs_.reserve(few * boxes);
    }

  private:
    using Cell = std::array<std::int64_t, D>;
    struct Entry {
        Cell cell{};
        std::uint32_t bucket = 0, box = 0;
    };
    Real per_size_ = 1;
    std::vector<std::uint32_t> start_, large_;
    std::vector<char> is_large_;
    std::vector<Entry> entries_, sorted_;
    std::vector<Pair> pairs_;

    static constexpr std::int64_t max_cells = D == 2 ? 16 : 64; ///< boxes over more cells are compared with all others

    /// Cells twice as wide as the mean box.
    void choose_cell(std::span<const BoxT> boxes) {
        Real sum = 0, count = 0;
        for (const auto& box : boxes) {
            const Real size = widest(box);
            if (size < BoxT::huge) sum += size, count += Real(1);
        }
        const Real mean = count > Real(0) ? sum / count : Real(1);
        per_size_ = mean > Real(0) ? Real(0.5) / mean : Real(1);
    }
    static Real widest(const BoxT& box) {
        Real size = 0;
        for (int i = 0; i < D; ++i) size = max(size, box.high[i] - box.low[i]);
        return size;
    }
    Cell cell_of(const Vec<D, Real>& point) const {
        Cell cell{};
        for (int i = 0; i < D; ++i)
            cell[std::size_t(i)] = std::int64_t(std::floor(clamp(point[i] * per_size_, Real(-1e15), Real(1e15))));
        return cell;
    }
    std::uint32_t bucket_of(const Cell& cell) const {
        std::uint64_t hash = 0;
        for (const auto number : cell) hash = random::mix(hash + std::uint64_t(number));
        return std::uint32_t(hash % (start_.size() - 1));
    }

    void fill(std::span<const BoxT> boxes) {
        choose_cell(boxes);
        entries_.clear();
        large_.clear();
        is_large_.assign(boxes.size(), 0);
        std::size_t cells = 64;
        while (cells < boxes.size()) cells *= 2;
        start_.assign(cells + 1, 0);
        for (std::uint32_t i = 0; i < boxes.size(); ++i) enter(boxes[i], i);
        sort_by_cell();
    }

    template <class Visit> static void each_cell(const Cell& low, const Cell& high, Visit&& visit) {
        Cell cell = low;
        for (int axis = 0; axis < D;) {
            visit(cell);
            for (axis = 0; axis < D; ++axis) {
                if (++cell[std::size_t(axis)] <= high[std::size_t(axis)]) break;
                cell[std::size_t(axis)] = low[std::size_t(axis)];
            }
        }
    }

    void enter(const BoxT& box, std::uint32_t number) {
        const auto low = cell_of(box.low), high = cell_of(box.high);
        std::int64_t cells = 1;
        for (std::size_t i = 0; i < D; ++i) cells *= std::clamp<std::int64_t>(high[i] - low[i] + 1, 0, max_cells + 1);
        if (cells == 0) return; // around nothing
        if (cells > max_cells) {
            large_.push_back(number);
            is_large_[number] = 1;
            return;
        }
        each_cell(low, high, [&](const Cell& cell) {
            const auto bucket = bucket_of(cell);
            entries_.push_back({cell, bucket, number});
            ++start_[bucket + 1];
        });
    }
    void sort_by_cell() {
        for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
        sorted_.resize(entries_.size());
        for (auto i = entries_.size(); i-- > 0;) sorted_[--start_[entries_[i].bucket + 1]] = entries_[i];
        // the loop moved each end to the begin of its bucket
        start_.erase(start_.begin());
        start_.push_back(std::uint32_t(entries_.size()));
    }

    template <class Wanted> void pair_up(std::span<const BoxT> boxes, std::size_t bucket, Wanted&& wanted) {
        for (auto i = start_[bucket]; i < start_[bucket + 1]; ++i)
            for (auto k = i + 1; k < start_[bucket + 1]; ++k) {
                const auto &a = sorted_[i], &b = sorted_[k];
                if (a.cell == b.cell && is_first_common(boxes[a.box], boxes[b.box], a.cell))
                    add(boxes, a.box, b.box, wanted);
            }
    }
    /// Two boxes may share several cells: the pair counts in the lowest one.
    bool is_first_common(const BoxT& a, const BoxT& b, const Cell& cell) const {
        return cell_of(Vec<D, Real>::map([&](int i) { return max(a.low[i], b.low[i]); })) == cell;
    }
    template <class Wanted> void pair_large(std::span<const BoxT> boxes, std::uint32_t large, Wanted&& wanted) {
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            if (i != large && !(is_large_[i] && i < large)) add(boxes, large, i, wanted);
    }
    template <class Wanted> void add(std::span<const BoxT> boxes, std::uint32_t i, std::uint32_t k, Wanted&& wanted) {
        const auto first = std::min(i, k), second = std::max(i, k);
        if (boxes[i].overlaps(boxes[k]) && wanted(first, second)) pairs_.push_back({first, second});
    }
};

} // namespace sinew::collide
