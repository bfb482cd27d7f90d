#include "tests/cli/command.h"

#include <nlohmann/json.hpp>
#include <sstream>

/// What `sinew bench rope` claims of ropes, bridges and ragdolls, at its default settings.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

using nlohmann::json;

std::vector<json> lines_of(const Arguments& arguments) {
    const auto outcome = sinew(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::vector<json> lines;
    std::istringstream text(outcome.out);
    for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
    return lines;
}

TEST(BenchRope, NothingStretchesBendsTooFarOrGains) {
    const std::string seconds = sanitized ? "0.1" : "2";
    for (const std::string name : {"pinned", "tree", "necklace", "bridge", "ragdoll"}) {
        const auto lines = lines_of({"bench", "rope", name, "--seconds", seconds, "--json"});
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_EQ(lines[0]["case"], name);
        EXPECT_LT(lines[0]["stretch_max"], 1e-3) << name;
        EXPECT_LT(lines[0]["energy_gain"], 1e-4) << name;
        EXPECT_LT(lines[0]["outside_limits"], 1) << name << ", degrees";
    }
}

TEST(BenchRope, TakesAnyLinksWeightAndStart) {
    const auto lines = lines_of({"bench", "rope", "--links", "30", "--weight", "5000", "--start", "level", "--seconds",
                                 sanitized ? "0.1" : "1", "--threads", "2", "--json"});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0]["links"], 30);
    EXPECT_EQ(lines[0]["weight"], 5000);
    EXPECT_EQ(lines[0]["start"], "level");
    EXPECT_EQ(lines[0]["threads"], 2);
    EXPECT_LT(lines[0]["stretch_max"], 1e-3);
    EXPECT_LT(lines[0]["energy_gain"], 1e-4);
}

// A slack rope falls and snaps taut.
TEST(Run, TellsTheEnergyThatBlowsTook) {
    const auto outcome = sinew({"run", "-", "--seconds", sanitized ? "1.5" : "2", "--json"}, {.input = R"({
        "sinew": 1, "world": {"gravity": [0, -9.81]},
        "figures": [{"prefab": "rope", "length": 2, "segments": 8, "angle": 150}]})"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_GT(json::parse(outcome.last_line())["energy_lost"], 0);
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
