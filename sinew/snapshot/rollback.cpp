#include "sinew/snapshot/rollback.h"

#include "sinew/snapshot/world_visitors.h"
#include "sinew/world/parameter_hash.h"

#include <limits>

namespace sinew {
namespace {

constexpr auto no_limit = std::numeric_limits<std::uint64_t>::max();

} // namespace

/// Numbers that change with whatever comes, goes or is renamed.
template <int D, class Real> std::vector<std::size_t> Rollback<D, Real>::sizes_of(const World<D, Real>& world) {
    std::vector<std::size_t> sizes{world.particles.size(),      world.particles.handles.indices(),
                                   world.journal.row_moves,     world.pins.size(),
                                   world.pin_handles.indices(), world.colliders.size(),
                                   world.figures.size(),        world.sweep.size()};
    for_each_table(world, [&](const auto& table) {
        sizes.push_back(table.size());
        sizes.push_back(table.handles.indices());
    });
    for (const auto& figure : world.figures) sizes.push_back(figure.pieces.size() + figure.fragments.size());
    return sizes;
}

template <int D, class Real> void Rollback<D, Real>::keep(const World<D, Real>& world) {
    const auto parameters = parameter_hash(world);
    auto sizes = sizes_of(world);
    auto fixed = size_ > 0 ? at(0).fixed : nullptr;
    if (!fixed || fixed->parameters != parameters || fixed->sizes != sizes) {
        auto fresh = std::make_shared<Fixed>(Fixed{parameters, std::move(sizes), {}});
        std::vector<std::byte> unused;
        snapshot::ByteWriter writer(fresh->bytes, false), moving(unused, false);
        visit_fields(world, snapshot::FieldWriter(&writer, moving));
        fixed = std::move(fresh);
    }
    auto& moment = ring_[next_];
    moment.fixed = std::move(fixed);
    moment.moving.clear(); // the memory stays
    snapshot::ByteWriter writer(moment.moving, false);
    visit_fields(world, snapshot::FieldWriter(nullptr, writer));
    next_ = (next_ + 1) % ring_.size();
    size_ = std::min(size_ + 1, ring_.size());
}

template <int D, class Real> bool Rollback<D, Real>::go_back(World<D, Real>& world, std::size_t moments) {
    if (moments >= size_) return false;
    const auto& moment = at(moments);
    snapshot::ByteReader moving(moment.moving, 0, no_limit);
    const bool is_same = moment.fixed->parameters == parameter_hash(world) && moment.fixed->sizes == sizes_of(world);
    if (is_same) {
        visit_fields(world, snapshot::FieldReader(nullptr, moving));
    } else {
        World<D, Real> fresh;
        snapshot::ByteReader fixed(moment.fixed->bytes, 0, no_limit);
        visit_fields(fresh, snapshot::FieldReader(&fixed, moving));
        world = std::move(fresh);
    }
    world.journal.change_all();
    next_ = (next_ + ring_.size() - moments) % ring_.size();
    size_ -= moments;
    return true;
}

#define SINEW_ROLLBACK(D, Real) template class Rollback<D, Real>;
SINEW_INSTANTIATE(SINEW_ROLLBACK)

} // namespace sinew
