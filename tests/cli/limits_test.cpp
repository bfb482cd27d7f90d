#include "tests/canvas/scratch_folder.h"
#include "tests/cli/command.h"
#include "tests/sanitized.h"

#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

/// Limits of the whole process: a command that meets one ends with a message and leaves nothing unfinished.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

TEST(Limits, OfSecondsEndsACommandAndLeavesOlderFilesAlone) {
    const ScratchFolder folder;
    const auto trace = folder / "trace.csv";
    std::ofstream(trace) << "older";
    const auto outcome =
        sinew({"run", "pendulum", "--seconds", "1e8", "--max-seconds", "0.2", "--trace", trace.string()});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(has(outcome.err, "error: not done after 0.2 s")) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "--max-seconds S allows more"));
    EXPECT_EQ(text_of(trace), "older");
    EXPECT_EQ(folder.names().size(), 1U);
}

TEST(Limits, OfMemoryEndsACommand) {
    if (sanitized) GTEST_SKIP() << "sanitizers take terabytes";
    const ScratchFolder folder;
    std::ofstream(folder / "large.json")
        << R"({"sinew": 1, "figures": [{"prefab": "cloth", "columns": 600, "rows": 600}]})";
    const auto outcome = sinew({"run", (folder / "large.json").string(), "--seconds", "0", "--max-memory", "64"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(has(outcome.err, "error: more than 64 MB of memory are needed")) << outcome.err;
}

TEST(Limits, ThatAreNotMetChangeNothing) {
    std::vector<std::string> words{"run", "pendulum", "--seconds", "1", "--max-seconds", "60"};
    if (!sanitized) words.insert(words.end(), {"--max-memory", "1000"}); // sanitizers take terabytes
    const auto outcome = sinew(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(sinew({"run", "pendulum", "--max-seconds", "0"}).code, 2);
    EXPECT_EQ(sinew({"run", "pendulum", "--max-memory", "lots"}).code, 2);
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
