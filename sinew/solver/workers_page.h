#pragma once

/// Threads of WebAssembly: a page starts workers on the engine's memory, and each serves until the page ends it.
namespace sinew {

/// Takes part in every shared work as thread `number`, from 1. Never returns.
[[noreturn]] void serve_page(int number);

} // namespace sinew
