#pragma once

#include "sinew/assert/assert.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sinew {

/// Priority queue of particles by path length, ties by number. A calendar queue (Brown 1988): items about as near as
/// the last one taken are in a heap, all others in cyclic buckets by length.
class BucketQueue {
  public:
    struct Item {
        double length;
        std::uint32_t number;
        friend bool operator>(const Item& a, const Item& b) {
            return a.length > b.length || (a.length == b.length && a.number > b.number);
        }
    };

    /// Fast if items are at most `step` further than the last one taken.
    explicit BucketQueue(double step) : per_length_(step > 0 ? double(rounds - 1) / step : 1), later_(rounds) {}

    void put(const Item& item) {
        SINEW_ASSERT(item.length >= 0, "a path has a length");
        ++count_;
        const auto bucket = bucket_of(item);
        if (bucket > now_) return later_[bucket % rounds].push_back(item);
        near_.push_back(item);
        std::push_heap(near_.begin(), near_.end(), std::greater<>());
    }
    bool empty() const { return count_ == 0; }
    Item take() {
        SINEW_ASSERT(!empty(), "an item waits");
        while (near_.empty()) open_next();
        std::pop_heap(near_.begin(), near_.end(), std::greater<>());
        const Item item = near_.back();
        near_.pop_back();
        --count_;
        return item;
    }

  private:
    static constexpr std::size_t rounds = 1024;

    double per_length_;
    std::uint64_t now_ = 0; ///< the current bucket
    std::size_t count_ = 0;
    std::vector<Item> near_;
    std::vector<std::vector<Item>> later_;

    std::uint64_t bucket_of(const Item& item) const {
        constexpr double max = 1e15;
        return std::uint64_t(std::min(item.length * per_length_, max));
    }
    /// Makes the next bucket the heap; items of later rounds stay in the bucket.
    void open_next() {
        auto& bucket = later_[++now_ % rounds];
        const auto left =
            std::partition(bucket.begin(), bucket.end(), [&](const Item& item) { return bucket_of(item) != now_; });
        near_.assign(left, bucket.end());
        bucket.erase(left, bucket.end());
        std::make_heap(near_.begin(), near_.end(), std::greater<>());
    }
};

} // namespace sinew
