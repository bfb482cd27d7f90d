#include "tests/cli/command.h"
#include "tests/paths.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

/// Every file in tests/hostile is refused, with a message that names it, in under a second of the processor and 200 MB.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> corpus() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(test::source_dir() + "/tests/hostile"))
        names.push_back(entry.path().stem());
    std::ranges::sort(names);
    return names;
}

class HostileScene : public testing::TestWithParam<std::string> {};

TEST_P(HostileScene, IsRefusedByEveryCommand) {
    const auto file = GetParam() + ".json";
    for (const auto* command : {"check", "run", "info", "render"}) {
        const auto outcome =
            sinew({command, file}, {.folder = test::source_dir() + "/tests/hostile", .max_memory = 200'000'000});
        EXPECT_EQ(outcome.code, 1) << command;
        EXPECT_TRUE(begins(outcome.err, file + ":"));
        EXPECT_TRUE(has(outcome.err, ": error: "));
        EXPECT_FALSE(has(outcome.err, "out of memory"));
        EXPECT_FALSE(has(outcome.err, "\033"));
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(sanitized || outcome.seconds < 1) << outcome.seconds;
    }
}

INSTANTIATE_TEST_SUITE_P(Corpus, HostileScene, testing::ValuesIn(corpus()),
                         [](const auto& file) { return file.param; });

TEST(Memory, WhereItIsShortIsSaid) {
    if (sanitized) GTEST_SKIP() << "sanitizers need more memory than the limit allows";
    const auto outcome =
        sinew({"run", "-"}, {.input = R"({"sinew": 1, "figures": [{"prefab": "rope", "segments": 900000}]})",
                             .max_memory = 100'000'000});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.err, "sinew: error: out of memory\n");
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
