#pragma once

#include "sinew/collide/bounding_box.h"

#include <cstdint>
#include <vector>

namespace sinew::detail {

/// Binary tree of boxes over features in a fixed order: neighbours in the order should be neighbours in space.
template <class Real> class BoxTree {
  public:
    using Box = collide::BoundingBox<3, Real>;

    void reserve(std::size_t features) { nodes_.reserve(4 * features + 2); }
    /// Fills the tree with the boxes of features 0 to count - 1.
    template <class BoxOf> void fill(std::size_t count, BoxOf&& box_of) {
        first_leaf_ = 1;
        while (first_leaf_ < count) first_leaf_ *= 2;
        nodes_.assign(2 * first_leaf_, Box{});
        for (std::size_t i = 0; i < count; ++i) nodes_[first_leaf_ + i] = box_of(i);
        for (auto i = first_leaf_; i-- > 1;) nodes_[i] = united(nodes_[2 * i], nodes_[2 * i + 1]);
    }

    /// Calls visit(i) for the features whose boxes overlap a box, in order.
    template <class Visit> void each_near(const Box& box, Visit&& visit) const { descend(1, box, visit); }

  private:
    std::vector<Box> nodes_; ///< node i has the children 2 i and 2 i + 1
    std::size_t first_leaf_ = 1;

    static Box united(const Box& a, const Box& b) {
        using Vector = typename Box::Vector;
        return {Vector::map([&](int k) { return min(a.low[k], b.low[k]); }),
                Vector::map([&](int k) { return max(a.high[k], b.high[k]); })};
    }
    template <class Visit> void descend(std::size_t node, const Box& box, Visit& visit) const {
        if (!nodes_[node].overlaps(box)) return;
        if (node >= first_leaf_) return visit(std::uint32_t(node - first_leaf_));
        descend(2 * node, box, visit);
        descend(2 * node + 1, box, visit);
    }
};

} // namespace sinew::detail
