#include "canvas/progress.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>
#include <pty.h>
#include <string>
#include <thread>
#include <unistd.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

using canvas::Progress;

/// What was written to a terminal that has been closed: it comes in pieces.
std::string all_from(int descriptor) {
    std::string text, piece(4096, '\0');
    for (ssize_t got = 0; (got = read(descriptor, piece.data(), piece.size())) > 0;)
        text.append(piece, 0, std::size_t(got));
    return text;
}

/// What a terminal of some width shows.
std::string on_terminal(unsigned short columns, const std::function<void(std::FILE*)>& work) {
    int screen = -1, terminal = -1;
    winsize size{24, columns, 0, 0};
    if (openpty(&screen, &terminal, nullptr, nullptr, &size) != 0) return "no terminal";
    std::FILE* stream = fdopen(terminal, "w");
    work(stream);
    std::fclose(stream);
    const std::string text = all_from(screen);
    close(screen);
    return text;
}

TEST(Progress, ShowsLabelBarAndPercentAndWipesThemAtTheEnd) {
    const std::string text = on_terminal(100, [](std::FILE* stream) {
        Progress progress("ragdoll.mp4", 4, stream);
        progress.update(1);
    });
    EXPECT_TRUE(text.starts_with("\rragdoll.mp4  [##########------------------------------]   25 %  0:0")) << text;
    EXPECT_TRUE(text.ends_with("\r\033[K")) << text;
}

TEST(Progress, TakesTheTimeLeftFromTheTimePassed) {
    const std::string text = on_terminal(100, [](std::FILE* stream) {
        Progress progress("x", 100, stream);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        progress.update(1);
    });
    int minutes = 0, seconds = 0;
    ASSERT_EQ(std::sscanf(text.c_str() + text.find('%'), "%% %d:%d left", &minutes, &seconds), 2) << text;
    EXPECT_GE(60 * minutes + seconds, 5) << "99 times the 50 ms that the first hundredth took";
}

TEST(Progress, NeverWrapsANarrowTerminal) {
    const std::string text = on_terminal(50, [](std::FILE* stream) {
        Progress progress("ragdoll.mp4", 4, stream);
        progress.update(2);
    });
    EXPECT_LE(text.find("\033[K"), 50u) << text;
}

TEST(Progress, RedrawsAtMostTenTimesASecond) {
    const auto begin = std::chrono::steady_clock::now();
    const std::string text = on_terminal(100, [](std::FILE* stream) {
        Progress progress("x", 1000, stream);
        for (std::size_t i = 0; i < 1000; ++i) progress.update(i);
    });
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    EXPECT_LE(double(std::ranges::count(text, '\r')), 10 * elapsed.count() + 2) << "one at once, and one wipes";
}

TEST(Progress, IsSilentInAPipe) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    std::FILE* stream = fdopen(ends[1], "w");
    {
        Progress progress("x", 10, stream);
        progress.update(5);
    }
    std::fclose(stream);
    EXPECT_EQ(all_from(ends[0]), "");
    close(ends[0]);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
