#include "tests/canvas/scratch_folder.h"
#include "tests/cli/command.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <sys/resource.h>

/// What commands that do not draw tell, for people and as JSON.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

using nlohmann::json;

json json_of(const Arguments& arguments) {
    const auto outcome = sinew(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return json::parse(outcome.last_line());
}

TEST(Run, EndsWithOneObject) {
    const auto result = json_of({"run", "pendulum", "--seconds", "1", "--json"});
    EXPECT_EQ(result["scene"], "pendulum");
    EXPECT_EQ(result["mode"], "physical");
    EXPECT_EQ(result["precision"], "double");
    EXPECT_EQ(result["dimension"], 2);
    EXPECT_EQ(result["units"], json({{"length", "m"}, {"mass", "kg"}, {"time", "s"}}));
    EXPECT_NEAR(result["seconds"], 1, 1e-12);
    EXPECT_EQ(result["steps"], 60);
    EXPECT_EQ(result["particles"], 2);
    EXPECT_EQ(result["constraints"], 1);
    const std::string hash = result["hash"];
    EXPECT_EQ(hash.size(), 16u);
    EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_GT(result["ms_per_step"], 0);
    double phases = 0;
    for (const auto& [phase, milliseconds] : result["ms_by_phase"].items()) phases += milliseconds.get<double>();
    EXPECT_EQ(result["ms_by_phase"].size(), 4u);
    EXPECT_GT(phases, 0);
    EXPECT_EQ(result["events"], json::array());
    EXPECT_EQ(result["events_count"], 0);
}

/// A weight of 2 kg that falls by h from rest at height 0 has E = m v^2 / 2 - m g h = 0.
TEST(Run, MeasuresTheWorld) {
    const auto result = json_of({"run", "pendulum", "--seconds", "0.5", "--json"});
    const auto& energy = result["energy"];
    EXPECT_GT(energy["kinetic"], 1);
    EXPECT_LT(energy["potential"], -1);
    EXPECT_EQ(energy["stored"], 0);
    EXPECT_NEAR(energy["total"], 0, 1e-3);
    const double speed = result["max_speed"];
    EXPECT_NEAR(speed * speed, energy["kinetic"].get<double>(), 1e-9); // v^2 = 2 E / m
    EXPECT_LT(result["stretch_max"], 1e-9);
    EXPECT_LE(result["stretch_mean"], result["stretch_max"]);
}

TEST(Run, TellsWhatHappened) {
    const auto result = json_of({"run", "tearing", "--json"});
    ASSERT_EQ(result["events_count"], 4);
    const auto events = result["events"];
    EXPECT_NEAR(events[0]["seconds"], 0.5, 1e-12);
    EXPECT_EQ(events[0]["what"], "impulse");
    EXPECT_EQ(events[0]["where"], "weight/bob");
    EXPECT_EQ(events[1]["what"], "torn");
    EXPECT_EQ(events[2]["what"], "parted");
    EXPECT_EQ(events[2]["where"], "weight");
    EXPECT_EQ(events[2]["islands"], 2);
    EXPECT_EQ(events[3]["where"], "crate");
    EXPECT_FALSE(events[3].contains("islands"));
    EXPECT_TRUE(has(sinew({"run", "tearing"}).out, "2 impulse, 1 torn, 1 parted"));
}

/// A sentence of the player ends like every message.
TEST(Play, EndsWithTheProblemAsALine) {
    const ScratchFolder folder;
    std::ofstream(folder / "script.txt") << "0.1 save /dev/null/mine.json\n0.2 end\n";
    const auto outcome = sinew({"play", "pendulum", "--script", folder / "script.txt"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(begins(outcome.err, "sinew play: error: cannot write /dev/null/mine.json: ")) << outcome.err;
    EXPECT_TRUE(ends(outcome.err, "\n"));
}

// A ball that lands: run tells it at the end, play when it happens.
TEST(Play, TellsEventsAsRunDoes) {
    const ScratchFolder folder;
    std::ofstream(folder / "landing.json") << R"({"sinew": 1, "world": {"gravity": [0, -10]}, "seconds": 1,
        "colliders": [{"name": "table", "shape": "half_space"}],
        "figures": [{"name": "ball", "particles": {"p": {"at": [0, 0.2], "radius": 0.1}}}],
        "events": [{"on": {"contact": "begin", "of": "ball"}, "note": "it lands"},
                   {"on": {"contact": "persist", "of": "ball"}, "note": "it lies", "times": 2}]})";
    std::ofstream(folder / "script.txt") << "1 end\n";
    const auto run = json_of({"run", folder / "landing.json", "--json"});
    const auto play = sinew({"play", folder / "landing.json", "--script", folder / "script.txt", "--json"});
    ASSERT_EQ(play.code, 0) << play.err;
    json told = json::array();
    std::istringstream lines(play.out);
    for (std::string line; std::getline(lines, line);) {
        auto event = json::parse(line);
        event.erase("scene");
        if (event.contains("where")) told.push_back(event);
    }
    EXPECT_EQ(told, run["events"]);
    ASSERT_GE(told.size(), 3U);
    EXPECT_EQ(told[0]["what"], "begin");
    EXPECT_EQ(told[0]["with"], "table");
    EXPECT_GT(told[0]["impulse"], 0);
}

TEST(Run, TwiceIsTheSame) {
    for (const auto* mode : {"mode=classic", "mode=physical"})
        for (const auto* precision : {"precision=float", "precision=double"}) {
            auto first = json_of({"run", "tearing", "--json", mode, precision});
            auto second = json_of({"run", "tearing", "--json", mode, precision});
            first.erase("ms_per_step");
            first.erase("ms_by_phase");
            second.erase("ms_per_step");
            second.erase("ms_by_phase");
            EXPECT_EQ(first, second);
        }
}

TEST(Run, TakesAsManySteps) {
    const auto steps = [](const char* seconds, const char* rate) {
        return json_of({"run", "pendulum", "--json", "--seconds", seconds, rate})["steps"].get<int>();
    };
    EXPECT_EQ(steps("0", "solver.rate=60"), 0);
    EXPECT_EQ(steps("0.1", "solver.rate=60"), 6);
    EXPECT_EQ(steps("0.3", "solver.rate=10"), 3);
    EXPECT_EQ(steps("0.01", "solver.rate=60"), 1); // at least so long
    EXPECT_EQ(steps("0.7", "solver.rate=100"), 70);
}

/// Numbers that a scene may state, and that overflow once they are squared.
TEST(Run, NeverPrintsWhatIsNoJson) {
    const auto outcome =
        sinew({"run", "pendulum", "--json", "world.gravity=[0,-1e300]", "figures.clock.velocity=[1e300,0]"});
    if (outcome.code == 0) {
        EXPECT_TRUE(json::accept(outcome.last_line())) << outcome.out;
    } else {
        EXPECT_EQ(outcome.code, 1);
    }
}

/// Pages that all ended child processes were given by the system without a disk.
long children_pages() {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return used.ru_minflt;
}

/// A start is the system's work on pages, most of all: 725 of them are 30 ms on a slow virtual machine, 3 ms of which
/// are the dynamic linker's.
TEST(Run, StartsWithAThousandPages) {
    if (sanitized) GTEST_SKIP() << "sanitizers have pages of their own";
    const long before = children_pages();
    ASSERT_EQ(sinew({"run", "pendulum", "--seconds", "0.1", "--json"}).code, 0);
    EXPECT_LT(children_pages() - before, 1000);
}

TEST(Check, CountsWhatIsGoodAndTellsAllThatIsNot) {
    const auto good = sinew({"check", "pendulum", "tearing"});
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_EQ(good.out, "pendulum: ok (1 figure, 2 particles, 1 constraint, 0 events)\n"
                        "tearing: ok (2 figures, 6 particles, 6 constraints, 2 events)\n");

    const auto mixed = sinew({"check", "-", "nothing", "pendulum"},
                             {.input = "{\"sinew\": 1,\n \"dimension\": 4,\n \"secnds\": 3}\n"});
    EXPECT_EQ(mixed.code, 1);
    EXPECT_TRUE(has(mixed.err, "<stdin>:2:15: error: expected an integer from 2 to 3"));
    EXPECT_TRUE(has(mixed.err, "<stdin>:3:2: error: unknown property \"secnds\""));
    EXPECT_TRUE(has(mixed.err, "no scene is called \"nothing\""));
    EXPECT_TRUE(has(mixed.out, "pendulum: ok"));
}

TEST(Info, TellsWhatIsThere) {
    const auto text = sinew({"info", "tearing", "--names"}).out;
    for (const auto* part : {"A blow tears", "weight  by_hand  2 particles", "crate", "5 distance", "gravity",
                             "weight/bob", "weight/thread", "crate/top_left", "at the start"})
        EXPECT_TRUE(has(text, part));
}

TEST(Info, IsJsonToo) {
    const auto info = json_of({"info", "tearing", "--json", "--names", "--seconds", "1"});
    EXPECT_EQ(info["figures"][0]["name"], "weight");
    EXPECT_EQ(info["figures"][0]["constraints"]["distance"], 1);
    EXPECT_EQ(info["figures"][0]["particle_names"], json({"nail", "bob"}));
    EXPECT_EQ(info["figures"][1]["prefab"], "box");
    EXPECT_EQ(info["forces"], json({"gravity"}));
    EXPECT_EQ(info["start"]["steps"], 0);
    EXPECT_EQ(info["then"]["steps"], 60);
    EXPECT_EQ(info["start"]["constraints"], 6);
    EXPECT_EQ(info["then"]["constraints"], 5); // one is torn
    EXPECT_EQ(info["figures"][0]["islands"], 2);
    EXPECT_EQ(info["figures"][1]["islands"], 1);
    EXPECT_EQ(info["rig"], json::array());
}

TEST(Info, NamesWhatHasANumber) {
    const std::string scene = R"({"sinew": 1, "figures": [{"prefab": "polygon", "sides": 3},
        {"prefab": "cloth", "columns": 2, "rows": 3}]})";
    const auto text = sinew({"info", "-", "--names", "--seconds", "0"}, {.input = scene}).out;
    for (const auto* name : {"polygon/corner_0", "polygon/corner_2", "polygon/edge_2", "cloth/particle_1_2"})
        EXPECT_TRUE(has(text, name));
    EXPECT_FALSE(has(text, "polygon/corner_3"));
    const auto outcome = sinew({"info", "-", "--names", "--json", "--seconds", "0"}, {.input = scene});
    const auto cloth = json::parse(outcome.last_line())["figures"][1];
    for (const auto* name : {"top_left", "particle_0_0", "particle_1_2"})
        EXPECT_EQ(std::ranges::count(cloth["particle_names"], name), 1) << name;
}

