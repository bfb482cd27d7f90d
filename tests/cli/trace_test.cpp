#include "tests/cli/command.h"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

/// Traces and pointer files of `run`.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

using nlohmann::json;

std::filesystem::path scratch(const std::string& name) {
    return std::filesystem::path(testing::TempDir()) / ("sinew_trace_" + name);
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::vector<std::string> lines_in(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return lines_of(text.str());
}

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path) << text;
}

/// A point on which nothing acts: x = 3 t.
const std::string drifting = R"({"sinew": 1, "figures": [{"name": "f", "particles": {
    "a": {"at": [0, 1], "velocity": [3, 0]}, "b": {"at": [5, 5]}}}]})";

/// Pixels and frames: what the pointer presses on is set on it, for nothing else acts in classic mode.
const std::string pixels = R"({"sinew": 1, "units": {"length": "px", "time": "frame", "up": "-y"},
    "view": {"size": [640, 480]}, "solver": {"mode": "classic"}, "world": {"damping": 0}, "figures": [{"name": "f",
    "particles": {"a": {"at": [100, 100]}, "b": {"at": [400, 100]}}}]})";

TEST(Trace, IsATableOfEachParticleInEachFrame) {
    const auto path = scratch("table.csv");
    const auto outcome = sinew({"run", "-", "--seconds", "0.1", "--trace", path.string()}, {.input = drifting});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto lines = lines_in(path);
    ASSERT_EQ(lines.size(), 1 + 2 * 7u) << "a heading, and the start and six steps of two particles";
    EXPECT_EQ(lines[0], "time,name,x,y,vx,vy");
    EXPECT_EQ(lines[1], "0,f/a,0,1,3,0");
    EXPECT_EQ(lines[2], "0,f/b,5,5,0,0");
    double time = 0, x = 0;
    ASSERT_EQ(std::sscanf(lines[13].c_str(), "%lf,f/a,%lf,", &time, &x), 2) << lines[13];
    EXPECT_NEAR(time, 0.1, 1e-12);
    EXPECT_NEAR(x, 0.3, 1e-12);
}

TEST(Trace, IsLinesOfJsonInAPipeAndTheRestIsSaidElsewhere) {
    const auto outcome =
        sinew({"run", "-", "--seconds", "0.1", "--trace", "-", "--every", "3", "--of", "f/a"}, {.input = drifting});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto lines = lines_of(outcome.out);
    ASSERT_EQ(lines.size(), 3u) << outcome.out;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto row = json::parse(lines[i]);
        EXPECT_EQ(row["name"], "f/a");
        EXPECT_NEAR(row["time"].get<double>(), 0.05 * double(i), 1e-12);
        EXPECT_NEAR(row["position"][0].get<double>(), 0.15 * double(i), 1e-12);
        EXPECT_NEAR(row["velocity"][0].get<double>(), 3, 1e-9);
    }
    EXPECT_TRUE(has(outcome.err, "hash"));
}

TEST(Trace, TakesFiguresAndStemsAndSaysWhatItDoesNotKnow) {
    const auto all = sinew({"run", "-", "--seconds", "0", "--trace", "-", "--of", "f"}, {.input = drifting});
    EXPECT_EQ(lines_of(all.out).size(), 2u) << all.err;
    const auto unknown = sinew({"run", "-", "--trace", "-", "--of", "f/a,f/c"}, {.input = drifting});
    EXPECT_EQ(unknown.code, 1);
    EXPECT_TRUE(has(unknown.err, "no particle or figure called \"f/c\"")) << unknown.err;
    EXPECT_TRUE(has(unknown.err, "f/a")) << unknown.err;
    EXPECT_EQ(sinew({"run", "pendulum", "--every", "2"}).code, 2) << "of no trace";
    EXPECT_EQ(sinew({"run", "pendulum", "--trace", "/dev/null/a.csv"}).code, 1);
    EXPECT_EQ(sinew({"run", "pendulum", "--seconds", "1", "--trace", "-"}, {.output = "/dev/full"}).code, 1);
}

