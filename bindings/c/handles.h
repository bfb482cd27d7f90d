#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

/// Handles of objects behind the C face.
namespace sinew::c {

#if defined(__wasm__)
/// One thread needs no lock, and the library for it has none.
struct Mutex {};
struct Lock {
    explicit Lock(Mutex&) {}
};
#else
using Mutex = std::mutex;
using Lock = std::scoped_lock<std::mutex>;
#endif

/// Objects by handle. A handle is 12 bits of slot and 20 bits of generation; generations start at 1, so no handle is 0.
/// Any bits are safe: an unknown handle finds nothing.
template <class T> class Handles {
  public:
    static constexpr std::uint32_t max = 1u << 12; ///< open objects

    /// Takes the object; 0 if there are too many.
    std::uint32_t add(std::unique_ptr<T> object) {
        const Lock lock(mutex_);
        std::uint32_t slot = 0;
        while (slot < slots_.size() && slots_[slot].object) ++slot;
        if (slot == max) return 0;
        if (slot == slots_.size()) slots_.emplace_back();
        slots_[slot].object = std::move(object);
        return slots_[slot].generation << 12 | slot;
    }

    /// Null for an unknown handle.
    T* find(std::uint32_t handle) {
        const Lock lock(mutex_);
        auto* slot = slot_of(handle);
        return slot ? slot->object.get() : nullptr;
    }

    /// The object, which the table forgets; null for an unknown handle.
    std::unique_ptr<T> remove(std::uint32_t handle) {
        const Lock lock(mutex_);
        auto* slot = slot_of(handle);
        if (!slot) return nullptr;
        slot->generation = slot->generation % ((1u << 20) - 1) + 1;
        return std::move(slot->object);
    }

  private:
    struct Slot {
        std::unique_ptr<T> object;
        std::uint32_t generation = 1;
    };

    Slot* slot_of(std::uint32_t handle) {
        const auto slot = handle % max;
        const bool known = slot < slots_.size() && slots_[slot].object && slots_[slot].generation == handle >> 12;
        return known ? &slots_[slot] : nullptr;
    }

    Mutex mutex_;
    std::vector<Slot> slots_;
};

} // namespace sinew::c
