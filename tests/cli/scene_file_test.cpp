#include "tests/canvas/scratch_folder.h"
#include "tests/cli/command.h"
#include "tests/paths.h"

#include <gtest/gtest.h>

/// Where scenes come from.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

namespace fs = std::filesystem;

void expect_refused(const Outcome& outcome, const char* message, const char* help = "") {
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_TRUE(has(outcome.err, message));
    EXPECT_TRUE(has(outcome.err, help));
    EXPECT_EQ(outcome.out, "");
}

TEST(SceneFile, IsAPathOrANameOrStandardInput) {
    const auto path = catalogue() / "pendulum.json";
    const auto by_name = sinew({"run", "pendulum", "--seconds", "1"});
    const auto by_path = sinew({"run", path, "--seconds", "1"});
    const auto by_input = sinew({"run", "-", "--seconds", "1"}, {.input = text_of(path)});
    const auto hash = [](const std::string& text) { return text.substr(text.find("hash"), 40); };
    for (const auto& outcome : {by_name, by_path, by_input}) {
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(hash(outcome.out), hash(by_name.out));
    }
}

TEST(SceneFile, AWordWithEqualsCanBeAPath) {
    const ScratchFolder folder;
    fs::copy_file(catalogue() / "pendulum.json", folder / "a=b.json");
    EXPECT_EQ(sinew({"check", "./a=b.json"}, {.folder = folder.path}).code, 0);
}

TEST(SceneFile, UnknownNamesAreCorrected) {
    expect_refused(sinew({"run", "pendulm"}), "no scene is called \"pendulm\"", "did you mean \"pendulum\"?");
    expect_refused(sinew({"run", "pendulm.json"}), "pendulm.json: error: No such file", "the catalogue has pendulum");
    expect_refused(sinew({"run", "x"}, {.environment = {{"SINEW_SCENES", "/nonexistent"}}}), "no scene is called",
                   "/nonexistent, is empty");
}

TEST(SceneFile, WhatIsNoneIsRefused) {
    expect_refused(sinew({"run", "/"}), "/: error: a folder, not a scene file");
    expect_refused(sinew({"run", "tests"}, {.folder = test::source_dir()}), "tests: error: a folder, not a scene file");
    expect_refused(sinew({"run", "/dev/null"}), "/dev/null:1:1: error: the file is empty");
    expect_refused(sinew({"run", "-"}), "<stdin>:1:1: error: the file is empty");
    expect_refused(sinew({"run", "/dev/zero"}, {.max_memory = 200'000'000}),
                   "/dev/zero: error: more than 16000000 bytes", "limits.bytes=N");
    expect_refused(sinew({"run", "/proc/self/mem"}), "/proc/self/mem: error: ");
}

TEST(SceneFile, LimitsAreRaisedOnTheCommandLine) {
    const auto path = catalogue() / "pendulum.json";
    const std::string padded = text_of(path) + std::string(16'000'000, ' ');
    expect_refused(sinew({"check", "-"}, {.input = padded}), "more than 16000000 bytes", "limits.bytes=N");
    EXPECT_EQ(sinew({"check", "-", "limits.bytes=17000000"}, {.input = padded}).code, 0);
    expect_refused(sinew({"check", path, "limits.bytes=100"}), "more than 100 bytes");
    expect_refused(sinew({"check", path, "limits.particles=1"}), "2 particles, at most 1");
    expect_refused(sinew({"check", path, "limits.bytes=many"}), "<command line>:1:14: error: expected an integer");
}

TEST(SceneFile, TheCatalogueOfTheSourcesIsTheLastResort) {
    const Setting without_variable{.environment = {{"SINEW_SCENES", ""}}};
    EXPECT_TRUE(has(sinew({"list"}, without_variable).out, "ragdoll"));
    EXPECT_TRUE(has(sinew({"--help"}, without_variable).out, test::scenes_dir()));
}

TEST(SceneFile, AnInstalledCommandFindsItsScenes) {
    const ScratchFolder prefix;
    fs::create_directories(prefix / "bin");
    fs::create_directories(prefix / "share/sinew/scenes");
    fs::copy_file(test::command_path(), prefix / "bin/sinew");
    fs::copy_file(catalogue() / "pendulum.json", prefix / "share/sinew/scenes/clockwork.json");
    const Setting installed{.environment = {{"SINEW_SCENES", ""}}, .command = prefix / "bin/sinew"};
    const auto outcome = sinew({"run", "clockwork"}, installed);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_FALSE(has(sinew({"list"}, installed).out, "A ragdoll"));
}

TEST(Overrides, ReachEveryValue) {
    EXPECT_TRUE(has(sinew({"run", "tearing", "mode=classic"}).out, "classic, double"));
    EXPECT_TRUE(has(sinew({"run", "pendulum", "precision=float"}).out, "physical, float"));
    EXPECT_TRUE(has(sinew({"run", "pendulum", "seconds=3"}).out, "3 s in 180 steps"));
    EXPECT_TRUE(has(sinew({"run", "pendulum", "solver.rate=120"}).out, "2 s in 240 steps"));
    EXPECT_TRUE(has(sinew({"info", "tearing", "figures.crate.mass=7"}).out, "7 kg"));
    EXPECT_TRUE(has(sinew({"info", "pendulum", "world.gravity=[0,0]"}).out, "forces       none"));
    EXPECT_TRUE(has(sinew({"info", "tearing", "events=null"}).out, "events       0"));
}

TEST(Overrides, AreCheckedAsTheFileIs) {
    const auto outcome = sinew({"run", "tearing", "solver.substps=4", "figures.crate.witdh=3", "figures.crat.width=3"});
    expect_refused(outcome, "<command line>:1:8: error: unknown property \"substps\" at /solver",
                   "did you mean \"substeps\"?");
    expect_refused(outcome, "unknown property \"witdh\"", "did you mean \"width\"?");
    expect_refused(outcome, "nothing here is called \"crat\"", "did you mean \"crate\"?");
    expect_refused(sinew({"run", "pendulum", "solver.substeps=many"}), "expected an integer from 0 to 1000");
}

// Beside the scene, wherever the command is started.
TEST(SceneFile, NamesImagesFromItsOwnFolder) {
    const ScratchFolder folder;
    fs::create_directories(folder / "scenes/sprites");
    const auto scene = folder / "scenes/a.json";
    std::ofstream(scene) << R"({"sinew": 1, "figures": [{"prefab": "rope"}],
 "looks": {"rope": {"image": {"file": "sprites/a.png"}}}})";
    expect_refused(sinew({"check", scene}), ":2:39: error: cannot read the image \"sprites/a.png\": No such file",
                   "help: looked for");
    ASSERT_EQ(sinew({"render", "pendulum", "-o", folder / "scenes/sprites/a.png", "--size", "16x8"}).code, 0);
    EXPECT_EQ(sinew({"check", scene}).code, 0);
    EXPECT_EQ(sinew({"check", "-"}, {.input = text_of(scene), .folder = folder / "scenes"}).code, 0);
    expect_refused(sinew({"check", scene, "looks.rope.image.file=/etc/passwd"}),
                   "<command line>:1:23: error: \"/etc/passwd\" is not a file in the folder of the scene");
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