TEST(Trace, WithAWrongNameLeavesAnOlderFileAsItWas) {
    const auto path = scratch("older.csv");
    write(path, "older\n");
    EXPECT_EQ(sinew({"run", "-", "--trace", path.string(), "--of", "nobody"}, {.input = drifting}).code, 1);
    EXPECT_EQ(lines_in(path), std::vector<std::string>{"older"});
}

TEST(Trace, TakesNoEmptyWordsAndNoPartsOfSteps) {
    for (const std::string option : {"--trace", "--of", "--pointer"}) {
        const auto outcome = sinew({"run", "-", option, ""}, {.input = drifting});
        EXPECT_EQ(outcome.code, 2) << option;
        EXPECT_TRUE(has(outcome.err, option + ": expected")) << outcome.err;
    }
    for (const std::string every : {"0", "-3", "1.5", "nan", "1e30", "99999999999999999999"}) {
        const auto outcome = sinew({"run", "-", "--trace", "-", "--every", every}, {.input = drifting});
        EXPECT_EQ(outcome.code, 2) << every;
        EXPECT_TRUE(has(outcome.err, "--every: expected a whole number from 1 to 1e9")) << outcome.err;
    }
}

// Over a at 2, pressed at 4 (a is set on it), straight to 60 px on at 10, and let go.
TEST(Pointer, PressesWhatItIsOverAndCarriesIt) {
    const auto path = scratch("mouse.csv");
    write(path, "\xef\xbb\xbftime, x, y, button\r\n# a press and a drag\n2, 100, 100, 0\n4, 100, 105, 1\n10 160 105 "
                "1\n11, 300, 300, 0\n");
    const auto outcome = sinew(
        {"run", "-", "--seconds", "0.2", "--trace", "-", "--of", "f/a", "--pointer", path.string()}, {.input = pixels});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto lines = lines_of(outcome.out);
    const auto place = [&](std::size_t frame) { return json::parse(lines.at(frame))["position"]; };
    EXPECT_EQ(place(3), json({100.0, 100.0}));
    EXPECT_EQ(place(4), json({100.0, 105.0}));
    EXPECT_NEAR(place(7)[0].get<double>(), 130, 1e-9);
    EXPECT_EQ(place(10), json({160.0, 105.0}));
    EXPECT_EQ(place(12), json({160.0, 105.0})) << "points without inertia stay where they are let go";
}

TEST(Pointer, SaysWhichLineIsWrong) {
    for (const auto& [text, said] : {std::pair{"1, 2, 3, 0\n2, 3, 4\n", ":2: error: \"2, 3, 4\" is not four numbers"},
                                     {"1, 2, 3, 0\n1, 2, 3, 1\n", ":2: error: time 1 is not after 1"},
                                     {"1, 2, 3, 0, 5\n", ":1: error: "},
                                     {"1, nan, 3, 0\n", ":1: error: "},
                                     {"# nothing\n", "no line of a pointer's path"}}) {
        const auto path = scratch("wrong.csv");
        write(path, text);
        const auto outcome = sinew({"run", "-", "--pointer", path.string()}, {.input = pixels});
        EXPECT_EQ(outcome.code, 1) << text;
        EXPECT_TRUE(has(outcome.err, said)) << outcome.err;
    }
    EXPECT_EQ(sinew({"run", "pendulum", "--pointer", "nowhere.csv"}).code, 1);
    const auto folder = sinew({"run", "pendulum", "--pointer", "/"});
    EXPECT_EQ(folder.code, 1);
    EXPECT_TRUE(has(folder.err, "/: error: a folder, not a file")) << folder.err;
}

TEST(Pointer, LeadsWhatIsRendered) {
    const auto path = scratch("mouse2.csv"), picture = scratch("held.png"), other = scratch("free.png");
    write(path, "1, 100, 100, 1\n2, 300, 300, 1\n");
    ASSERT_EQ(
        sinew({"render", "-", "-o", picture.string(), "--at", "0.1", "--pointer", path.string()}, {.input = pixels})
            .code,
        0);
    ASSERT_EQ(sinew({"render", "-", "-o", other.string(), "--at", "0.1"}, {.input = pixels}).code, 0);
    EXPECT_NE(lines_in(picture), lines_in(other));
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
