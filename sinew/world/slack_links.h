#pragma once

#include "sinew/constraint/distance.h"
#include "sinew/math/limit.h"
#include "sinew/math/sort.h"
#include "sinew/table/id.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace sinew {

/// Length below which bends of a link's ends fade; 0 for a link that keeps its length. Nothing turns a leg of no
/// length, so a bending spring that acted on it with all its strength would gain half a turn's energy each time the leg
/// passed through zero. Links with slack fade below their length, springs below half of it.
template <class Distances> double fading_length(const Distances& distances, Row link) {
    using Real = std::decay_t<decltype(distances.high(link))>;
    const Real high = distances.high(link);
    if (!(high < limit::coordinate<Real>)) return 0;
    if (distances.low(link) < high) return double(high);
    return distances.compliance[link] > Real(0) ? 0.5 * double(high) : 0;
}

/// A link that can shrink.
struct SlackLink {
    Row a = 0, b = 0, row = 0; ///< its ends, in order, and its row
    double length = 0;         ///< fading_length
};

/// Links that can shrink, to be found by their ends.
class SlackLinks {
  public:
    template <class Distances> SlackLinks(const Distances& distances, std::vector<SlackLink>& links) : links_(links) {
        links_.clear();
        for (Row row = 0; row < distances.size(); ++row)
            if (const double length = fading_length(distances, row); length > 0) {
                const auto ends = std::minmax({distances.members[row][0], distances.members[row][1]});
                links_.push_back({ends.first, ends.second, row, length});
            }
        const auto order = [](const SlackLink& link) { return std::tuple(link.a, link.b, link.row); };
        sinew::sort(links_.begin(), links_.end(),
                    [&](const SlackLink& x, const SlackLink& y) { return order(x) < order(y); });
    }

    /// The last link between two particles; null if there is none.
    const SlackLink* between(Row first, Row second) const {
        const auto ends = std::minmax({first, second});
        const auto after =
            std::upper_bound(links_.begin(), links_.end(), ends,
                             [](const auto& e, const SlackLink& link) { return e < std::pair(link.a, link.b); });
        if (after == links_.begin() || (after - 1)->a != ends.first || (after - 1)->b != ends.second) return nullptr;
        return &*(after - 1);
    }

    /// Fraction of an angle spring's energy: product of (leg / fading length)^2 over its legs, each at most 1.
    template <class Point> double tautness(std::span<const Row> members, Point&& point) const {
        double share = 1;
        for (std::size_t i = 0; i + 1 < members.size(); ++i)
            if (const auto* link = between(members[i], members[i + 1])) {
                const auto leg = point(members[i + 1]) - point(members[i]);
                share *= min(dot(leg, leg) / square(link->length), 1.0);
            }
        return share;
    }

  private:
    std::vector<SlackLink>& links_;
};

} // namespace sinew
