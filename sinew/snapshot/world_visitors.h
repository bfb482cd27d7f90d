#pragma once

#include "sinew/snapshot/world_archive.h"
#include "sinew/world/fields.h"

/// Visitors of THE list of a world's fields that write and read the two parts of a snapshot.
namespace sinew::snapshot {

/// Treatment of lists of which one part is fixed and another moves.
template <class Archive, int D, class Real>
void archive_poses(Archive& at, std::vector<collide::Collider<D, Real>>& colliders) {
    for (auto& collider : colliders) archive_all(at, collider.from, collider.target);
}
template <class Archive> void archive_flags(Archive& at, std::vector<Figure>& figures) {
    for (auto& figure : figures) archive(at, figure.quarantined);
}

/// Colliders without their poses.
template <class Archive, int D, class Real>
void archive_fixed(Archive& at, std::vector<collide::Collider<D, Real>>& colliders) {
    if constexpr (Archive::is_reading) {
        colliders.clear();
        colliders.resize(at.listed(sizeof(collide::Collider<D, Real>)));
    } else {
        at.count(colliders.size());
    }
    for (auto& collider : colliders) archive_but_poses(at, collider);
}
template <class Archive, class T> void archive_fixed(Archive& at, T& value) {
    archive(at, value);
}

/// Writes the fields of both parts, or with `fixed` null of those that move alone.
class FieldWriter {
  public:
    FieldWriter(ByteWriter* fixed, ByteWriter& moving) : fixed_(fixed), moving_(moving) {}

    void enter(std::string_view) {}
    template <class T> void fixed(std::string_view, const T& field) {
        if (fixed_) archive_fixed(*fixed_, const_cast<T&>(field)); // a writer changes nothing
        parts(moving_, const_cast<T&>(field));
    }
    template <class T> void moving(std::string_view, const T& field) { archive(moving_, const_cast<T&>(field)); }
    template <class T> void noted(std::string_view name, const T& field) { moving(name, field); }
    template <class T> void derived(std::string_view, const T&) {}

  private:
    ByteWriter* fixed_;
    ByteWriter& moving_;

    template <class T> static void parts(ByteWriter&, T&) {}
    template <int D, class Real> static void parts(ByteWriter& at, std::vector<collide::Collider<D, Real>>& colliders) {
        archive_poses(at, colliders);
    }
    static void parts(ByteWriter& at, std::vector<Figure>& figures) { archive_flags(at, figures); }
};

/// Reads the same.
class FieldReader {
  public:
    FieldReader(ByteReader* fixed, ByteReader& moving) : fixed_(fixed), moving_(moving) {}

    void enter(std::string_view part) { part_ = part; }
    template <class T> void fixed(std::string_view name, T& field) {
        if (fixed_) {
            fixed_->enter(part_, name);
            archive_fixed(*fixed_, field);
        }
        moving_.enter(part_, name);
        parts(moving_, field);
    }
    template <class T> void moving(std::string_view name, T& field) {
        moving_.enter(part_, name);
        archive(moving_, field);
    }
    template <class T> void noted(std::string_view name, T& field) { moving(name, field); }
    template <class T> void derived(std::string_view, T&) {}

  private:
    ByteReader* fixed_;
    ByteReader& moving_;
    std::string_view part_;

    template <class T> static void parts(ByteReader&, T&) {}
    template <int D, class Real> static void parts(ByteReader& at, std::vector<collide::Collider<D, Real>>& colliders) {
        archive_poses(at, colliders);
    }
    static void parts(ByteReader& at, std::vector<Figure>& figures) { archive_flags(at, figures); }
};

} // namespace sinew::snapshot
