#include "sinew/math/color.h"
#include "sinew/math/color_names.h"
#include "sinew/scene/key_paths.h"
#include "sinew/scene/scene.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

/// The help that errors of scenes give beyond the place of a mistake.
namespace sinew::SINEW_TEST_FILE {
namespace {

constexpr auto two_ropes = R"({"sinew": 1, "figures": [
    {"prefab": "rope", "name": "left"}, {"prefab": "rope"}, {"prefab": "cloth", "name": "sheet"}]})";

/// All that is said of a scene.
std::string said_of(const std::string& scene, std::vector<Override> overrides = {}) {
    auto document = load(scene, "a.json", overrides);
    open_scene(document);
    return to_text(document.diagnostics);
}

testing::AssertionResult says(const std::string& text, std::string_view part) {
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "not said: " << part << "\nin: " << text;
}

TEST(OverrideHelp, NamesTheFullPathOfAKeyThatIsSomewhereElse) {
    EXPECT_TRUE(says(said_of(two_ropes, {{"gravity=0"}}), "did you mean \"world.gravity\"?"));
    EXPECT_TRUE(says(said_of(two_ropes, {{"gravity.1=-3"}}), "did you mean \"world.gravity\"?"));
    EXPECT_TRUE(says(said_of(two_ropes, {{"world.substeps=3"}}), "did you mean \"solver.substeps\"?"));
    EXPECT_TRUE(says(said_of(two_ropes, {{"time_scale=2"}}), "did you mean \"solver.rules.time_scale\"?"));
}

TEST(OverrideHelp, NamesTheFiguresOfTheSceneThatHaveTheParameter) {
    EXPECT_TRUE(says(said_of(two_ropes, {{"segments=9"}}),
                     "did you mean \"figures.left.segments\" or \"figures.rope.segments\"?"));
    EXPECT_TRUE(says(said_of(two_ropes, {{"columns=9"}}), "did you mean \"figures.sheet.columns\"?"));
}

TEST(OverrideHelp, FindsAWordThatIsRenamedInOneSectionAndLivesOnInAnother) {
    EXPECT_TRUE(says(said_of(two_ropes, {{"angle=9"}}), "did you mean \"figures.left.angle\" or"));
    EXPECT_TRUE(says(said_of(two_ropes, {{"pulls_within=9"}}), "did you mean \"pointer.grab_radius\"?"));
}

TEST(OverrideHelp, FindsAKeyOfNearlyThatSpelling) {
    EXPECT_TRUE(says(said_of(two_ropes, {{"gravty=0"}}), "did you mean \"world.gravity\"?"));
    EXPECT_TRUE(says(said_of(two_ropes, {{"worl.gravity=0"}}), "did you mean \"world\"?"))
        << "what is here comes first";
    EXPECT_TRUE(says(said_of(two_ropes, {{"nonsense_of_mine=0"}}), "allowed here: about,"));
}

TEST(FileHelp, TellsWhatIsAllowedThereAndWhichSectionHasTheKey) {
    const auto said = [](const std::string& member) { return said_of(R"({"sinew": 1, )" + member + "}"); };
    EXPECT_TRUE(says(said(R"("gravity": 0)"), "did you mean \"world.gravity\"? allowed here: about,"));
    EXPECT_TRUE(says(said(R"("substeps": 3)"), "did you mean \"solver.substeps\"?"));
    EXPECT_TRUE(says(said(R"("restitution": 1)"), "did you mean \"world.bounds.bounce\"?"));
    EXPECT_TRUE(says(said(R"("bounce": 1)"), "did you mean \"world.bounds.bounce\"?")) << "not source, of like letters";
    EXPECT_TRUE(says(said(R"("nonsense_of_mine": 0)"), "help: allowed here: about,"));
}

