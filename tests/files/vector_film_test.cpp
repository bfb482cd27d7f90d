#include "files/out/tracks.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/files/export_scenes.h"

#include <cmath>
#include <nlohmann/json.hpp>

/// Moving vectors: keys, Lottie and SVG.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

using Json = nlohmann::json;

/// A track of one point along given numbers.
files::Track track_of(const std::vector<float>& xs) {
    files::Track track;
    track.shape = Shape::disc, track.points = 1;
    for (const float x : xs)
        for (const float number : {x, 0.0F, 3.0F, 1.0F, 0.0F, 0.0F, 1.0F}) track.numbers.push_back(number);
    return track;
}

TEST(Keys, OfAStraightMotionAreItsEnds) {
    std::vector<float> xs;
    for (int i = 0; i < 50; ++i) xs.push_back(float(3 * i));
    EXPECT_EQ(files::keys_of(track_of(xs), 0.01, false), (std::vector<std::size_t>{0, 49}));
    EXPECT_EQ(files::keys_of(track_of(std::vector<float>(50, 4)), 0.01, false), (std::vector<std::size_t>{0}));
}

TEST(Keys, KeepTheStatedError) {
    std::vector<float> xs;
    for (int i = 0; i < 200; ++i) xs.push_back(100 * std::sin(0.05F * float(i)) + (i % 37 == 0 ? 9.0F : 0.0F));
    for (const double tolerance : {0.1, 1.0, 5.0}) {
        const auto keys = files::keys_of(track_of(xs), tolerance, false);
        EXPECT_LT(keys.size(), xs.size());
        ASSERT_EQ(keys.back(), xs.size() - 1);
        for (std::size_t k = 0; k + 1 < keys.size(); ++k)
            for (auto i = keys[k]; i <= keys[k + 1]; ++i) {
                const float share = float(i - keys[k]) / float(keys[k + 1] - keys[k]);
                const float between = xs[keys[k]] + (xs[keys[k + 1]] - xs[keys[k]]) * share;
                EXPECT_NEAR(between, xs[i], tolerance + 1e-4);
            }
    }
}

TEST(Lottie, HasTheDiscWhereTheBallIs) {
    const ScratchFolder folder;
    const int frames = 12;
    auto session = falling();
    export_frames<2>(session, {.path = folder / "f.json", .fps = 60, .size = {64, 48}, .tolerance = 0}, frames);
    const auto json = Json::parse(text_of(folder / "f.json"));
    EXPECT_EQ(json["op"], frames);
    Json keys;
    for (const auto& layer : json["layers"])
        for (const auto& group : layer["shapes"])
            if (group["it"][0]["ty"] == "el") keys = group["it"][0]["p"]["k"];
    ASSERT_EQ(keys.size(), std::size_t(frames)); // an accelerated motion keeps every frame where no error is allowed
    for (int frame = 0; frame < frames; ++frame) {
        const auto pixel = session.view(64, 48).see({{32, double(positions<2>(session)[0][1]), 0}})->pixel;
        EXPECT_NEAR(keys[std::size_t(frame)]["s"][1].get<double>(), double(pixel[1]), 0.006); // hundredths
        session.step();
    }
}

TEST(AnimatedSvg, MovesTheBallInALoop) {
    const ScratchFolder folder;
    export_frames<2>(falling(), {.path = folder / "f.svg", .fps = 60, .size = {64, 48}}, 60);
    const auto text = text_of(folder / "f.svg");
    EXPECT_NE(text.find("<animate attributeName=\"cy\" dur=\"1s\" repeatCount=\"indefinite\" keyTimes=\"0;"),
              std::string::npos);
    EXPECT_EQ(text.find("attributeName=\"cx\""), std::string::npos); // it falls straight down
    EXPECT_TRUE(text.ends_with("</svg>\n"));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