TEST(Info, TellsWhatIsWrongWithARig) {
    const std::string scene = R"({"sinew": 1, "figures": [{"name": "arm", "particles": {
        "shoulder": {"at": [0, 0], "pinned": true}, "elbow": {"at": [1, 0]}, "hand": {"at": [1, 1], "pinned": true}},
        "constraints": [{"name": "upper", "between": ["shoulder", "elbow"], "high": 0.4},
                        {"name": "lower", "between": ["elbow", "hand"]},
                        {"name": "bend", "kind": "angle", "between": ["shoulder", "elbow", "hand"], "low": -10,
                         "high": 30}]}]})";
    const auto text = sinew({"info", "-", "--seconds", "0"}, {.input = scene}).out;
    EXPECT_TRUE(has(text, "arm/upper     stands at 1, its limits are at most 0.4\n")) << text;
    EXPECT_TRUE(has(text, "arm/bend      stands at 90, its limits are -10 to 30\n")) << text;
    EXPECT_TRUE(has(text, "arm/shoulder  is held 1.414 from arm/hand, but the links between them reach 1.4\n")) << text;
    EXPECT_TRUE(has(sinew({"info", "tearing"}).out, "nothing is wrong with it"));
}

TEST(List, NamesScenesAndPrefabs) {
    const auto text = sinew({"list"}).out;
    EXPECT_TRUE(has(text, "  pendulum  A weight on a string.\n"));
    EXPECT_TRUE(has(text, "  tearing   A blow tears"));
    EXPECT_TRUE(has(text, "prefabs\n"));
    EXPECT_TRUE(has(text, "  rope "));

    const auto lists = json_of({"list", "--json"});
    EXPECT_EQ(lists["scenes"].size(), 2u);
    EXPECT_EQ(lists["scenes"][0]["name"], "pendulum");
    EXPECT_EQ(lists["scenes"][0]["about"], "A weight on a string.");
    EXPECT_EQ(lists["scenes"][0]["category"], "other"); // it says none
    EXPECT_EQ(lists["scenes"][0]["file"], (catalogue() / "pendulum.json").string());
    EXPECT_TRUE(std::ranges::any_of(lists["prefabs"], [](const json& prefab) { return prefab["name"] == "ragdoll"; }));
}

