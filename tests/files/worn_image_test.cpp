#include "canvas/png.h"
#include "files/out/png_writer.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/files/export_scenes.h"
#include "tests/files/glb_file.h"

/// Images of figures in binary glTF.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

/// 20 x 10 pixels, no two alike: opaque on the left, then half and fully transparent.
Image sample() {
    Image image{20, 10, {}};
    for (std::uint32_t i = 0; i < 200; ++i)
        image.pixels.push_back(i % 20 < 16 ? 0xff000000U + 0x010204U * i : i % 20 < 18 ? 0x80404020U + i % 10 : 0);
    return image;
}

/// A session whose figure "x" wears the sample on the part that `look` names.
Session pictured(const std::string& figure) {
    auto document =
        load(R"({"sinew": 1, "solver": {"precision": "double"}, "figures": [)" + figure + "]}", "test.json");
    auto opened = open_scene(document, [](const std::string&, const Limits&) {
        return ReadImage{std::make_shared<const Image>(sample()), {}, {}};
    });
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}

std::string particles(const std::string& looks, const std::string& constraint) {
    return R"({"name": "x", "looks": {)" + looks +
           R"(}, "particles": {"a": {"at": [0, 1], "size": 0.2}, "b": {"at": [1, 1.2]}, "c": {"at": [1.1, 0]},
           "d": {"at": [-0.2, 0.1]}}, "constraints": [)" +
           constraint + "]}";
}

/// Faces of one frame that wear an image.
struct Worn {
    std::vector<Vec3<double>> points;
    std::vector<Vec2<double>> on_image;
};

Worn worn_by(const std::string& figure, const std::string& node, std::string* bytes = nullptr) {
    const ScratchFolder folder;
    export_frames<2>(pictured(figure), {.path = folder / "x.glb"}, 1);
    const GlbFile file(text_of(folder / "x.glb"));
    const auto& attributes = file.mesh_of(node)["primitives"][0]["attributes"];
    const auto points = file.numbers(attributes["POSITION"]), places = file.numbers(attributes["TEXCOORD_0"]);
    const auto middle = file.json["nodes"][file.node("x")].value("translation", std::vector<double>{0, 0, 0});
    Worn worn;
    for (std::size_t i = 0; 2 * i < places.size(); ++i) {
        worn.on_image.push_back({{double(places[2 * i]), double(places[2 * i + 1])}});
        Vec3<double> point{};
        for (std::size_t k = 0; k < 3; ++k) point[int(k)] = double(points[3 * i + k]) + middle[k];
        worn.points.push_back(point);
    }
    const auto& view = file.json["bufferViews"][file.json["images"][0]["bufferView"].get<std::size_t>()];
    if (bytes) *bytes = file.binary.substr(view["byteOffset"], view["byteLength"]);
    return worn;
}

/// The point that wears a place of the image: by the nearest vertex, which must be there.
Vec3<double> point_at(const Worn& worn, double u, double v) {
    for (std::size_t i = 0; i < worn.points.size(); ++i)
        if (norm(worn.on_image[i] - Vec2<double>{{u, v}}) < 1e-6) return worn.points[i];
    ADD_FAILURE() << "no vertex at " << u << ", " << v;
    return {};
}

void expect_at(const Worn& worn, double u, double v, double x, double y) {
    const auto p = point_at(worn, u, v);
    EXPECT_NEAR(p[0], x, 1e-5) << u << ", " << v; // floats of a metre, by way of pixels
    EXPECT_NEAR(p[1], y, 1e-5) << u << ", " << v;
}

const std::string image = R"("image": {"file": "i.png")";

TEST(WornImage, LiesBetweenTheCornersOfItsQuadrilateral) {
    const auto worn = worn_by(particles("\"inside\": {" + image + "}}", R"({"kind": "area", "name": "inside",
        "between": ["a", "b", "c", "d"]})"),
                              "x/inside");
    ASSERT_EQ(worn.points.size(), 25u);
    for (std::size_t i = 0; i < 25; ++i) {
        const auto [u, v] = worn.on_image[i].component;
        expect_at(worn, u, v, (u * 1) * (1 - v) + (-0.2 * (1 - u) + 1.1 * u) * v,
                  ((1 - u) * 1 + u * 1.2) * (1 - v) + 0.1 * (1 - u) * v);
    }
}

