#include "tests/cli/command.h"
#include "tests/paths.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

/// `run --save`, `record`, `replay` and `diff`.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

using nlohmann::json;

std::string scratch(const std::string& name) {
    return (std::filesystem::path(testing::TempDir()) / ("sinew_snapshot_" + name)).string();
}

std::string ragdoll() {
    return std::string(test::scenes_dir()) + "/ragdoll.json";
}

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}
void write(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

std::string hash_of(const Arguments& arguments) {
    auto all = arguments;
    all.push_back("--json");
    const auto outcome = sinew(all);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.code == 0 ? json::parse(outcome.last_line())["hash"].get<std::string>() : "";
}

TEST(SavedRun, GoesOnAsIfItHadNeverStopped) {
    const auto path = scratch("at.sinew");
    const auto whole = hash_of({"run", ragdoll(), "--seconds", "2"});
    ASSERT_EQ(sinew({"run", ragdoll(), "--save", path, "--at", "0.7"}).code, 0);
    EXPECT_EQ(hash_of({"run", path, "--seconds", "2"}), whole);
    EXPECT_EQ(hash_of({"run", ragdoll(), "--save", path, "--at", "1", "--seconds", "2"}), whole);
    EXPECT_EQ(hash_of({"run", path, "--seconds", "2", "--threads", "3"}), whole);
    const auto twice = scratch("twice.sinew");
    ASSERT_EQ(sinew({"run", path, "--save", twice, "--at", "1.5"}).code, 0);
    EXPECT_EQ(hash_of({"run", twice, "--seconds", "2"}), whole);
}

/// A time that has passed: what would be saved or shown is of another.
TEST(SavedRun, DoesNotGoBackInTime) {
    const auto path = scratch("passed.sinew"), other = scratch("passed_other.sinew");
    std::filesystem::remove(other);
    ASSERT_EQ(sinew({"run", ragdoll(), "--save", path, "--at", "0.7"}).code, 0);
    for (const Arguments& arguments : {Arguments{"run", path, "--save", other, "--at", "0.5"},
                                       {"run", path, "--seconds", "0.5"},
                                       {"record", path, "-o", other, "--seconds", "0.5"}}) {
        const auto outcome = sinew(arguments);
        EXPECT_EQ(outcome.code, 2);
        EXPECT_TRUE(has(outcome.err, "0.5 has passed: the scene stands at 0.7 s")) << outcome.err;
        EXPECT_TRUE(has(outcome.err, " 1.2 goes on for 0.5 s")) << outcome.err;
    }
    EXPECT_FALSE(std::filesystem::exists(other));
    EXPECT_EQ(sinew({"run", path, "--seconds", "0.7"}).code, 0) << "now is no time that has passed";
}

TEST(SavedRun, ThatIsDamagedIsRefusedWithThePlace) {
    const auto path = scratch("damaged.sinew");
    ASSERT_EQ(sinew({"run", ragdoll(), "--save", path, "--at", "0.5"}).code, 0);
    const auto whole = bytes_of(path);
    for (const auto& [bytes, words] :
         {std::pair{whole.substr(0, whole.size() / 2), "ends within"},
          std::pair{whole.substr(0, whole.size() - 9) + std::string(9, 'x'), "damaged: the checksum"}}) {
        write(path, bytes);
        const auto outcome = sinew({"run", path});
        EXPECT_EQ(outcome.code, 1);
        EXPECT_TRUE(has(outcome.err, words));
        EXPECT_TRUE(has(outcome.err, path));
    }
    write(path, whole);
    EXPECT_EQ(sinew({"run", path, "solver.substeps=3"}).code, 2);
    EXPECT_EQ(sinew({"run", ragdoll(), "--at", "1"}).code, 2);
    EXPECT_EQ(sinew({"run", ragdoll(), "--save", path + "/at.sinew", "--at", "0.1"}).code, 1) << "a file, no folder";
}

TEST(Recordings, AreReplayedAndTellWhereTheyPart) {
    const auto path = scratch("run.rec");
    ASSERT_EQ(sinew({"record", ragdoll(), "-o", path, "--seconds", "1"}).code, 0);
    const auto same = sinew({"replay", path, "--json"});
    ASSERT_EQ(same.code, 0) << same.err;
    EXPECT_TRUE(json::parse(same.last_line())["same"].get<bool>());
    EXPECT_EQ(json::parse(same.last_line())["hash"], hash_of({"run", ragdoll(), "--seconds", "1"}));
    const auto whole = bytes_of(path);
    write(path, whole.substr(0, whole.size() - 3));
    const auto early = sinew({"replay", path});
    EXPECT_EQ(early.code, 0);
    EXPECT_TRUE(has(early.err, "ends within an entry"));
    auto flipped = whole;
    flipped[flipped.size() / 2] ^= 1;
    write(path, flipped);
    const auto refused = sinew({"replay", path});
    EXPECT_EQ(refused.code, 1);
    EXPECT_TRUE(has(refused.err, "damaged"));
    EXPECT_EQ(sinew({"record", ragdoll()}).code, 2) << "where to?";
}

TEST(Recordings, SpareWhatTheyAreMadeOfAndWhatIsNoFile) {
    const auto path = scratch("own.sinew"), scene = scratch("own.json");
    ASSERT_EQ(sinew({"run", ragdoll(), "--save", path, "--at", "0.2"}).code, 0);
    std::filesystem::copy_file(ragdoll(), scene, std::filesystem::copy_options::overwrite_existing);
    for (const auto& own : {path, scene}) {
        const auto before = bytes_of(own);
        const auto outcome = sinew({"record", own, "-o", own});
        EXPECT_EQ(outcome.code, 1);
        EXPECT_TRUE(has(outcome.err, own + ": error: this is the file that is recorded")) << outcome.err;
        EXPECT_EQ(bytes_of(own), before);
    }
    const auto device = sinew({"record", ragdoll(), "-o", "/dev/null", "--seconds", "0.1"});
    EXPECT_EQ(device.code, 1);
    EXPECT_TRUE(has(device.err, "cannot write /dev/null: it is not a regular file")) << device.err;
    const std::filesystem::path folder = scratch("pipes");
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    for (const Arguments& arguments :
         {Arguments{"record", ragdoll(), "-o", "-"}, {"run", ragdoll(), "--seconds", "0.1", "--save", "-"}}) {
        const auto outcome = sinew(arguments, {.folder = folder});
        EXPECT_EQ(outcome.code, 2);
        EXPECT_TRUE(has(outcome.err, "in a file, not in a pipe")) << outcome.err;
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

/// Process ids end at 2^22, so that nobody has this one.
TEST(Recordings, SweepUpWhatKilledRunsHaveLeft) {
    const std::filesystem::path folder = scratch("swept");
    std::filesystem::create_directories(folder);
    const auto left = folder / ".film.partial-999999999.mp4";
    write(left.string(), "half a film");
    EXPECT_EQ(sinew({"record", ragdoll(), "-o", (folder / "run.rec").string(), "--seconds", "0.1"}).code, 0);
    EXPECT_FALSE(std::filesystem::exists(left));
}

TEST(WrittenFiles, GetTheFoldersOnTheirWay) {
    const std::filesystem::path folder = scratch("new_folder");
    const auto at = [&](const char* name) { return (folder / name / name).string(); };
    std::filesystem::remove_all(folder);
    EXPECT_EQ(sinew({"run", ragdoll(), "--seconds", "0.1", "--save", at("saved"), "--trace", at("trace")}).code, 0);
    EXPECT_EQ(sinew({"record", ragdoll(), "--seconds", "0.1", "-o", at("record")}).code, 0);
    EXPECT_EQ(sinew({"export", ragdoll(), "-o", at("export") + ".svg", "--seconds", "0.1"}).code, 0);
    EXPECT_EQ(sinew({"render", ragdoll(), "-o", at("render") + ".png", "--at", "0.1"}).code, 0);
    for (const char* name : {"saved", "trace", "record", "export", "render"})
        EXPECT_FALSE(std::filesystem::is_empty(folder / name)) << name;
    std::filesystem::remove_all(folder);
}

TEST(Recordings, OfAKilledProgramAreWholeUpToThere) {
    const auto path = scratch("killed.rec");
    std::filesystem::remove(path);
    {
        Running running({"record", ragdoll(), "-o", path, "--seconds", "100000"}, {});
        const auto is_under_way = [&] {
            return std::filesystem::exists(path) && std::filesystem::file_size(path) >= 5000;
        };
        for (int tries = 0; tries < 2000 && !is_under_way(); ++tries)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        EXPECT_TRUE(is_under_way());
        running.kill();
        running.wait();
    }
    const auto outcome = sinew({"replay", path, "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_GT(json::parse(outcome.last_line())["steps"].get<int>(), 100);
}

TEST(Diff, TellsTheFirstStepAndField) {
    const auto one = scratch("one.json"), other = scratch("other.json");
    const auto scene = [](const char* speed) {
        return std::string(R"({"sinew": 1, "figures": [{"name": "f", "particles": {"a": {"at": [0, 1]}, "b": {"at":
            [5, 5], "velocity": [)") +
               speed + R"(, 0]}}}]})";
    };
    write(one, scene("3"));
    write(other, scene("3.5"));
    EXPECT_EQ(sinew({"diff", one, one, "--seconds", "0.5"}).code, 0);
    const auto outcome = sinew({"diff", one, other, "--json"});
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    const auto found = json::parse(outcome.last_line());
    EXPECT_EQ(found["step"], 0);
    EXPECT_EQ(found["row"], 1);
    EXPECT_EQ(found["particle"], "f/b");
    const auto picture = scratch("parted.png");
    EXPECT_EQ(sinew({"diff", one, other, "-o", picture, "--later", "0.1"}).code, 1);
    EXPECT_EQ(bytes_of(picture).substr(1, 3), "PNG");
    EXPECT_EQ(sinew({"diff", one}).code, 2);
    for (const std::string ending : {".csv", ".jsonl"}) {
        const auto here = scratch("here" + ending), there = scratch("there" + ending);
        sinew({"run", one, "--trace", here, "--seconds", "0.1"});
        sinew({"run", other, "--trace", there, "--seconds", "0.1"});
        EXPECT_EQ(sinew({"diff", here, here}).code, 0);
        const auto parted = sinew({"diff", here, there, "--json"});
        EXPECT_EQ(parted.code, 1) << parted.err;
        EXPECT_EQ(json::parse(parted.last_line())["row"], "at 0 (f/b)");
    }
}

/// Traces of which one lacks rows or columns.
TEST(Diff, TellsWhichTraceLacksARowOrColumn) {
    const auto one = scratch("one.csv"), other = scratch("lacking.csv");
    const std::string heading = "time,name,x,y\n", row = "0,f/a,1,2\n", next = "1,f/a,1,2\n";
    const auto diff = [&](const std::string& first, const std::string& second) {
        write(one, first);
        write(other, second);
        const auto outcome = sinew({"diff", one, other, "--json"});
        EXPECT_EQ(outcome.code, 1) << first << second << outcome.err;
        return outcome.code == 1 ? json::parse(outcome.last_line()) : json();
    };
    const auto shorter = diff(heading + row + next, heading + row);
    EXPECT_EQ(shorter["line"], 3);
    EXPECT_EQ(shorter["row"], "at 1 (f/a)");
    EXPECT_EQ(shorter["second"], "missing");
    EXPECT_EQ(diff(heading, heading + row)["first"], "missing");
    const std::string narrow = "time,name,x\n";
    EXPECT_EQ(diff(narrow, heading)["field"], "y");
    EXPECT_EQ(diff(heading + row, narrow + "0,f/a,1\n")["second"], "missing");
    EXPECT_EQ(diff(narrow + "0,f/a,1\n", heading + row)["first"], "missing");
    const auto lines = scratch("lines.jsonl"), longer = scratch("longer.jsonl");
    write(lines, R"({"time":0,"name":"f/a","position":[1,2]})"
                 "\n");
    write(longer, R"({"time":0,"name":"f/a","position":[1,2,3]})"
                  "\n");
    EXPECT_EQ(sinew({"diff", lines, longer}).code, 1);
    EXPECT_EQ(sinew({"diff", longer, lines}).code, 1);
    EXPECT_EQ(sinew({"diff", lines, lines}).code, 0);
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
