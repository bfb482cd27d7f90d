#include "apps/window/statistics.h"
#include "tests/play/game.h"

#include <gtest/gtest.h>
#include <imgui.h>

/// Statistics without a window: pictures pass, and samples are taken.
namespace sinew::window::SINEW_TEST_FILE {
namespace {

struct StatisticsTest : testing::Test {
    StatisticsTest() {
        ImGui::CreateContext();
        auto& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {100, 100};
        io.DeltaTime = 0.2F;
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    }
    ~StatisticsTest() override { ImGui::DestroyContext(); }
    StatisticsTest(const StatisticsTest&) = delete;
    StatisticsTest& operator=(const StatisticsTest&) = delete;

    void pictures(int count) {
        for (int i = 0; i < count; ++i) {
            play.advance(0.2);
            ImGui::NewFrame();
            statistics.sample(play);
            ImGui::EndFrame();
        }
    }

    play::Play play{play::games::library, "ragdoll"};
    Statistics statistics;
};

TEST_F(StatisticsTest, BeginAnewWithARestartWhileTimeStands) {
    pictures(20);
    EXPECT_GT(statistics.samples(), 15u);
    EXPECT_GT(statistics.report().seconds, 1);
    play.pause(true);
    pictures(2);
    const auto samples = statistics.samples();
    play.restart();
    pictures(2);
    EXPECT_EQ(statistics.report().seconds, 0);
    EXPECT_EQ(statistics.samples(), 1u) << "not " << samples << ": the curves begin with the scene";
    pictures(3);
    EXPECT_EQ(statistics.samples(), 1u) << "nothing changes";
}

TEST_F(StatisticsTest, CountWhatAnEditAddsWhileTimeStands) {
    play.pause(true);
    pictures(2);
    const auto particles = statistics.report().particles;
    ASSERT_TRUE(play.add_figure({{"prefab", "box"}, {"name", "box"}}, "box")) << play.problem();
    pictures(2);
    EXPECT_EQ(statistics.report().particles, particles + 4);
    play.undo();
    pictures(2);
    EXPECT_EQ(statistics.report().particles, particles);
}

} // namespace
} // namespace sinew::window::SINEW_TEST_FILE
