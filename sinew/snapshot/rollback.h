#pragma once

#include "sinew/world/world.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

/// The last moments of a world, to go back to: for games over a network, which step on a guess and correct it.
namespace sinew {

/// A ring of moments. Fixed fields are held once for all of them; a moment takes those that move, and its `previous`
/// positions are those of the moment before, where the world has been kept before each step. For a world of one
/// process: snapshot.h writes bytes that others may read.
template <int D, class Real> class Rollback {
  public:
    /// `moments`: number of moments held, at least 1.
    explicit Rollback(std::size_t moments) : ring_(moments > 0 ? moments : 1) {}

    /// Keeps the world as it is: before each step.
    void keep(const World<D, Real>& world);
    /// Puts the world back by so many moments: 0 is the latest kept. False, and nothing changes, if none is so old.
    /// Later moments are forgotten.
    bool go_back(World<D, Real>& world, std::size_t moments);

    /// Number of moments to go back to.
    std::size_t size() const { return size_; }
    /// Bytes of the latest moment, without those that it shares with the one before.
    std::size_t bytes() const;

  private:
    using Bytes = std::vector<std::byte>;

    /// Fixed fields, and how to know that they have not changed.
    struct Fixed {
        std::uint64_t parameters = 0;
        std::vector<std::size_t> sizes;
        Bytes bytes;
    };
    struct Moment {
        std::shared_ptr<const Fixed> fixed;
        std::shared_ptr<Bytes> position, previous;
        Bytes moving;
    };
    std::vector<Moment> ring_;
    std::size_t next_ = 0, size_ = 0;
    std::vector<Vec<D, Real>> positions_; ///< of the latest moment

    const Moment& at(std::size_t back) const { return ring_[(next_ + ring_.size() - 1 - back) % ring_.size()]; }
    static std::vector<std::size_t> sizes_of(const World<D, Real>& world);
    static std::uint64_t parameters_of(const World<D, Real>& world);
    void keep_positions(const World<D, Real>& world, const std::shared_ptr<Bytes>& before, Moment& moment);
};

} // namespace sinew
