#include "sinew/scene/reader.h"

#include "tests/scene/laws.h"
#include "tests/scene/sample.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <string>

namespace sinew::SINEW_TEST_FILE {
namespace {

const Units pixels{.length = "px", .mass = "kg", .time = "frame", .per_metre = 100, .per_second = 60};

template <Record R> struct Result {
    R record;
    Diagnostics diagnostics;
    bool good = false;

    /// First lines of the messages, without the name of the file.
    std::vector<std::string> messages() const {
        std::vector<std::string> lines;
        for (const auto& diagnostic : diagnostics.in_order()) {
            const auto [line, column] = place_of(diagnostics, diagnostic.span);
            lines.push_back(concat(line, ":", column, ": ", diagnostic.message, " at ", diagnostic.path));
        }
        return lines;
    }
    std::string help() const { return diagnostics.in_order().at(0).help; }
};

template <Record R> Result<R> read_as(std::string text, int dimension = 2, const Units& units = {}) {
    Result<R> result;
    const auto source = result.diagnostics.add_source("a.json", std::move(text));
    const auto value = json::parse(source, result.diagnostics);
    EXPECT_TRUE(value) << to_text(result.diagnostics);
    if (value) result.good = read(*value, result.record, Reading{result.diagnostics, dimension, units});
    return result;
}

using Lines = std::vector<std::string>;

// --- what is read -----------------------------------------------------------------------------------------------

TEST(Reader, FillsEveryTypeOfField) {
    auto text = std::string(sample::good_scene);
    text.replace(text.find(",\n  \"modes\""), std::string::npos, "}"); // those are the document's business
    const auto result = read_as<sample::Scene>(text);
    ASSERT_TRUE(result.good) << to_text(result.diagnostics);
    const auto& scene = result.record;
    EXPECT_EQ(scene.version, 1);
    EXPECT_EQ(scene.box[1], (Point{{640, 480}}));
    EXPECT_EQ(scene.size[0], 800);
    EXPECT_EQ(scene.solver.substeps, 16);
    EXPECT_FALSE(scene.solver.tethers);
    EXPECT_EQ(scene.solver.seed, 9007199254740993) << "not representable as a double";
    ASSERT_EQ(scene.figures.size(), 3u);
    EXPECT_EQ(scene.figures[0].name, "bob");
    EXPECT_EQ(std::get<sample::Ragdoll>(*scene.figures[0].prefab).height, 180);
    EXPECT_EQ(std::get<sample::Rope>(*scene.figures[1].prefab).segments, 100);
    EXPECT_EQ(scene.figures[1].mass, 0.5);
    EXPECT_FALSE(scene.figures[2].prefab);
    EXPECT_FALSE(scene.figures[2].mass);
    EXPECT_EQ(std::get<sample::Wind>(scene.forces[1].law).velocity, (Point{{1, 0}}));
    EXPECT_EQ(std::get<sample::Grab>(scene.events[0].action).to, (Point{{500, 100}}));
    EXPECT_EQ(std::get<sample::Release>(scene.events[1].action).release, "bob/hand");
    EXPECT_EQ(scene.masses, (std::vector<std::pair<std::string, double>>{{"head", 4}, {"hand", 2}}));
    EXPECT_EQ(json::to_text(scene.extra), R"({"anything": [true, null, "x", {"y": 1}]})");
}

TEST(Reader, AnglesAreDegreesInTheFile) {
    const auto result = read_as<sample::Ragdoll>(R"({"bend": 90})");
    EXPECT_DOUBLE_EQ(result.record.bend, pi<double> / 2);
    EXPECT_TRUE(read_as<sample::Ragdoll>(R"({"bend": 180})").good) << "the end of the range, in degrees";
    EXPECT_EQ(read_as<sample::Ragdoll>(R"({"bend": 181})").messages(),
              Lines{"1:10: expected a number from 0 to 180 degrees, found the number 181 at /bend"});
}

TEST(Reader, DefaultsAndRangesAreInTheUnitsOfTheScene) {
    const auto result = read_as<sample::Rope>("{}", 2, pixels);
    EXPECT_EQ(result.record.length, 100);
    EXPECT_EQ(read_as<sample::Rope>(R"({"length": 1.9})", 2, pixels).messages(),
              Lines{"1:12: expected a number from 2 to 10000 px, found the number 1.9 at /length"});
    EXPECT_EQ(read_as<sample::Rope>(R"({"length": 2})", 2, pixels).record.length, 2) << "what the file says is kept";
}

TEST(Reader, ThisHoldsForRecordsInsideListsAndVariants) {
    const auto result = read_as<sample::Scene>(R"({"sinew": 1, "figures": [{"prefab": "rope"}]})", 2, pixels);
    EXPECT_EQ(std::get<sample::Rope>(*result.record.figures.at(0).prefab).length, 100);
}

TEST(Reader, APointHasAsManyNumbersAsTheSceneHasDimensions) {
    EXPECT_EQ(read_as<sample::Figure>(R"({"at": [1, 2, 3]})", 3).record.at, (Point{{1, 2, 3}}));
    EXPECT_EQ(read_as<sample::Figure>(R"({"at": [1, 2, 3]})", 2).messages(),
              Lines{"1:8: expected an array of 2, found an array of 3 at /at"});
    EXPECT_EQ(read_as<sample::Figure>(R"({"at": [1, "x"]})", 2).messages(),
              Lines{"1:12: expected a number in m, found the string \"x\" at /at/1"});
}

// --- what is refused --------------------------------------------------------------------------------------------

TEST(Reader, NumbersThatNoFloatHoldsAreRefusedWhereNoRangeSaysSo) {
    EXPECT_EQ(
        read_as<sample::Figure>(R"({"at": [1, 2e30]})").messages(),
        (std::vector<std::string>{"1:12: expected a number from -1e30 to 1e30 m, found the number 2e30 at /at/1"}));
    EXPECT_TRUE(read_as<sample::Figure>(R"({"at": [1, 1e30]})").good);
}

TEST(Reader, WrongTypesSayWhatWasFoundAndExpected) {
    EXPECT_EQ(read_as<sample::Solver>(R"({"mode": 1, "substeps": "many", "tethers": 0, "seed": null})").messages(),
              (Lines{"1:10: expected \"physical\" or \"classic\", found the number 1 at /mode",
                     "1:25: expected an integer from 1 to 1024, found the string \"many\" at /substeps",
                     "1:44: expected true or false, found the number 0 at /tethers",
                     "1:55: expected an integer, found null at /seed"}));
    EXPECT_EQ(
        read_as<sample::Scene>(R"({"sinew": 1, "solver": [], "figures": {}, "masses": 2, "about": true})").messages(),
        (Lines{"1:24: expected an object, found an empty array at /solver",
               "1:39: expected an array, found an object at /figures",
               "1:53: expected an object, found the number 2 at /masses",
               "1:65: expected a string, found true at /about"}));
}

TEST(Reader, IntegersAreWhole) {
    EXPECT_EQ(read_as<sample::Solver>(R"({"substeps": 3.0})").record.substeps, 3);
    EXPECT_EQ(read_as<sample::Rope>(R"({"segments": 1e3})").record.segments, 1000);
    EXPECT_EQ(read_as<sample::Solver>(R"({"substeps": 3.5})").messages(),
              Lines{"1:14: expected an integer from 1 to 1024, found the number 3.5 at /substeps"});
    EXPECT_EQ(read_as<sample::Solver>(R"({"seed": 1e300})").good, false);
}

TEST(Reader, UnknownPropertiesComeWithTheNearest) {
    const auto result = read_as<sample::Rope>(R"({"segmets": 20})");
    EXPECT_EQ(result.messages(), Lines{"1:2: unknown property \"segmets\" at "});
    EXPECT_EQ(result.help(), "did you mean \"segments\"? (allowed here: length, segments)");
}

TEST(Reader, MissingPropertiesAreShownAtTheirObject) {
    EXPECT_EQ(read_as<sample::Scene>(" {\n}").messages(), Lines{"1:2: missing property \"sinew\" at "});
    EXPECT_EQ(read_as<sample::Force>(R"({"force": "wind"})").messages(),
              Lines{"1:1: missing property \"velocity\" at "});
}

TEST(Reader, OneRunReportsAllErrors) {
    const auto result = read_as<sample::Scene>(R"({
  "sinew": 2,
  "abuot": "x",
  "solver": {"substeps": 0, "mode": "clasic"},
  "figures": [{"prefab": "roap"}, {"prefab": "rope", "segments": "x", "height": 2}, 7]
})");
    EXPECT_EQ(result.messages(),
              (Lines{"2:12: expected an integer equal to 1, found the number 2 at /sinew",
                     "3:3: unknown property \"abuot\" at ",
                     "4:26: expected an integer from 1 to 1024, found the number 0 at /solver/substeps",
                     "4:37: expected \"physical\" or \"classic\", found the string \"clasic\" at /solver/mode",
                     "5:26: unknown prefab \"roap\" at /figures/0/prefab",
                     "5:66: expected an integer from 1 to 1000, found the string \"x\" at /figures/1/segments",
                     "5:71: unknown property \"height\" at /figures/1",
                     "5:85: expected an object, found the number 7 at /figures/2"}));
    EXPECT_FALSE(result.good);
}

TEST(Reader, AfterAnErrorTheDefaultStands) {
    const auto result = read_as<sample::Rope>(R"({"segments": 0, "length": 2})");
    EXPECT_EQ(result.record.segments, 20);
    EXPECT_EQ(result.record.length, 2);
}

// --- variants ---------------------------------------------------------------------------------------------------

TEST(Reader, TheTagDecidesWhichKeysAreAllowed) {
    const auto result = read_as<sample::Figure>(R"({"prefab": "rope", "name": "r", "height": 2})");
    EXPECT_EQ(result.messages(), Lines{"1:33: unknown property \"height\" at "});
    EXPECT_EQ(result.help(), "allowed here: at, length, mass, name, prefab, segments");
}

TEST(Reader, AnUnknownTagIsNotFollowedByUnknownKeys) {
    const auto result = read_as<sample::Figure>(R"({"prefab": "rop", "segments": 2, "height": 2, "wide": 3})");
    EXPECT_EQ(result.messages(),
              (Lines{"1:12: unknown prefab \"rop\" at /prefab", "1:47: unknown property \"wide\" at "}));
    EXPECT_EQ(result.help(), "did you mean \"rope\"? (allowed here: ragdoll, rope)");
}

TEST(Reader, ARequiredTagIsMissed) {
    EXPECT_EQ(read_as<sample::Force>(R"({"strength": 2})").messages(), Lines{"1:1: missing property \"force\" at "});
    EXPECT_EQ(read_as<sample::Force>(R"({"force": 2})").messages(),
              Lines{"1:11: expected a string, found the number 2 at /force"});
}

TEST(Reader, AKeyCanBeTheTag) {
    EXPECT_EQ(read_as<sample::Event>(R"({"at": 1})").messages(),
              Lines{"1:1: expected a property \"grab\" or \"release\" at "});
    EXPECT_EQ(read_as<sample::Event>(R"({"grab": "a", "to": [1, 2], "release": "a"})").messages(),
              Lines{"1:29: \"release\" beside \"grab\" at "});
    EXPECT_EQ(read_as<sample::Event>(R"({"release": "a", "to": [1, 2]})").messages(),
              Lines{"1:18: unknown property \"to\" at "});
}

TEST(Reader, NoRecordNamesAKeyTwice) {
    EXPECT_TRUE(laws::each_key_once<sample::Scene>());
    EXPECT_TRUE(laws::each_key_once<sample::Figure>());
    EXPECT_TRUE(laws::each_key_once<Limits>());
}

// --- many -------------------------------------------------------------------------------------------------------

TEST(Reader, AFileOfNothingButErrorsIsRefusedWithTheFirst) {
    std::string text = "{\"sinew\": 1, \"figures\": [";
    for (int i = 0; i < 50000; ++i) text += R"({"prefab":"rope","segmnts":1},)";
    text += "{}]}";
    const auto result = read_as<sample::Scene>(std::move(text));
    EXPECT_EQ(result.diagnostics.count(), 50000u);
    EXPECT_TRUE(to_text(result.diagnostics).ends_with("\nand 49900 more errors\n"));
}

TEST(Reader, ListsThatTakeTooMuchMemoryAreNotRead) {
    Diagnostics diagnostics;
    const auto value =
        json::parse(diagnostics.add_source("a.json", R"({"sinew": 1, "figures": [{}, {}, {}]})"), diagnostics);
    sample::Scene scene;
    EXPECT_TRUE(read(*value, scene, Reading{.diagnostics = diagnostics, .memory = 3 * sizeof(sample::Figure)}));
    EXPECT_FALSE(read(*value, scene, Reading{.diagnostics = diagnostics, .memory = 2 * sizeof(sample::Figure)}));
    EXPECT_EQ(diagnostics.in_order().at(0).path, "/figures");
    EXPECT_TRUE(scene.figures.empty());
}

// --- writing ----------------------------------------------------------------------------------------------------

TEST(Writer, LeavesOutWhatIsTheDefault) {
    EXPECT_EQ(json::to_text(write(sample::Rope{}, Writing{})), "{}");
    EXPECT_EQ(json::to_text(write(sample::Rope{.segments = 3}, Writing{})), "{\"segments\": 3}");
    EXPECT_EQ(json::to_text(write(sample::Rope{.length = 100}, Writing{.units = pixels})), "{}");
    EXPECT_EQ(json::to_text(write(sample::Rope{}, Writing{.defaults = true})), "{\"segments\": 20, \"length\": 1}");
}

TEST(Writer, ReadingUndoesIt) {
    for (const int dimension : {2, 3}) {
        const auto three = std::string(dimension == 3 ? ", 7" : "");
        const auto text = R"({"sinew": 1, "box": [[0, 0)" + three + "], [9, 9" + three + R"(]],
            "figures": [{"prefab": "ragdoll", "name": "bob", "bend": 30}, {"prefab": "rope", "mass": 2}],
            "forces": [{"force": "drag", "strength": 0.1}], "events": [{"at": 2, "release": "x"}],
            "masses": {"a": 1}, "extra": [1]})";
        const auto scene = read_as<sample::Scene>(text, dimension, pixels);
        ASSERT_TRUE(scene.good) << to_text(scene.diagnostics);
        const auto written = write(scene.record, Writing{dimension, pixels});
        const auto again = read_as<sample::Scene>(json::to_text(written), dimension, pixels);
        EXPECT_TRUE(again.good) << to_text(again.diagnostics);
        EXPECT_EQ(write(again.record, Writing{dimension, pixels}), written);
        EXPECT_EQ(std::get<sample::Ragdoll>(*again.record.figures[0].prefab).bend,
                  std::get<sample::Ragdoll>(*scene.record.figures[0].prefab).bend);
    }
}

