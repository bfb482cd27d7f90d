#include "tests/canvas/pixels.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/cli/command.h"
#include "tests/paths.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

/// Levels: C and C++ that `play` compiles, loads and loads again.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A ball in space, which the code pushes; it counts its steps in the memory of the level.
std::string level(const std::string& push, const std::string& more = {}) {
    return R"(#include <sinew_level.h>
#include <stdio.h>
static sinew_status build(sinew_world world) {
    const sinew_figure_spec ball = {.struct_size = sizeof ball, .prefab = "ball", .velocity = {1, 0, 0}};
    return sinew_world_add_figure(world, &ball, NULL);
}
static sinew_status step(sinew_world world, const sinew_moment* moment) {
    unsigned* count = (unsigned*)moment->memory;
    sinew_particle ball;
    ++*count;
    sinew_status status = sinew_world_find_particle(world, "ball/ball", &ball);
    if (status != SINEW_OK) return status;
    if (sinew_world_step(world, 1) != SINEW_READ_ONLY) return SINEW_BAD_ARGUMENT;
)" + more +
           "\n    const sinew_point force = " + push + R"(;
    return sinew_world_apply_force(world, ball, force);
}
SINEW_LEVEL(.scene = "{\"sinew\": 1, \"world\": {\"gravity\": [0, 0]}}", .build = build, .step = step,
            .memory = sizeof(unsigned))
)";
}

void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}
/// A file that comes later: clocks of file systems tick slowly.
void write_next(const ScratchFolder& folder, const std::string& text) {
    write(folder / "next.c", text);
    fs::last_write_time(folder / "next.c", fs::last_write_time(folder / "next.c") + std::chrono::seconds(1));
}

Outcome play(const ScratchFolder& folder, const std::string& name, const std::string& script) {
    write(folder / "script.txt", script);
    return sinew({"play", name, "--script", "script.txt", "--json"}, {.environment = {}, .folder = folder.path});
}

std::vector<json> lines_of(const std::string& out, const std::string& what) {
    std::vector<json> lines;
    std::istringstream stream(out);
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with('{'))
            if (auto one = json::parse(line); one["what"] == what) lines.push_back(std::move(one));
    return lines;
}

void compile(const ScratchFolder& folder, const std::string& source, const std::string& object) {
    const auto command = "cc -std=c11 -shared -fPIC -I '" + sinew::test::source_dir() + "/bindings/c' -o '" +
                         (folder / object).string() + "' '" + (folder / source).string() + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);
}

