#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

namespace sinew {

/// Generation number unique among the id tables of this process. A copy draws a number on first use: after a table was
/// copied, the two hand out different ids. Numbers wrap after 2^32 draws; a table draws one for each run of additions
/// between two removals or copies.
class Stamp {
  public:
    Stamp() = default;
    Stamp(const Stamp&) {}
    Stamp(Stamp&& other) noexcept : drawn_(std::exchange(other.drawn_, none)) {}
    Stamp& operator=(const Stamp&) {
        forget();
        return *this;
    }
    Stamp& operator=(Stamp&& other) noexcept {
        drawn_ = std::exchange(other.drawn_, none);
        return *this;
    }
    ~Stamp() = default;

    std::uint32_t get() {
        if (drawn_ == none) drawn_ = draw();
        return drawn_;
    }
    /// Makes the next get() draw a new number.
    void forget() { drawn_ = none; }

    static constexpr std::uint32_t none = 0; ///< never drawn

    /// Counts a number as drawn: one that another process drew, and that came with a file.
    static void pass(std::uint32_t number) {
        auto drawn = last().load(std::memory_order_relaxed);
        while (drawn < number && !last().compare_exchange_weak(drawn, number, std::memory_order_relaxed)) {
        }
    }

  private:
    std::uint32_t drawn_ = none;

    static std::atomic<std::uint32_t>& last() {
        static std::atomic<std::uint32_t> number{none};
        return number;
    }
    static std::uint32_t draw() {
        std::uint32_t next = none;
        while (next == none) next = last().fetch_add(1, std::memory_order_relaxed) + 1;
        return next;
    }
};

} // namespace sinew
