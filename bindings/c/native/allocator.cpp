#include "bindings/c/failure.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

/// Memory of the library from functions of the caller. Global operators new and delete: those of libsinew.so are its
/// own, which nothing outside sees; a program linked with libsinew.a has them in place of the standard library's once
/// it calls sinew_set_allocator.
namespace {

/// Source of memory. Each block knows the one it came from, so that the allocator may be changed at any time.
struct Source {
    sinew_allocate_function allocate = nullptr; ///< null: malloc
    sinew_release_function release = nullptr;
    void* context = nullptr;
};

constexpr std::uint32_t max_sources = 64;
std::array<Source, max_sources> sources;
std::atomic<std::uint32_t> source_count{1}, current{0};

/// In front of each block.
struct Header {
    std::size_t size = 0; ///< with the room in front
    std::uint32_t source = 0;
    std::uint32_t room = 0; ///< from the beginning to the block
};

void* allocate(std::size_t size, std::size_t alignment) noexcept {
    const auto room = alignment > sizeof(Header) ? alignment : sizeof(Header);
    if (size > SIZE_MAX - 2 * room || room > UINT32_MAX) return nullptr;
    const auto number = current.load(std::memory_order_acquire);
    const auto& source = sources[number];
    const auto whole = (size + room + alignment - 1) / alignment * alignment; // as aligned_alloc wants it
    void* const begin =
        source.allocate ? source.allocate(source.context, whole, alignment) : std::aligned_alloc(alignment, whole);
    if (!begin) return nullptr;
    auto* const block = static_cast<std::byte*>(begin) + room;
    new (block - sizeof(Header)) Header{whole, number, std::uint32_t(room)};
    return block;
}

void release(void* block) noexcept {
    if (!block) return;
    const auto header = *reinterpret_cast<const Header*>(static_cast<std::byte*>(block) - sizeof(Header));
    void* const begin = static_cast<std::byte*>(block) - header.room;
    const auto& source = sources[header.source];
    if (source.release)
        source.release(source.context, begin, header.size);
    else
        std::free(begin);
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
    for (;;) {
        if (void* const block = allocate(size, alignment)) return block;
        const auto handler = std::get_new_handler();
        if (!handler) throw std::bad_alloc();
        handler();
    }
}

constexpr std::size_t usual = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

} // namespace

void* operator new(std::size_t size) {
    return allocate_or_throw(size, usual);
}
void* operator new[](std::size_t size) {
    return allocate_or_throw(size, usual);
}
void* operator new(std::size_t size, std::align_val_t to) {
    return allocate_or_throw(size, std::size_t(to));
}
void* operator new[](std::size_t size, std::align_val_t to) {
    return allocate_or_throw(size, std::size_t(to));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size, usual);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size, usual);
}
void* operator new(std::size_t size, std::align_val_t to, const std::nothrow_t&) noexcept {
    return allocate(size, std::size_t(to));
}
void* operator new[](std::size_t size, std::align_val_t to, const std::nothrow_t&) noexcept {
    return allocate(size, std::size_t(to));
}
void operator delete(void* block) noexcept {
    release(block);
}
void operator delete[](void* block) noexcept {
    release(block);
}
void operator delete(void* block, std::size_t) noexcept {
    release(block);
}
void operator delete[](void* block, std::size_t) noexcept {
    release(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
    release(block);
}
void operator delete[](void* block, std::align_val_t) noexcept {
    release(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
    release(block);
}
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept {
    release(block);
}
void operator delete(void* block, const std::nothrow_t&) noexcept {
    release(block);
}
void operator delete[](void* block, const std::nothrow_t&) noexcept {
    release(block);
}
void operator delete(void* block, std::align_val_t, const std::nothrow_t&) noexcept {
    release(block);
}
void operator delete[](void* block, std::align_val_t, const std::nothrow_t&) noexcept {
    release(block);
}

extern "C" sinew_status sinew_set_allocator(sinew_allocate_function allocate, sinew_release_function release,
                                            void* context) {
    if (!allocate != !release)
        return sinew::c::fail(SINEW_BAD_ARGUMENT, "an allocator allocates and releases: one function is null");
    if (!allocate) {
        current = 0;
        return SINEW_OK;
    }
    for (std::uint32_t i = 1; i < source_count; ++i)
        if (sources[i].allocate == allocate && sources[i].release == release && sources[i].context == context) {
            current = i;
            return SINEW_OK;
        }
    if (source_count == max_sources) return sinew::c::fail(SINEW_FULL, "63 allocators have been set already");
    sources[source_count] = {allocate, release, context};
    current.store(source_count++, std::memory_order_release);
    return SINEW_OK;
}
