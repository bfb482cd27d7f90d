#include "tests/files/imported.h"

#include <gtest/gtest.h>

/// Files that Inkscape, Blender and Tiled wrote: tests/files/make_samples.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

std::string text_at(const files::Imported& imported, const std::string& pointer) {
    const auto value = at(imported, pointer);
    const auto* const text = value.as<std::string>();
    return text ? *text : "";
}

TEST(MadeSamples, LettersOfInkscapeAreFiguresWithTheirHoles) {
    const auto word = import_sample("made/word.svg");
    ASSERT_EQ(count_at(word, "/figures"), 3U);
    // "B" and "8" have two holes each: ways to the holes and back visit corners twice.
    for (const std::size_t letter : {1U, 2U}) {
        const auto figure = "/figures/" + std::to_string(letter);
        const auto listed = at(word, figure + "/particles");
        const auto* const particles = listed.as<json::Object>();
        ASSERT_TRUE(particles);
        EXPECT_EQ(count_at(word, figure + "/pieces/0/through"), particles->size() + 4) << letter;
    }
    EXPECT_EQ(text_at(word, "/figures/0/looks/inside/fill"), "#2a6f97");
}

TEST(MadeSamples, UnionsClonesAndLayersOfInkscapeAreTaken) {
    const auto gear = import_sample("made/gear.svg");
    ASSERT_EQ(count_at(gear, "/figures"), 2U); // the gear, and its clone
    EXPECT_EQ(text_at(gear, "/colliders/0/name"), "ground");
    const auto room = import_sample("made/room.svg");
    EXPECT_EQ(count_at(room, "/colliders"), 2U); // the layer "walls"
    ASSERT_EQ(count_at(room, "/figures"), 4U);
    EXPECT_NEAR(number_at(room, "/world/bounds/box/1/0"), 200 / 25.4 * 96, 0.01); // millimetres
    EXPECT_EQ(text_at(room, "/figures/1/name"), "rope");
}

TEST(MadeSamples, MeshesOfBlenderComeAlikeAsObjAndAsGltf) {
    const auto obj = import_sample("made/table.obj"), glb = import_sample("made/table.glb");
    for (const auto* const imported : {&obj, &glb}) {
        ASSERT_EQ(count_at(*imported, "/figures"), 1U);
        EXPECT_EQ(text_at(*imported, "/figures/0/prefab"), "mesh");
        EXPECT_EQ(text_at(*imported, "/colliders/0/shape"), "mesh");
        const auto opened = open_imported(*imported);
        ASSERT_TRUE(opened);
        EXPECT_EQ(std::visit([](const auto& world) { return world.particles.size(); }, opened->world), 100U);
    }
    EXPECT_NEAR(number_at(obj, "/figures/0/mass"), number_at(glb, "/figures/0/mass"), 1e-5);
    const auto drops = import_sample("made/drops.obj");
    for (const std::size_t i : {0U, 1U, 2U})
        EXPECT_EQ(text_at(drops, "/figures/" + std::to_string(i) + "/prefab"), "jelly");
}

TEST(MadeSamples, AnArmatureOfBlenderIsARagdollThatHasItsBones) {
    const auto puppet = import_sample("made/puppet.gltf");
    ASSERT_EQ(count_at(puppet, "/figures"), 1U);
    EXPECT_TRUE(has_note(puppet, "", "sinew export --model"));
    const auto text = json::to_text(puppet.scene);
    for (const char* name : {"hips", "spine", "upper_arm_L", "forearm_R", "thigh_L", "shin_R"})
        EXPECT_NE(text.find(name), std::string::npos) << name;
}

TEST(MadeSamples, MapsOfTiledHaveTheirSlopesChunksAndObjects) {
    const auto slopes = import_sample("made/slopes.tmj");
    EXPECT_EQ(count_at(slopes, "/figures"), 3U); // crate, jelly, rope
    EXPECT_TRUE(has_note(slopes, "", "pictures of tiles"));
    EXPECT_TRUE(has_note(slopes, "", "points, texts"));
    // Two of the map above: eight columns to the left of the origin, and eight to the right.
    EXPECT_EQ(count_at(import_sample("made/endless.tmj"), "/colliders"), 9U);
    const auto house = import_sample("made/house.tmj");
    EXPECT_TRUE(has_note(house, "", "imagelayer"));
    EXPECT_EQ(text_at(house, "/figures/0/name"), "chair_crate");
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