TEST(Describe, HasATableForEverythingItNames) {
    const auto topics = sinew({"describe"}).out;
    for (const auto* topic : {"scene", "limits", "rope", "ragdoll", "rules", "wind", "grab", "solver", "camera"}) {
        EXPECT_TRUE(has(topics, std::string("  ") + topic + " "));
        const auto table = sinew({"describe", topic});
        EXPECT_EQ(table.code, 0) << table.err;
        EXPECT_TRUE(has(table.out, "default"));
        EXPECT_TRUE(has(sinew({"describe", topic, "--markdown"}).out, "| name | type |"));
        EXPECT_TRUE(json::accept(sinew({"describe", topic, "--schema"}).out));
    }
    EXPECT_EQ(sinew({"describe", "solver.rules"}).out, sinew({"describe", "rules"}).out);
}

TEST(Describe, TellsHowAPrefabIsSpokenOf) {
    const auto rope = sinew({"describe", "rope"}).out;
    EXPECT_TRUE(has(rope, "the particle start"));
    EXPECT_TRUE(has(rope, "link_0 .. link_{segments-1}"));
    EXPECT_TRUE(has(rope, "a smooth line: color, width, image"));
    EXPECT_TRUE(has(rope, "(weight=1)")) << "parts that only another value brings";
    const auto cloth = sinew({"describe", "cloth"}).out;
    EXPECT_TRUE(has(cloth, "particle_0_0 .. particle_{columns-1}_{rows-1}"));
    EXPECT_FALSE(has(sinew({"describe", "wind"}).out, "names in scene files"));
}

TEST(Describe, TellsTheNamesOfEveryPrefab) {
    const auto prefabs = json_of({"list", "--json"})["prefabs"];
    ASSERT_GT(prefabs.size(), 10u);
    for (const auto& prefab : prefabs) {
        const std::string name = prefab["name"];
        const auto text = sinew({"describe", name}).out;
        EXPECT_TRUE(has(text, "names in scene files")) << name;
        EXPECT_TRUE(has(text, "\n  particles ")) << name;
        EXPECT_TRUE(has(text, "parts for \"looks\"")) << name;
    }
}

TEST(Describe, CorrectsNames) {
    const auto outcome = sinew({"describe", "ragdol"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(has(outcome.err, "did you mean \"ragdoll\"?"));
}

TEST(Describe, MakesASchemaForEditors) {
    const auto schema = json::parse(sinew({"describe", "scene", "--schema"}).out);
    EXPECT_TRUE(schema.contains("$schema"));
    EXPECT_TRUE(schema["properties"].contains("figures"));
    EXPECT_TRUE(schema["properties"].contains("modes"));
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
