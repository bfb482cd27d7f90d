#include "files/out/export_formats.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/play/game.h"

#include <fstream>

/// Files of other programs in the game: what is opened is made a scene, and what is recorded may be a model.
namespace sinew::play::SINEW_TEST_FILE {
namespace {

using games::Listening;

SceneLibrary exporting() {
    auto library = games::library;
    library.open_export = [](const std::filesystem::path& path, std::array<int, 2> size, double fps) {
        const auto* const format = files::export_format_of(path);
        const bool is_film = format && format->frames == files::FramesPerFile::all;
        return format && !format->is_painted && is_film == (fps > 0)
                   ? format->open({.path = path, .fps = fps, .size = size})
                   : nullptr;
    };
    return library;
}

TEST(ForeignFiles, AModelIsRecordedThroughEverySizeOfThePicture) {
    const ScratchFolder folder;
    Picture picture;
    Play play(exporting(), "rope");
    Listening listening(play);
    play.toggle_recording(folder / "rope.glb");
    for (const int width : {120, 200}) {
        play.resize(width, 80);
        for (int i = 0; i < 6; ++i) play.advance(1.0 / 60), play.draw(picture);
    }
    EXPECT_TRUE(play.recording()) << play.problem();
    EXPECT_EQ(folder.names().size(), 0U) << "nothing before it is complete";
    play.toggle_recording();
    EXPECT_EQ(listening.count("recorded"), 1U);
    EXPECT_EQ(sinew::text_of(folder / "rope.glb").substr(0, 4), "glTF");
    play.screenshot(folder / "now.obj");
    play.draw(picture);
    EXPECT_EQ(play.problem(), "");
    EXPECT_NE(sinew::text_of(folder / "now.obj").find("\nv "), std::string::npos);
}

TEST(ForeignFiles, AnExportThatCannotBeWrittenIsTold) {
    const ScratchFolder folder;
    std::ofstream(folder / "file") << "no folder";
    Play play(exporting(), "rope");
    play.screenshot(folder / "file/now.obj");
    Picture picture;
    play.draw(picture);
    EXPECT_NE(play.problem().find("cannot write"), std::string::npos) << play.problem();
}

TEST(ForeignFiles, OneThatIsOpenedBecomesAScene) {
    const ScratchFolder folder;
    auto library = exporting();
    library.convert = [&](const std::filesystem::path& file) -> Converted {
        if (file.extension() == ".png") return {{}, "it is damaged", ""};
        if (file.extension() == ".json") return {};
        std::ofstream(folder / "made.json") << R"({"sinew": 1, "figures": [{"prefab": "rope", "length": 2}]})";
        return {folder / "made.json", "", "imported: 1 figure"};
    };
    Play play(library, "rope");
    for (const char* name : {"a.png", "a.obj"}) std::ofstream(folder / name) << "x";
    play.open(folder / "a.png");
    EXPECT_EQ(play.problem(), "it is damaged");
    EXPECT_EQ(play.scene_name(), "rope");
    play.dismiss_problem();
    play.open(folder / "a.obj");
    EXPECT_EQ(play.problem(), "");
    EXPECT_EQ(play.scene_name(), folder / "made.json");
    EXPECT_EQ(play.message, "imported: 1 figure");
}

} // namespace
} // namespace sinew::play::SINEW_TEST_FILE
