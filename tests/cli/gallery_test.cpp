#include "tests/canvas/scratch_folder.h"
#include "tests/cli/command.h"

#include <gtest/gtest.h>

/// sinew gallery.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

std::size_t count(const std::string& text, std::string_view part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(Gallery, IsOnePageThatLoadsNothing) {
    const ScratchFolder folder;
    const auto outcome = sinew({"gallery", "pendulum", "-o", "deep/gallery.html"}, {.folder = folder.path});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(begins(outcome.out, "deep/gallery.html: 1 scene, "));
    const auto html = text_of(folder / "deep/gallery.html");
    EXPECT_EQ(count(html, "<article"), 1U);
    EXPECT_EQ(count(html, "src=\"data:image/webp;base64,UklGR"), 2U) << "a film in each mode; base64 of RIFF";
    EXPECT_EQ(count(html, "src=\""), 2U);
    EXPECT_EQ(count(html, "<link"), 0U);
    EXPECT_EQ(count(html, "url("), 0U);
    EXPECT_TRUE(has(html, "&quot;sinew&quot;: 1")) << "the file of the scene";
    EXPECT_EQ(std::filesystem::directory_iterator(folder / "deep")->path().filename(), "gallery.html");
}

TEST(Gallery, SaysWhatItCannotDo) {
    const ScratchFolder folder;
    EXPECT_EQ(sinew({"gallery", "pendulm"}, {.folder = folder.path}).code, 1);
    EXPECT_EQ(sinew({"gallery", "pendulum", "solver.substeps=3"}, {.folder = folder.path}).code, 2);
    const auto alone =
        sinew({"gallery", "pendulum"}, {.environment = {{"PATH", "/nonexistent"}}, .folder = folder.path});
    EXPECT_EQ(alone.code, 1);
    EXPECT_TRUE(has(alone.err, "ffmpeg"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/gallery.html"));
    const auto folder_there = sinew({"gallery", "pendulum", "-o", "."}, {.folder = folder.path});
    EXPECT_EQ(folder_there.code, 1);
    EXPECT_TRUE(has(folder_there.err, "it is a folder"));
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