TEST(WornImage, LiesAlongALineAndUprightOnADot) {
    // 1 long, half as wide: its left is a, its top to the left of the way from a to e.
    const std::string line = R"({"name": "x", "looks": {"stick": {)" + image + R"(}}}, "particles":
        {"a": {"at": [0, 1]}, "e": {"at": [0, 0]}}, "constraints": [{"name": "stick", "between": ["a", "e"]}]})";
    const auto along = worn_by(line, "x/stick");
    expect_at(along, 0, 0, 0.25, 1);
    expect_at(along, 1, 0, 0.25, 0);
    expect_at(along, 1, 1, -0.25, 0);
    // As wide as the dot, with the image's proportions.
    const auto dot = worn_by(particles("\"a\": {" + image + "}}", ""), "x/a");
    expect_at(dot, 0, 0, -0.1, 1.05);
    expect_at(dot, 1, 1, 0.1, 0.95);
}

TEST(WornImage, RepeatsAlongTheRodsOfARope) {
    const auto worn = worn_by(R"({"prefab": "rope", "name": "x", "length": 1, "segments": 2, "at": [0, 0],
        "looks": {"rope": {"image": {"file": "i.png", "size": [0.24, 0.12]}}}})",
                              "x/rope_0");
    // 0.5 / 0.24 is nearest to 2; the round ends go on by their radius.
    for (std::size_t i = 0; i < worn.points.size(); ++i) {
        EXPECT_GE(worn.on_image[i][1], -1e-6);
        EXPECT_LE(worn.on_image[i][1], 1 + 1e-6);
        EXPECT_LE(absolute(worn.on_image[i][0] - 1), 1 + 2 * 0.06 / 0.5 + 1e-6);
    }
    EXPECT_EQ(worn.on_image.size(), worn.points.size());
}

TEST(WornImage, KeepsItsPixels) {
    std::string bytes;
    worn_by(particles("\"a\": {" + image + "}}", ""), "x/a", &bytes);
    const auto read = canvas::read_png(std::as_bytes(std::span(bytes)), "i.png", {});
    ASSERT_TRUE(read.image) << read.problem;
    const auto before = sample();
    ASSERT_EQ(read.image->pixels.size(), before.pixels.size());
    for (std::size_t i = 0; i < before.pixels.size(); ++i)
        for (const auto shift : {0U, 8U, 16U, 24U}) // a step of rounding where colours had an opacity
            EXPECT_NEAR(int(read.image->pixels[i] >> shift & 255U), int(before.pixels[i] >> shift & 255U), 1) << i;
}

TEST(StoredPng, HoldsMoreThanABlock) {
    Image image{200, 100, {}}; // 80 100 bytes of rows
    for (std::uint32_t i = 0; i < 20'000; ++i) image.pixels.push_back(0xff000000U + i);
    const auto bytes = files::png_of(image);
    const auto read = canvas::read_png(std::as_bytes(std::span(bytes)), "i.png", {});
    ASSERT_TRUE(read.image) << read.problem;
    EXPECT_EQ(read.image->pixels, image.pixels);
}

TEST(TraceFile, HasARowForEachParticleInEachFrame) {
    const ScratchFolder folder;
    const auto seen = export_frames<2>(falling(), {.path = folder / "t.csv", .figures = {"rope"}}, 3);
    const auto table = text_of(folder / "t.csv");
    EXPECT_TRUE(table.starts_with("time,name,x,y,vx,vy\n0,rope/")) << table;
    EXPECT_EQ(std::ranges::count(table, '\n'), 1 + 3 * 3);
    export_frames<2>(falling(), {.path = folder / "t.jsonl"}, 2);
    const auto lines = text_of(folder / "t.jsonl");
    EXPECT_EQ(std::ranges::count(lines, '\n'), 2 * 4);
    const auto row = nlohmann::json::parse(lines.substr(0, lines.find('\n')));
    EXPECT_EQ(float(row["position"][0]), seen[0][0][0]);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
