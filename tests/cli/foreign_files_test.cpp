#include "tests/canvas/scratch_folder.h"
#include "tests/cli/command.h"

#include <fstream>

/// Files of other programs given to `play`, and exports.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

TEST(PlayCommand, MakesASceneOfADrawing) {
    const ScratchFolder folder;
    write(folder / "logo.svg", "<svg width='40' height='40'><text>a</text><rect width='8' height='8'/></svg>");
    write(folder / "script.txt", "0.1 drop logo.svg\n0.3 end\n");
    const auto outcome =
        sinew({"play", "logo.svg", "--script", "script.txt", "--json"}, {.environment = {}, .folder = folder.path});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "\"what\": \"imported\""));
    EXPECT_TRUE(has(outcome.err, "logo.svg:1:30: <text>: note: <text> is not taken"));
    for (const char* name : {"out/logo.json", "out/logo_notes.txt", "out/logo-2.json",
                             "out/logo-2_notes.txt"}) // dropped again: nothing is replaced
        EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
    std::ifstream notes(folder / "out/logo_notes.txt");
    const std::string told{std::istreambuf_iterator<char>(notes), {}};
    EXPECT_TRUE(has(told, "logo.svg:1:30: <text>: note: <text> is not taken")) << told;
}

TEST(PlayCommand, RefusesABrokenModelWithItsPlace) {
    const ScratchFolder folder;
    write(folder / "bad.obj", "v 0 0 0\nf 1 2 3\n");
    write(folder / "script.txt", "0.1 end\n");
    const auto outcome =
        sinew({"play", "bad.obj", "--script", "script.txt"}, {.environment = {}, .folder = folder.path});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(begins(outcome.err, "bad.obj:2:1: error:"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(ExportCommand, HasNoTransparentJpeg) {
    const ScratchFolder folder;
    const auto outcome = sinew({"export", "pendulum", "-o", "a.jpg", "--at", "0", "--background", "none"},
                               {.environment = {}, .folder = folder.path});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(has(outcome.err, "a .jpg has no transparency"));
    EXPECT_EQ(folder.names().size(), 0U);
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