TEST(FileHelp, KnowsTheWordsOfOtherEngines) {
    const auto said = [](const std::string& members) {
        return said_of(R"({"sinew": 1, "figures": [{)" + members + R"(, "at": [0, 0]}]})");
    };
    EXPECT_TRUE(says(said(R"("prefab": "circle")"), "did you mean \"ball\"?"));
    EXPECT_TRUE(says(said(R"("prefab": "box", "restitution": 1)"), "did you mean \"contact.bounce\"?"));
    EXPECT_TRUE(says(said(R"("prefab": "box", "density": 1)"), "did you mean \"mass\"?"));
    EXPECT_TRUE(says(said(R"("prefab": "box", "color": "red")"), "did you mean \"looks\"?"));
}

TEST(SceneVersion, OfALaterSinewIsToldAloneAsSuch) {
    const auto said = said_of(R"({"sinew": 2, "figures": [{"quantum": true}]})");
    EXPECT_TRUE(
        says(said, "a.json:1:11: error: this file is of version 2 of the scene format, which a later Sinew reads"));
    EXPECT_TRUE(says(said, "this one reads version 1"));
    EXPECT_EQ(said.find("unknown property"), std::string::npos) << said;
    EXPECT_TRUE(says(said_of(R"({"sinew": 0})"), "expected an integer equal to 1"));
}

TEST(Suggestions, NeverSayThatOneMoreIsAllowed) {
    std::vector<std::string> names;
    for (int i = 0; i < 60; ++i) names.push_back("name_" + std::to_string(i));
    for (std::size_t count = 1; count < names.size(); ++count) {
        const auto help = suggest("zzz", {names.begin(), names.begin() + std::ptrdiff_t(count)});
        for (int few = 1; few < 8; ++few)
            EXPECT_EQ(help.find("and " + std::to_string(few) + " more"), std::string::npos) << count << ": " << help;
    }
    EXPECT_TRUE(says(suggest("zzz", {names.begin(), names.begin() + 50}), "and 18 more"));
}

TEST(Names, ByNumberAreToldWhereOneIsNotFound) {
    const auto said = said_of(R"({"sinew": 1, "figures": [{"prefab": "polygon", "sides": 5}],
        "pins": [{"particle": "polygon/corner_7"}]})");
    EXPECT_TRUE(says(said, "there is no particle in \"polygon\" called \"corner_7\""));
    EXPECT_TRUE(says(said, "corner_0 to corner_4"));
}

std::string colored(const std::string& color) {
    return said_of(R"({"sinew": 1, "figures": [{"prefab": "rope", "looks": {"rope": {"color": ")" + color + "\"}}}]}");
}

TEST(Colors, AreAllOfCss) {
    EXPECT_TRUE(std::ranges::is_sorted(css_colors, {}, &NamedColor::name));
    for (const auto& named : css_colors) EXPECT_TRUE(parse_color(named.name)) << named.name;
    EXPECT_EQ(*parse_color("rebeccapurple"), *parse_color("#663399"));
    EXPECT_EQ(*parse_color("papayawhip"), *parse_color("#ffefd5"));
    EXPECT_EQ(*parse_color("brown"), *parse_color("#a52a2a"));
    for (const auto* hex : {"#000000", "#0a10f9", "#ffffff"}) EXPECT_EQ(hex_of(*parse_color(hex)), hex);
    EXPECT_EQ(hex_of({-1, 0.5F, 2}), "#0080ff");
    EXPECT_EQ(colored("lightgoldenrodyellow"), "");
    EXPECT_EQ(colored("paper"), "");
}

TEST(Colors, ThatThereAreNotAreToldWhichAreNear) {
    EXPECT_TRUE(says(colored("tomatoe"), "did you mean \"tomato\"?"));
    EXPECT_TRUE(says(colored("seablue"), "near it: blue, slateblue, steelblue"));
    EXPECT_TRUE(says(colored("bluish"), "near it: blue"));
    EXPECT_TRUE(says(colored("xyz"), "every name of CSS"));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
