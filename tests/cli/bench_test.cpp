#include "tests/cli/command.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

/// What `sinew bench` prints; never how long anything took.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

std::vector<nlohmann::json> lines(const Outcome& outcome) {
    std::vector<nlohmann::json> all;
    std::istringstream text(outcome.out);
    for (std::string line; std::getline(text, line);) all.push_back(nlohmann::json::parse(line));
    return all;
}

TEST(Bench, PrintsAnObjectALineForEveryCaseAndNumberOfThreads) {
    const auto outcome =
        sinew({"bench", "cloth-6", "ropes-2", "ragdolls-2-direct", "--threads", "2", "--steps", "3", "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const auto all = lines(outcome);
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0]["case"], "cloth-6");
    EXPECT_EQ(all[0]["particles"], 36);
    EXPECT_EQ(all[0]["constraints"], 110);
    for (const auto& line : all) {
        EXPECT_EQ(line["threads"], 2);
        EXPECT_EQ(line["precision"], "float");
        EXPECT_TRUE(line["simd"].is_string());
        EXPECT_GT(line["ms_per_step"].get<double>(), 0);
        EXPECT_GT(line["ratio"].get<double>(), 0);
        EXPECT_GE(line["stretch_max"].get<double>(), line["stretch_mean"].get<double>());
        EXPECT_GT(line["rivals"]["textbook"]["ms_per_step"].get<double>(), 0);
        for (const auto& times : {line, line["rivals"]["textbook"]}) { // of three steps the 99th percentile is the last
            EXPECT_GE(times["ms_worst"].get<double>(), times["ms_per_step"].get<double>());
            EXPECT_EQ(times["ms_percentile_99"], times["ms_worst"]);
        }
        EXPECT_GT(line["rivals"]["textbook_shuffled"]["ms_per_step"].get<double>(), 0);
        EXPECT_EQ(line.contains("projections_per_s"), line["case"] != "ragdolls-2-direct");
    }
    const double projections = 110 * 10 / (all[0]["ms_per_step"].get<double>() / 1000);
    EXPECT_NEAR(all[0]["projections_per_s"].get<double>(), projections, 1e-6 * projections);
}

TEST(Bench, PrintsATableForPeople) {
    const auto outcome = sinew({"bench", "mesh-5", "--precision", "double", "--threads", "1", "--steps", "2"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const auto* part :
         {"99 %", "worst", "G projections/s", "mesh-5 (72)", "sinew, double, 1 thread", "textbook, shuffled"})
        EXPECT_TRUE(has(outcome.out, part)) << part << outcome.out;
}

TEST(Bench, StillMeasuresRopes) {
    const auto all = lines(sinew({"bench", "rope", "--case", "rope", "--links", "3", "--weight", "1", "--start", "hang",
                                  "--seconds", "0.1", "--json"}));
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0]["links"], 3);
    EXPECT_LT(all[0]["stretch_max"].get<double>(), 1e-6);
    EXPECT_GE(all[0]["ms_worst"], all[0]["ms_percentile_99"]);
    EXPECT_GE(all[0]["ms_percentile_99"], all[0]["ms_per_step"]);
}

TEST(Bench, TellsWhatTimeBuysAndDrawsIt) {
    const auto path = testing::TempDir() + "quality.svg";
    const auto all = lines(sinew({"bench", "quality", "swing-4", "--steps", "2", "--json", "--plot", path}));
    ASSERT_GE(all.size(), 3U * 8);
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i]["case"], "swing-4");
        EXPECT_GT(all[i]["ms_per_step"].get<double>(), 0);
        for (const auto* number : {"substeps", "iterations", "stretch_max", "stretch_last", "stretch_mean"})
            EXPECT_TRUE(all[i][number].is_number()) << number;
    }
    EXPECT_EQ(all[0]["by"], "sinew");
    EXPECT_EQ(all[8]["by"], "textbook");
    std::ifstream file(path);
    const std::string svg{std::istreambuf_iterator<char>(file), {}};
    EXPECT_TRUE(begins(svg, "<svg ") && has(svg, "</svg>")) << svg;
    EXPECT_TRUE(has(svg, "textbook, shuffled") && has(svg, "<polyline") && !has(svg, "nan"));
}

TEST(Bench, HangsHeavyThingsOnARope) {
    const auto outcome = sinew({"bench", "weights", "--steps", "2", "--markdown"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(begins(outcome.out, "| weight, in ropes | by |")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "|---|---|"));
    EXPECT_TRUE(has(outcome.out, "| 1000 | sinew | default |"));
    const auto nowhere = sinew({"bench", "weights", "--steps", "2", "--plot", "/nowhere/x.svg"});
    EXPECT_EQ(nowhere.code, 1);
    EXPECT_TRUE(has(nowhere.err, "/nowhere/x.svg: error:")) << nowhere.err;
}

TEST(Bench, KnowsWhatItCanMeasure) {
    for (const auto* word : {"silk-8", "cloth-1", "cloth", "cloth-8-direct"}) {
        const auto outcome = sinew({"bench", word});
        EXPECT_EQ(outcome.code, 2);
        EXPECT_TRUE(has(outcome.err, std::string("there is no case ") + word)) << outcome.err;
    }
    EXPECT_EQ(sinew({"bench", "cloth-8", "--precision", "half"}).code, 2);
    EXPECT_EQ(sinew({"bench", "cloth-8", "--steps", "1"}).code, 2);
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
