#pragma once

#include "sinew/assert/assert.h"
#include "sinew/math/limit.h"
#include "sinew/table/id.h"

#include <vector>

/// Constraints of each particle, in the order of addition. By id slots, which do not change when rows move.
namespace sinew {

class ConstraintAdjacency {
  public:
    /// Clears the lists, for a number of particles.
    void reset(std::size_t particles) {
        last_.assign(particles, none);
        all_.clear();
        free_ = none;
        listed_ = true;
    }
    /// Marks the lists as unknown until the next reset().
    void forget() { listed_ = false; }
    bool listed() const { return listed_; }
    void make_room(std::size_t particles) {
        if (last_.size() < particles) last_.resize(particles, none);
    }

    void add(std::uint32_t particle, int kind, std::uint32_t constraint) {
        SINEW_ASSERT(listed_ && particle < last_.size(), "the lists have room for the particle");
        const auto added = take();
        auto& last = last_[particle];
        all_[added] = {packed(kind, constraint), added};
        if (last != none) std::swap(all_[added].next, all_[last].next);
        last = added;
    }

    /// False if the search would take too long.
    bool remove(std::uint32_t particle, int kind, std::uint32_t constraint) {
        constexpr int max = 256;
        SINEW_ASSERT(last_[particle] != none, "the particle's list holds the constraint");
        auto& last = last_[particle];
        auto before = last;
        for (int i = 0; i < max; ++i, before = all_[before].next) {
            const auto at = all_[before].next;
            if (all_[at].constraint != packed(kind, constraint)) continue;
            all_[before].next = all_[at].next;
            if (last == at) last = before == at ? none : before;
            all_[at].next = free_;
            free_ = at;
            return true;
        }
        return false;
    }

    /// Calls visit(kind, slot) for each constraint of a particle.
    template <class Visit> void each(std::uint32_t particle, Visit&& visit) const {
        SINEW_ASSERT(listed_ && particle < last_.size(), "the particle has a list");
        const auto last = last_[particle];
        if (last == none) return;
        auto at = last;
        do {
            at = all_[at].next;
            visit(int(all_[at].constraint >> slot_bits), all_[at].constraint & ((1U << slot_bits) - 1));
        } while (at != last);
    }

  private:
    static constexpr auto none = ~std::uint32_t(0);

    static constexpr int slot_bits = limit::row_bits; ///< the upper bits hold the kind

    struct Bond {
        std::uint32_t constraint = 0;
        std::uint32_t next = none; ///< next entry of the particle, cyclic from last to first; next free entry
    };
    std::vector<Bond> all_;
    std::vector<std::uint32_t> last_; ///< last entry by particle
    std::uint32_t free_ = none;
    bool listed_ = false;

    static std::uint32_t packed(int kind, std::uint32_t constraint) {
        SINEW_ASSERT(constraint < limit::rows, "add_constraint() refuses more");
        return std::uint32_t(kind) << slot_bits | constraint;
    }
    std::uint32_t take() {
        if (free_ == none) {
            all_.emplace_back();
            return std::uint32_t(all_.size() - 1);
        }
        const auto taken = free_;
        free_ = all_[taken].next;
        return taken;
    }
};

} // namespace sinew
