#include "sinew/snapshot/rollback.h"

#include "sinew/math/hash.h"
#include "sinew/snapshot/tail_pack.h"
#include "sinew/snapshot/world_visitors.h"
#include "sinew/world/parameter_hash.h"

#include <limits>

namespace sinew {
namespace {

constexpr auto no_limit = std::numeric_limits<std::uint64_t>::max();

using snapshot::ByteReader, snapshot::ByteWriter, snapshot::Tails, snapshot::numbers_in;

/// Columns of numbers: by their tails where that is shorter.
template <class Archive, class Real, class T>
void archive_numbers(Archive& at, std::vector<T>& rows, std::type_identity<Real>) {
    constexpr std::size_t stride = sizeof(T) / sizeof(Real);
    if constexpr (Archive::is_reading) {
        const auto size = std::size_t(at.count());
        if (size == 0) return snapshot::archive(at, rows);
        rows.resize(size);
        Tails<Real>::read(at, numbers_in(rows), stride);
    } else {
        const auto begin = at.size();
        const bool are_equal = snapshot::is_worth_runs(std::span<const T>(rows), false);
        at.count(are_equal ? 0 : rows.size());
        if (!are_equal && !rows.empty() && Tails<Real>::write(at, numbers_in(rows), stride)) return;
        at.shrink(begin);
        at.count(0);
        snapshot::archive(at, rows);
    }
}

/// Fields of a moment. The hash of the parameters covers the mobility, which so is a fixed one; positions, and those
/// before the last step, are kept apart.
template <class Fields, class Archive, int D, class Real> class MomentVisitor {
  public:
    using Own = std::conditional_t<Archive::is_reading, Particles<D, Real>, const Particles<D, Real>>;
    MomentVisitor(Own& particles, Archive* fixed, Archive& moving)
        : p_(particles), fixed_(fixed), moving_(moving), fields_(fixed, moving) {}

    void enter(std::string_view part) { fields_.enter(part); }
    template <class T> void fixed(std::string_view name, T& field) { fields_.fixed(name, field); }
    template <class T> void moving(std::string_view name, T& field) { fields_.moving(name, field); }
    template <class T> void noted(std::string_view name, T& field) { fields_.noted(name, field); }
    template <class T> void derived(std::string_view, T&) {}
    void moving(std::string_view, const std::vector<Vec<D, Real>>& column) {
        if (&column != &p_.position && &column != &p_.previous) numbers(column);
    }
    void moving(std::string_view, const std::vector<Real>& column) {
        if (&column != &p_.mobility) return numbers(column);
        if (fixed_) snapshot::archive(*fixed_, const_cast<std::vector<Real>&>(column));
    }
    void moving(std::string_view name, std::vector<Vec<D, Real>>& column) { moving(name, std::as_const(column)); }
    void moving(std::string_view name, std::vector<Real>& column) { moving(name, std::as_const(column)); }

  private:
    Own& p_;
    Archive* fixed_;
    Archive& moving_;
    Fields fields_;

    /// A writer changes nothing, and a reader was given a world to change.
    template <class T> void numbers(const std::vector<T>& column) {
        archive_numbers(moving_, const_cast<std::vector<T>&>(column), std::type_identity<Real>());
    }
};
template <int D, class Real> using MomentWriter = MomentVisitor<snapshot::FieldWriter, ByteWriter, D, Real>;
template <int D, class Real> using MomentReader = MomentVisitor<snapshot::FieldReader, ByteReader, D, Real>;

template <class T> bool are_same_rows(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}
template <int D, class Real> void pack(std::vector<std::byte>& bytes, const std::vector<Vec<D, Real>>& column) {
    bytes.clear(); // the memory stays
    ByteWriter writer(bytes, false);
    archive_numbers(writer, const_cast<std::vector<Vec<D, Real>>&>(column), std::type_identity<Real>());
}
template <int D, class Real> void unpack(std::span<const std::byte> bytes, std::vector<Vec<D, Real>>& column) {
    ByteReader reader(bytes, 0, no_limit);
    archive_numbers(reader, column, std::type_identity<Real>());
}

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

/// Hash of the parameters, and of the columns that wheels have, which are none: brakes change them from step to step.
template <int D, class Real> std::uint64_t Rollback<D, Real>::parameters_of(const World<D, Real>& world) {
    Hash hash;
    hash.add(parameter_hash(world));
    const auto add = [&](const auto& column) {
        if (column.size() > 0) hash.add(std::as_bytes(std::span(&column[0], 1)));
        hash.add(std::as_bytes(column.each()));
    };
    add(world.particles.rolls);
    add(world.particles.inertia);
    return hash.value();
}

template <int D, class Real> std::size_t Rollback<D, Real>::bytes() const {
    if (size_ == 0) return 0;
    const auto& [fixed, position, previous, moving] = at(0);
    const bool is_shared = size_ > 1 && previous == at(1).position; // with the moment before
    return moving.size() + position->size() + (is_shared ? 0 : previous->size());
}

/// `before`: positions of the latest moment. Takes a buffer of the moment that is overwritten, where no other shares
/// it.
template <int D, class Real>
void Rollback<D, Real>::keep_positions(const World<D, Real>& world, const std::shared_ptr<Bytes>& before,
                                       Moment& moment) {
    auto buffer = std::move(moment.previous);
    if (!buffer || buffer.use_count() > 1) buffer = std::make_shared<Bytes>();
    const auto &previous = world.particles.previous, &position = world.particles.position;
    if (before && are_same_rows(positions_, previous)) {
        moment.previous = before;
    } else {
        pack(*buffer, previous);
        moment.previous = std::exchange(buffer, std::make_shared<Bytes>());
    }
    pack(*buffer, position);
    moment.position = std::move(buffer);
    positions_ = position;
}

template <int D, class Real> void Rollback<D, Real>::keep(const World<D, Real>& world) {
    const auto parameters = parameters_of(world);
    auto sizes = sizes_of(world);
    auto fixed = size_ > 0 ? at(0).fixed : nullptr;
    if (!fixed || fixed->parameters != parameters || fixed->sizes != sizes) {
        auto fresh = std::make_shared<Fixed>(Fixed{parameters, std::move(sizes), {}});
        Bytes unused;
        ByteWriter writer(fresh->bytes, false), moving(unused, false);
        visit_fields(world, MomentWriter<D, Real>(world.particles, &writer, moving));
        fixed = std::move(fresh);
    }
    const auto before = size_ > 0 ? at(0).position : nullptr;
    auto& moment = ring_[next_];
    moment.fixed = std::move(fixed);
    moment.moving.clear(); // the memory stays
    ByteWriter writer(moment.moving, false);
    visit_fields(world, MomentWriter<D, Real>(world.particles, nullptr, writer));
    keep_positions(world, before, moment);
    next_ = (next_ + 1) % ring_.size();
    size_ = std::min(size_ + 1, ring_.size());
}

template <int D, class Real> bool Rollback<D, Real>::go_back(World<D, Real>& world, std::size_t moments) {
    if (moments >= size_) return false;
    const auto& moment = at(moments);
    ByteReader moving(moment.moving, 0, no_limit);
    const bool is_same = moment.fixed->parameters == parameters_of(world) && moment.fixed->sizes == sizes_of(world);
    if (is_same) {
        visit_fields(world, MomentReader<D, Real>(world.particles, nullptr, moving));
    } else {
        World<D, Real> fresh;
        ByteReader fixed(moment.fixed->bytes, 0, no_limit);
        visit_fields(fresh, MomentReader<D, Real>(fresh.particles, &fixed, moving));
        world = std::move(fresh);
    }
    unpack(*moment.position, world.particles.position);
    unpack(*moment.previous, world.particles.previous);
    positions_ = world.particles.position;
    world.journal.change_all();
    next_ = (next_ + ring_.size() - moments) % ring_.size();
    size_ -= moments;
    return true;
}

#define SINEW_ROLLBACK(D, Real) template class Rollback<D, Real>;
SINEW_INSTANTIATE(SINEW_ROLLBACK)

} // namespace sinew
