#include "sinew/scene/diagnostic.h"

#include <array>
#include <gtest/gtest.h>
#include <string>

namespace sinew::SINEW_TEST_FILE {
namespace {

/// The diagnostics of one error on the given part of the text.
Diagnostics error_on(const std::string& text, std::string_view part, std::string help = {}) {
    Diagnostics diagnostics;
    const auto source = diagnostics.add_source("ragdoll.json", text);
    const auto at = std::uint32_t(text.find(part));
    diagnostics.error({source, at, at + std::uint32_t(part.size())}, "/points/2", "unknown property \"masss\"",
                      std::move(help));
    return diagnostics;
}

std::string line_of(const std::string& text, int line) {
    std::size_t begin = 0;
    while (line-- > 1) begin = text.find('\n', begin) + 1;
    return text.substr(begin, text.find('\n', begin) - begin);
}

TEST(Diagnostic, HasTheShapeOfACompilersMessage) {
    const std::string text = "\n\n\n\n\n\n\n    {\"id\": \"hip\", \"pos\": [0.3], \"masss\": 1.0 }\n";
    const std::vector<std::string_view> allowed = {"pos", "mass", "id", "pinned"};
    EXPECT_EQ(to_text(error_on(text, "\"masss\"", suggest("masss", allowed))),
              "ragdoll.json:8:33: error: unknown property \"masss\" at /points/2\n"
              "    8 |     {\"id\": \"hip\", \"pos\": [0.3], \"masss\": 1.0 }\n"
              "      |                                 ^~~~~~~\n"
              "      = help: did you mean \"mass\"? (allowed here: id, mass, pinned, pos)\n");
}

TEST(Diagnostic, ColumnsCountCharactersAndMarksStandUnderThem) {
    const auto text = to_text(error_on("{\"größe\": x}", "x"));
    EXPECT_TRUE(text.starts_with("ragdoll.json:1:11: ")) << text;
    EXPECT_EQ(line_of(text, 3), "      |           ^");
    const auto wide = to_text(error_on("{\"日本\": x}", "x"));
    EXPECT_TRUE(wide.starts_with("ragdoll.json:1:8: ")) << wide;
    EXPECT_EQ(line_of(wide, 3), "      |          ^") << "the two signs are four columns wide";
}

TEST(Diagnostic, ATabIsOneCharacterShownAsFourBlanks) {
    const auto text = to_text(error_on("\t\"a\":\tx", "x"));
    EXPECT_TRUE(text.starts_with("ragdoll.json:1:7: ")) << text;
    EXPECT_EQ(line_of(text, 2), "    1 |     \"a\":    x");
    EXPECT_EQ(line_of(text, 3), "      |             ^");
}

TEST(Diagnostic, ALongLineIsCutAroundThePlace) {
    const std::string many(5000, 'a');
    const auto text = to_text(error_on(many + "XYZ" + many, "XYZ"));
    EXPECT_TRUE(text.starts_with("ragdoll.json:1:5001: ")) << text;
    const auto source = line_of(text, 2), marks = line_of(text, 3);
    EXPECT_LT(source.size(), 130u);
    EXPECT_EQ(source.substr(marks.find('^'), 3), "XYZ");
    EXPECT_EQ(marks.substr(marks.find('^')), "^~~");
    EXPECT_NE(source.find("| ..."), std::string::npos);
    EXPECT_TRUE(source.ends_with("..."));
}

TEST(Diagnostic, MarksStopAtTheEndOfTheLine) {
    const auto text = to_text(error_on("{\"a\": [1,\n 2]}\n", "[1,\n 2]"));
    EXPECT_EQ(line_of(text, 3), "      |       ^~~");
    const auto windows = to_text(error_on("{\"a\": [1,\r\n 2]}\r\n", "[1,\r\n 2]"));
    EXPECT_EQ(windows, text);
}

TEST(Diagnostic, APlaceAtTheEndOfTheFileIsAfterItsLastCharacter) {
    Diagnostics diagnostics;
    const auto source = diagnostics.add_source("a.json", "{\n  \"a\"");
    diagnostics.error({source, 7, 7}, "", "the file ends too early");
    EXPECT_EQ(to_text(diagnostics), "a.json:2:6: error: the file ends too early at /\n"
                                    "    2 |   \"a\"\n"
                                    "      |      ^\n");
}

TEST(Diagnostic, ErrorsComeInTheOrderOfTheirPlacesEachOnce) {
    Diagnostics diagnostics;
    const auto source = diagnostics.add_source("a.json", "0123456789");
    for (const std::uint32_t at : {5u, 2u, 8u, 2u}) diagnostics.error({source, at, at + 1}, "", "wrong");
    ASSERT_EQ(diagnostics.count(), 3u);
    EXPECT_EQ(diagnostics.in_order()[0].span.begin, 2u);
    EXPECT_EQ(diagnostics.in_order()[2].span.begin, 8u);
}

TEST(Diagnostic, BeyondTheMostShownTheRestIsCounted) {
    Diagnostics diagnostics;
    const auto source = diagnostics.add_source("a.json", std::string(1000, ' '));
    for (std::uint32_t at = 0; at < 1000; ++at) diagnostics.error({source, at, at + 1}, "", "wrong");
    const auto text = to_text(diagnostics, {.max = 100});
    EXPECT_TRUE(text.ends_with("\nand 900 more errors\n"));
    EXPECT_EQ(to_text(diagnostics, {.max = 999}).find("more error\n"), std::string::npos);
}

TEST(Diagnostic, NothingOfAFileReachesTheTerminalAsAControl) {
    auto diagnostics = error_on("\"\x1b[2J\x07\xE2\x80\xAE\" x", "x");
    diagnostics.error({0, 0, 1}, "/a\x1b[0m", "unknown " + in_quotes("a\x1b\n\xC2\x9B"), suggest("\x1b", {}));
    for (const char c : to_text(diagnostics)) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << int(c);
    EXPECT_EQ(to_text(diagnostics).find("\xE2\x80\xAE"), std::string::npos);
}

TEST(Diagnostic, IsColoredOnlyWhenAsked) {
    const auto diagnostics = error_on("{x}", "x", "help");
    EXPECT_EQ(to_text(diagnostics).find('\x1b'), std::string::npos);
    EXPECT_NE(to_text(diagnostics, {.color = true}).find("\x1b[1;31merror:\x1b[0m"), std::string::npos);
}

TEST(Diagnostic, PlacesSkipAByteOrderMark) {
    auto diagnostics = error_on("\xEF\xBB\xBFx", "x");
    EXPECT_TRUE(to_text(diagnostics).starts_with("ragdoll.json:1:1: "));
}

TEST(Nearest, FindsSlipsOfTheFingerAndNothingElse) {
    constexpr std::array<std::string_view, 6> words = {"mass", "radius", "segments", "damping", "at", "gravity"};
    EXPECT_EQ(nearest("masss", words), "mass") << "one letter too many";
    EXPECT_EQ(nearest("mas", words), "mass") << "one too few";
    EXPECT_EQ(nearest("mess", words), "mass") << "one changed";
    EXPECT_EQ(nearest("radisu", words), "radius") << "two swapped";
    EXPECT_EQ(nearest("MASS", words), "mass") << "another case";
    EXPECT_EQ(nearest("damp", words), "damping") << "its beginning";
    EXPECT_EQ(nearest("ta", words), "at");
    EXPECT_EQ(nearest("friction", words), "");
    EXPECT_EQ(nearest("", words), "");
    EXPECT_EQ(nearest("xy", words), "");
    EXPECT_EQ(nearest(std::string(100000, 'm'), words), "");
}

TEST(Nearest, PrefersTheClosest) {
    constexpr std::array<std::string_view, 3> words = {"left_foot", "left_hand", "right_hand"};
    EXPECT_EQ(nearest("left_hnad", words), "left_hand");
    EXPECT_EQ(nearest("rigth_hand", words), "right_hand");
}

TEST(Printable, ALongTextIsCutAtACharacter) {
    EXPECT_EQ(in_quotes("größer als das", 4), "\"größ...\"");
    EXPECT_EQ(in_quotes("kurz", 4), "\"kurz\"");
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
