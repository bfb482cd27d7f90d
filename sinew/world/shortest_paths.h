#pragma once

#include "sinew/table/row_lists.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <queue>

namespace sinew {

/// Shortest paths along rigid links, a link as long as its upper limit (Dijkstra 1959). All queries together follow at
/// most `max_links` links; beyond the budget nothing is found.
class ShortestPaths {
  public:
    template <int D, class Real>
    explicit ShortestPaths(const World<D, Real>& world, std::size_t max_links)
        : length_to_(world.particles.size(), unknown), left_(max_links) {
        const auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
        links_.fill(world.particles.size(), [&](auto&& visit) {
            for (Row row = 0; row < distances.size(); ++row) {
                if (!distances.is_rigid(row) || !ties(distances, row)) continue;
                const auto& [a, b] = distances.members.rows[row];
                const double length = max(double(distances.high(row)), 0.0);
                visit(a, Link{row, b, length}), visit(b, Link{row, a, length});
            }
        });
    }

    /// Length of the shortest path from a to b, if shorter than `limit`, without the link `without`.
    std::optional<double> between(Row a, Row b, double limit, Row without) {
        std::optional<double> found;
        walk(a, limit, without, [&](Row row, double length) {
            if (row == b) found = length;
            return row != b;
        });
        return found;
    }

    struct Reached {
        Row row;
        double length;
    };

    /// Rows of the sorted `goals` connected to `start`, with path lengths.
    std::vector<Reached> from(Row start, std::span<const Row> goals) {
        std::vector<Reached> reached;
        walk(start, unknown, ~Row(0), [&](Row row, double length) {
            if (row != start && std::binary_search(goals.begin(), goals.end(), row)) reached.push_back({row, length});
            return true;
        });
        return reached;
    }

  private:
    static constexpr double unknown = std::numeric_limits<double>::infinity();
    struct Link {
        Row number = 0, to = 0;
        double length = 0;
    };

    RowLists<Link> links_;
    std::vector<double> length_to_;
    std::vector<Row> touched_;
    std::size_t left_;

    /// Calls visit(row, length), nearest first, until `visit` returns false.
    template <class Visit> void walk(Row start, double limit, Row without, Visit&& visit) {
        using Step = std::pair<double, Row>;
        std::priority_queue<Step, std::vector<Step>, std::greater<>> ahead;
        ahead.push({0, start});
        note(start, 0);
        while (!ahead.empty()) {
            const auto [length, row] = ahead.top();
            ahead.pop();
            if (length > length_to_[row]) continue;
            if (!visit(row, length)) break;
            for (const auto& link : links_[row]) {
                if (left_ == 0) break;
                --left_;
                const double further = length + link.length;
                if (link.number == without || further >= limit || further >= length_to_[link.to]) continue;
                note(link.to, further);
                ahead.push({further, link.to});
            }
        }
        for (const Row row : touched_) length_to_[row] = unknown;
        touched_.clear();
    }

    void note(Row row, double length) {
        if (length_to_[row] == unknown) touched_.push_back(row);
        length_to_[row] = length;
    }
};

} // namespace sinew
