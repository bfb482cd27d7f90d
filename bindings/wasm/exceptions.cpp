// Exceptions of the readers in files/in on a page: Debian's C++ library for WebAssembly has none. The module throws one
// type, ImportError; all else that would be thrown ends the instance, as everywhere in the engine.
//
// clang's scheme for WebAssembly (Itanium C++ ABI, with instructions for throw and catch): `throw` calls __cxa_throw; a
// handler asks _Unwind_CallPersonality which of its types the exception has, and reads the number from
// __wasm_lpad_context.
#include "files/in/import.h"

#include <cstdlib>
#include <typeinfo>

namespace {

/// In front of each thrown object.
struct alignas(16) Header {
    void* (*destroy)(void*); ///< destructors return their object here
    int handlers;
    bool is_thrown_again;
};

Header& header_of(void* thrown) {
    return static_cast<Header*>(thrown)[-1];
}

/// The exception that is handled; its handlers may nest, and others wait for it.
void* handled = nullptr;

[[noreturn]] void raise(void* thrown) {
    constexpr int tag_of_cpp = 0;
    __builtin_wasm_throw(tag_of_cpp, thrown);
}

} // namespace

extern "C" {

/// Place of a handler, its table, and the number of the type that it takes: written here, read by the handler.
struct WasmLandingPad {
    std::uintptr_t number;
    std::uintptr_t table;
    std::uintptr_t selector;
};
thread_local WasmLandingPad __wasm_lpad_context{};

void* __cxa_allocate_exception(std::size_t size) noexcept {
    auto* const memory = static_cast<Header*>(std::malloc(sizeof(Header) + size));
    if (!memory) __builtin_trap();
    *memory = {};
    return memory + 1;
}

void __cxa_free_exception(void* thrown) noexcept {
    std::free(&header_of(thrown));
}

[[noreturn]] void __cxa_throw(void* thrown, std::type_info* type, void* (*destroy)(void*)) {
    if (*type != typeid(sinew::files::ImportError)) __builtin_trap();
    header_of(thrown).destroy = destroy;
    raise(thrown);
}

/// All handlers are of the one type, the first of their table.
int _Unwind_CallPersonality(void*) {
    __wasm_lpad_context.selector = 1;
    return 0;
}

void* __cxa_begin_catch(void* thrown) noexcept {
    auto& header = header_of(thrown);
    header.is_thrown_again = false;
    ++header.handlers;
    return handled = thrown;
}

void __cxa_end_catch() {
    auto& header = header_of(handled);
    if (--header.handlers > 0 || header.is_thrown_again) return;
    if (header.destroy) header.destroy(handled);
    __cxa_free_exception(handled);
}

[[noreturn]] void __cxa_rethrow() {
    header_of(handled).is_thrown_again = true;
    raise(handled);
}

} // extern "C"
