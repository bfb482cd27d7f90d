#pragma once

#include "sinew/assert/assert.h"
#include "sinew/math/sort.h"
#include "sinew/table/id.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace sinew {

inline constexpr auto no_row = ~Row(0);

/// Elimination order of a sparse symmetric matrix, and its fill, by minimum degree (Tinney and Walker 1967): trees have
/// no fill. Matrices with too much fill are refused. Memory is kept for the next run.
class Elimination {
  public:
    void make_room(std::size_t rows) {
        begin_.resize(rows), size_.resize(rows);
        for (auto* column : {&position_, &before_, &after_}) column->resize(rows);
    }
    /// Reserves memory for a graph of so many rows and neighbours.
    void reserve(std::size_t rows, std::size_t neighbours) {
        pool_.reserve(max_pool(neighbours) + max_neighbours);
        order_.reserve(rows);
        merged_.reserve(most_of_hub + max_neighbours);
    }

    /// Defines the graph row by row: begin_row, neighbours, end_row.
    void begin_graph() { pool_.clear(); }
    void begin_row(Row row) {
        SINEW_ASSERT(row < begin_.size(), "make_room() has been called for the row");
        begin_[row] = pool_.size();
    }
    void add_neighbour(Row neighbour) { pool_.push_back(neighbour); }
    void end_row(Row row) {
        const auto first = pool_.begin() + std::ptrdiff_t(begin_[row]);
        sinew::sort(first, pool_.end());
        pool_.erase(std::unique(first, pool_.end()), pool_.end());
        size_[row] = std::uint32_t(pool_.size() - begin_[row]);
    }

    /// Computes the order. False if the matrix would not stay sparse.
    bool run(std::span<const Row> rows) {
        const auto max = max_pool(pool_.size());
        order_.clear();
        waiting_ = {};
        for (const Row row : rows)
            if (!wait(row)) return false;
        while (order_.size() < rows.size()) {
            const Row next = min_degree();
            if (next == no_row) return false;
            stop_waiting(next);
            SINEW_ASSERT(size_[next] <= max_neighbours, "a row with few neighbours is eliminated");
            position_[next] = Row(order_.size());
            order_.push_back(next);
            for (std::uint32_t i = 0; i < size_[next]; ++i) {
                const Row neighbour = neighbours(next)[i];
                stop_waiting(neighbour);
                merge(neighbour, next);
                if (!wait(neighbour)) return false;
            }
            if (pool_.size() > max) return false;
        }
        return true;
    }

    /// Number of pairs of coupled neighbours over all rows; an upper bound on every other size.
    std::size_t pairs() const {
        std::size_t sum = 0;
        for (const Row row : order_) sum += size_[row] * (size_[row] + 1) / 2;
        return sum;
    }

    std::span<const Row> order() const { return order_; }
    Row position(Row row) const { return position_[row]; }
    /// Rows eliminated later and coupled with `row`, fill included.
    std::span<const Row> neighbours(Row row) const { return std::span(pool_).subspan(begin_[row], size_[row]); }

  private:
    static constexpr std::size_t max_neighbours = 15; ///< largest degree of an eliminated row
    /// Largest degree before: a hub is eliminated after most of its neighbours, at no more cost than a neighbour.
    static constexpr std::size_t most_of_hub = 500;
    static std::size_t max_pool(std::size_t neighbours) { return 8 * neighbours + 1024; }

    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> size_;
    std::vector<Row> position_, pool_, order_, merged_;

    /// Rows not yet eliminated, by degree: doubly linked lists.
    struct Queue {
        Row first = no_row, last = no_row;
    };
    std::array<Queue, max_neighbours + 1> waiting_{};
    std::vector<Row> before_, after_;

    bool wait(Row row) {
        if (size_[row] > max_neighbours) return size_[row] <= most_of_hub;
        auto& queue = waiting_[size_[row]];
        before_[row] = queue.last, after_[row] = no_row;
        (queue.last == no_row ? queue.first : after_[queue.last]) = row;
        queue.last = row;
        return true;
    }
    void stop_waiting(Row row) {
        if (size_[row] > max_neighbours) return;
        auto& queue = waiting_[size_[row]];
        (before_[row] == no_row ? queue.first : after_[before_[row]]) = after_[row];
        (after_[row] == no_row ? queue.last : before_[after_[row]]) = before_[row];
    }

    /// Row of least degree, first in first out: a chain is eliminated from both ends in turn, two independent
    /// recurrences for the processor.
    Row min_degree() {
        for (auto& queue : waiting_)
            if (queue.first != no_row) return queue.first;
        return no_row;
    }

    /// Adds the neighbours of an eliminated row to the neighbours of `row`.
    void merge(Row row, Row gone) {
        merged_.clear();
        const auto mine = neighbours(row), others = neighbours(gone);
        std::set_union(mine.begin(), mine.end(), others.begin(), others.end(), std::back_inserter(merged_));
        std::erase_if(merged_, [&](Row other) { return other == row || other == gone; });
        if (merged_.size() > size_[row]) {
            begin_[row] = pool_.size();
            pool_.resize(pool_.size() + merged_.size());
        }
        std::copy(merged_.begin(), merged_.end(), pool_.begin() + std::ptrdiff_t(begin_[row]));
        size_[row] = std::uint32_t(merged_.size());
    }
};

} // namespace sinew