// --- units ------------------------------------------------------------------------------------------------------

TEST(Units, AreNamedAsAPersonWould) {
    EXPECT_EQ(Units{}.text(unit::acceleration), "m/s^2");
    EXPECT_EQ(pixels.text(unit::speed), "px/frame");
    EXPECT_EQ(Units{}.text(unit::compliance), "s^2/kg");
    EXPECT_EQ(Units{}.text(unit::per_time), "1/s");
    EXPECT_EQ(Units{}.text(unit::angle), "degrees");
    EXPECT_EQ(Units{}.text(unit::none), "");
}

TEST(Units, GravityOnEarthInPixelsAndFrames) {
    EXPECT_DOUBLE_EQ(9.81 * pixels.scale(unit::acceleration), 9.81 * 100 / 3600);
}

RC_GTEST_PROP(UnitsLaw, RoundedIsWithinHalfAUnitOfTheFifteenthDigit, (double number)) {
    RC_PRE(is_finite(number));
    RC_ASSERT(absolute(rounded(number) - number) <= 1e-14 * absolute(number));
    RC_ASSERT(rounded(rounded(number)) == rounded(number));
}

TEST(Units, RoundingGivesWhatAPersonWouldHaveWritten) {
    EXPECT_EQ(rounded(0.1 + 0.2), 0.3);
    EXPECT_EQ(rounded(1.1 * 100), 110);
    EXPECT_EQ(rounded(-1e9 * (0.1 * 3)), -3e8);
    EXPECT_EQ(rounded(0), 0);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