/// v = 1 to the right, and upwards by the force: y = F t^2 / 2m, of a ball of 1 kg.
TEST(Level, IsBuiltAndStepped) {
    const ScratchFolder folder;
    write(folder / "fall.c", level("{0, 2, 0}"));
    compile(folder, "fall.c", "fall.so");
    const auto outcome = play(folder, "./fall.so", "1 where ball/ball\n1 end\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto at = lines_of(outcome.out, "where").at(0)["at"];
    EXPECT_NEAR(at[0].get<double>(), 1, 1e-6);
    EXPECT_NEAR(at[1].get<double>(), 1, 0.02);
}

/// The same of source, in C++, and with a key.
TEST(Level, IsCompiledAndTakesKeys) {
    const ScratchFolder folder;
    write(folder / "keys.cpp", level("{10 * moment->along, 10 * moment->jump, 0}"));
    const auto outcome =
        play(folder, "keys.cpp", "0 down left\n0.5 up left\n0.5 down space\n1 where ball/ball\n1 end\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto at = lines_of(outcome.out, "where").at(0)["at"];
    EXPECT_NEAR(at[0].get<double>(), 1 - 1.25 - 2.5, 0.1);
    EXPECT_NEAR(at[1].get<double>(), 1.25, 0.1);
}

/// The old code puts new code in its place after a second. The ball goes on from where it is, and so does the memory.
TEST(Level, MovesOnWhenItIsCompiledAgain) {
    const ScratchFolder folder;
    write_next(folder, level("{0, 0, 0}", R"(if (*count == 120) printf("{\"what\": \"counted\"}\n");)"));
    write(folder / "move.c", level("{0, 2, 0}", R"(if (*count == 60) rename("next.c", "move.c");)"));
    const auto outcome = play(folder, "move.c", "1 where ball/ball\n1.8 where ball/ball\n2.8 where ball/ball\n3 end\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(lines_of(outcome.out, "reloaded").size(), 1U);
    EXPECT_EQ(lines_of(outcome.out, "counted").size(), 1U);
    const auto where = lines_of(outcome.out, "where");
    ASSERT_EQ(where.size(), 3U);
    EXPECT_NEAR(where[2]["at"][0].get<double>(), 2.8, 1e-3);
    const double rise = where[2]["at"][1].get<double>() - where[1]["at"][1].get<double>();
    EXPECT_GT(rise, 2.0); // at the speed of a second and more of the push, not from the start
    EXPECT_LT(rise, 3.2);
}

TEST(Level, GoesOnWithTheOldCodeUntilTheNewOneCompiles) {
    const ScratchFolder folder;
    write_next(folder, "this is not C\n");
    write(folder / "move.c", level("{0, 0, 0}", R"(if (*count == 30) rename("next.c", "move.c");)"));
    const auto outcome = play(folder, "move.c", "2 where ball/ball\n2 end\n");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(has(outcome.err, "move.c: error: it does not compile"));
    EXPECT_TRUE(has(outcome.err, "next.c:1") || has(outcome.err, "move.c:1"));
    EXPECT_NEAR(lines_of(outcome.out, "where").at(0)["at"][0].get<double>(), 2, 1e-3);
}

TEST(Level, TellsItsErrors) {
    const ScratchFolder folder;
    write(folder / "none.c", "int nothing;\n");
    write(folder / "wrong.c", "#include <sinew_level.h>\nSINEW_LEVEL(.abi = 1)\n");
    write(folder / "scene.c",
          "#include <sinew_level.h>\nSINEW_LEVEL(.scene = \"{\\\"sinew\\\": 1, \\\"figs\\\": []}\")\n");
    write(folder / "build.c", R"(#include <sinew_level.h>
static sinew_status build(sinew_world world) {
    const sinew_figure_spec spec = {.struct_size = sizeof spec, .prefab = "roope"};
    return sinew_world_add_figure(world, &spec, NULL);
}
SINEW_LEVEL(.build = build)
)");
    write(folder / "missing.c", "#include <sinew_level.h>\nvoid nowhere(void);\n"
                                "static sinew_status build(sinew_world w) { (void)w; nowhere(); return SINEW_OK; }\n"
                                "SINEW_LEVEL(.build = build)\n");
    write(folder / "empty.so", "");
    const auto error = [&](const std::string& name) {
        const auto outcome = play(folder, name, "0.1 end\n");
        EXPECT_EQ(outcome.code, 1) << name;
        return outcome.err;
    };
    EXPECT_TRUE(has(error("none.c"), "none.c: error: it is no level: it has no function sinew_level_entry"));
    EXPECT_TRUE(has(error("wrong.c"), "compile it again"));
    EXPECT_TRUE(has(error("scene.c"), "figs"));
    EXPECT_TRUE(has(error("build.c"), "roope"));
    EXPECT_TRUE(has(error("missing.c"), "undefined symbol: nowhere"));
    EXPECT_TRUE(has(error("empty.so"), "empty.so: error:"));
    EXPECT_TRUE(has(error("./gone.so"), "No such file"));
    EXPECT_TRUE(has(error("gone.cpp"), "No such file"));
}

/// A failure in a step is told, and the world goes on without the level.
TEST(Level, StopsCodeThatFails) {
    const ScratchFolder folder;
    write(folder / "fail.c", level("{0, 0, 0}", "if (*count == 30) return sinew_world_remove_figure(world, 77);"));
    const auto outcome = play(folder, "fail.c", "2 where ball/ball\n2 end\n");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(has(outcome.err, "fail.c: step: "));
    EXPECT_NEAR(lines_of(outcome.out, "where").at(0)["at"][0].get<double>(), 2, 1e-3);
}

/// So is an exception of code in C++, in a step or while it builds.
TEST(Level, StopsCodeThatThrows) {
    const ScratchFolder folder;
    write(
        folder / "throw.cpp",
        "#include <stdexcept>\n" +
            level("{0, 0, 0}", R"(if (*count == 30) throw std::runtime_error("no more"); if (*count > 30) throw 5;)"));
    const auto outcome = play(folder, "throw.cpp", "2 where ball/ball\n2 end\n");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(has(outcome.err, "throw.cpp: step: it threw: no more")) << outcome.err;
    EXPECT_NEAR(lines_of(outcome.out, "where").at(0)["at"][0].get<double>(), 2, 1e-3);
    write(folder / "number.cpp", R"(#include <sinew_level.h>
static sinew_status build(sinew_world) { throw 5; }
SINEW_LEVEL(.build = build)
)");
    const auto other = play(folder, "number.cpp", "1 end\n");
    EXPECT_EQ(other.code, 1);
    EXPECT_TRUE(has(other.err, "number.cpp: error: build: it threw")) << other.err;
}

TEST(Level, TooMuchMemoryIsRefused) {
    const ScratchFolder folder;
    write(folder / "much.c", "#include <sinew_level.h>\nSINEW_LEVEL(.memory = (size_t)-1)\n");
    EXPECT_TRUE(has(play(folder, "much.c", "1 end\n").err, "much.c: error: its memory is above 1 GiB"));
}

/// A level looks ahead by a copy, which steps without the level.
TEST(Level, ACopyGoesOnWithoutTheCode) {
    const ScratchFolder folder;
    write(folder / "ahead.c", level("{0, 2, 0}", R"(sinew_world copy;
    status = sinew_world_copy(world, &copy);
    if (status == SINEW_OK) status = sinew_world_step(copy, 10);
    if (status == SINEW_OK) status = sinew_world_close(copy);
    if (status != SINEW_OK) return status;)"));
    const auto outcome = play(folder, "ahead.c", "1 where ball/ball\n1 end\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NEAR(lines_of(outcome.out, "where").at(0)["at"][1].get<double>(), 1, 0.02);
}

/// A linker puts a shared object in its place from the beginning to the end, or removes the old one first.
TEST(Level, WaitsForAFileThatIsBeingWritten) {
    const ScratchFolder folder;
    write(folder / "rise.c", level("{0, 2, 0}"));
    compile(folder, "rise.c", "next.so");
    fs::copy_file(folder / "next.so", folder / "half.so");
    fs::resize_file(folder / "half.so", fs::file_size(folder / "half.so") / 2);
    const auto half = play(folder, "./half.so", "1 end\n");
    EXPECT_EQ(half.code, 1);
    EXPECT_TRUE(has(half.err, "half.so: error: it is not whole")) << half.err;
    write(folder / "move.c", level("{0, 0, 0}", R"(if (*count == 30) remove("move.so");
    if (*count == 200) rename("next.so", "move.so");)"));
    compile(folder, "move.c", "move.so");
    const auto outcome = play(folder, "./move.so", "3 where ball/ball\n6 where ball/ball\n6 end\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(lines_of(outcome.out, "reloaded").size(), 1U);
    EXPECT_GT(lines_of(outcome.out, "where").at(1)["at"][1].get<double>(), 1);
}

TEST(Level, IsNamedByACrash) {
    if (sanitized) GTEST_SKIP() << "the sanitizer tells of crashes";
    const ScratchFolder folder;
    write(folder / "crash.c", level("{0, 0, 0}", "if (*count == 30) *(volatile int*)0 = 1;"));
    const auto outcome = play(folder, "crash.c", "1 end\n");
    EXPECT_EQ(outcome.code, -SIGSEGV);
    EXPECT_TRUE(has(outcome.err, "crash.c: error: a crash, in the level or in what it calls")) << outcome.err;
}

/// Going back in time, and again: the memory goes with the world.
TEST(Level, KeepsItsMemoryWithTheWorld) {
    const ScratchFolder folder;
    write(folder / "back.c", level("{*count > 60 ? 1.0 : 0.0, 0, 0}"));
    const auto outcome =
        play(folder, "back.c",
             "2 where ball/ball\n2 go 30\n2.1 key p\n3.1 key p\n3.1 go 120\n3.1 where ball/ball\n3.2 end\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto where = lines_of(outcome.out, "where");
    ASSERT_EQ(where.size(), 2U);
    EXPECT_EQ(where[0]["at"], where[1]["at"]);
}

/// Share of a picture's pixels that are unlike its upper left one.
double drawn_share(const fs::path& path) {
    const PngFile picture(path);
    int drawn = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) drawn += difference(picture.at(x, y), picture.at(0, 0)) > 40;
    return double(drawn) / (picture.width * picture.height);
}

/// The page's example has no view of its own: its rope hangs in the middle of an empty picture.
TEST(Level, IsSeenWithoutAView) {
    const ScratchFolder folder;
    write(folder / "rope.c", R"(#include <sinew_level.h>
static sinew_status build(sinew_world world) {
    const sinew_figure_spec rope = {.struct_size = sizeof rope, .prefab = "rope"};
    return sinew_world_add_figure(world, &rope, NULL);
}
SINEW_LEVEL(.build = build)
)");
    const auto outcome = play(folder, "rope.c", "0 shot first.png\n1 shot later.png\n1 end\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* name : {"first.png", "later.png"}) {
        EXPECT_GT(drawn_share(folder / name), 0.001) << name;
        EXPECT_LT(drawn_share(folder / name), 0.1) << name;
    }
}

/// A scene of the level's figures would be empty: the player says so, and what is written opens.
TEST(Level, SavingSaysWhatIsLeftOut) {
    const ScratchFolder folder;
    write(folder / "ball.c", level("{0, 0, 0}"));
    const auto outcome = play(folder, "ball.c", "1 save mine.json\n1 end\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(lines_of(outcome.out, "saved").at(0)["left_out"], 1);
    EXPECT_EQ(sinew({"check", (folder / "mine.json").string()}).code, 0);
}

/// Members that a level leaves out are no warning, in C++ either.
TEST(Level, CompilesWithoutWarnings) {
    const ScratchFolder folder;
    write(folder / "bare.cpp", R"(#include <sinew_level.h>
static sinew_status build(sinew_world) { return SINEW_OK; }
SINEW_LEVEL(.build = build)
)");
    write(folder / "script.txt", "0.1 end\n");
    const auto outcome = sinew({"play", "bare.cpp", "--script", "script.txt"},
                               {.environment = {{"CXXFLAGS", "-Wall -Wextra -Werror"}}, .folder = folder.path});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST(Level, ExampleIsPlayed) {
    const ScratchFolder folder;
    const auto outcome = play(folder, sinew::test::source_dir() + "/examples/level.c",
                              "0.5 down right\n2 shot level.png\n2.5 up right\n3 where character/feet\n3 end\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto at = lines_of(outcome.out, "where").at(0)["at"];
    EXPECT_GT(at[0].get<double>(), 2); // up the stairs
    EXPECT_GT(at[1].get<double>(), 0.7);
    EXPECT_GT(drawn_share(folder / "level.png"), 0.02); // stairs and ground
    EXPECT_LT(drawn_share(folder / "level.png"), 0.5);
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
