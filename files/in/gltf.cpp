#include "sinew/scene/text.h"

#include "files/in/formats.h"
#include "files/in/gltf_nodes.h"
#include "files/in/hex_color.h"
#include "files/in/model_scene.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sinew::files {
namespace {

constexpr std::array<std::string_view, 2> readable_extensions = {"KHR_mesh_quantization", "KHR_texture_transform"};

class GltfReader {
  public:
    GltfReader(const ImportFile& file, const ImportOptions& options)
        : file_(file), data_(file), nodes_(data_.root()), scene_(file, options) {}

    Imported read() {
        check_extensions();
        if (const auto scenes = root()["scenes"]; scenes.size() > 1)
            scene_.notes().count(scenes.place(), concat("of ", scenes.size(), " scenes one is taken"));
        for (std::size_t i = 0; i < nodes_.maps.size(); ++i)
            if (nodes_.maps[i]) add_node(root()["nodes"][i], *nodes_.maps[i]);
        for (const auto& skeleton : nodes_.skeletons)
            for (const auto& joint : skeleton.joints) scene_.include(joint.at);
        for (const auto& skeleton : nodes_.skeletons) add_ragdoll(skeleton.joints);
        for (const auto* const part : {"animations", "textures"})
            if (root()[part].size() > 0) scene_.notes().count(root()[part].place(), concat(part, " are not taken"));
        return scene_.finish();
    }

  private:
    const ImportFile& file_;
    GltfData data_;
    GltfNodes nodes_;
    ModelScene scene_;
    std::size_t points_ = 0;

    const JsonNode& root() const { return data_.root(); }

    void check_extensions() {
        const auto used = root()["extensionsUsed"];
        for (std::size_t i = 0; i < used.size(); ++i)
            if (const auto name = used[i].text(); std::ranges::count(readable_extensions, name) == 0)
                scene_.notes().count(used[i].place(), concat("the extension ", in_quotes(name), " is not taken"));
        const auto required = root()["extensionsRequired"];
        for (std::size_t i = 0; i < required.size(); ++i)
            if (const auto name = required[i].text();
                std::ranges::count(readable_extensions, name) == 0 && !name.starts_with("KHR_materials"))
                required[i].fail(
                    concat("the file cannot be read without ", printable(name), ": export it without compression"));
    }

    void add_node(const JsonNode& node, const Affine3& map) {
        if (node["camera"].exists()) scene_.notes().count(node.place(), "cameras are not taken");
        if (!node["mesh"].exists()) return;
        if (node["skin"].exists())
            return scene_.notes().count(node.place(), "a mesh with a skin comes as the ragdoll of its skeleton: "
                                                      "`sinew export --model` moves the mesh by it");
        const auto number = node["mesh"].index();
        const auto mesh = root()["meshes"][number];
        if (!mesh.object()) node["mesh"].fail(concat("there is no mesh ", number));
        if (mesh["weights"].exists()) scene_.notes().count(mesh.place(), "morph targets are not taken");
        const auto name = node["name"].exists() ? node["name"].text() : mesh["name"].text_or("mesh");
        ImportedMesh result{.name = name, .place = node.place(), .model = {}, .role = role_in(name)};
        if (!result.role) result.role = role_in(mesh["name"].text_or(""));
        MeshModel whole;
        for (std::size_t i = 0; i < mesh["primitives"].size(); ++i) {
            const auto primitive = mesh["primitives"][i];
            add_primitive(primitive, map, whole);
            const auto color = color_of(primitive);
            if (result.color.empty()) result.color = color;
            if (!color.empty() && color != result.color)
                scene_.notes().count(primitive.place(), "of the colours of a mesh the first is taken");
        }
        std::vector<std::size_t> faces(whole.faces());
        for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = i;
        result.model = part_of(whole, faces);
        if (result.model.faces() == 0)
            return scene_.notes().add(node.place(), "the mesh has no triangles: it is left out");
        scene_.add(std::move(result));
    }

    void add_primitive(const JsonNode& primitive, const Affine3& map, MeshModel& model) {
        const auto mode = primitive["mode"].exists() ? primitive["mode"].index() : 4;
        if (mode < 4 || mode > 6) return scene_.notes().count(primitive.place(), "points and lines are not taken");
        note_rest(primitive);
        const auto position = primitive["attributes"]["POSITION"];
        if (!position.exists()) return scene_.notes().count(primitive.place(), "a mesh without positions is not taken");
        const auto numbers = data_.numbers(position, "VEC3", 3);
        const auto count = numbers.size() / 3;
        if ((points_ += count) > ImportLimits::points)
            primitive.fail(concat("the meshes have more than ", ImportLimits::points, " points"));
        const auto first = std::uint32_t(model.points.size());
        for (std::size_t i = 0; i < count; ++i) {
            model.points.push_back(map({{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]}}));
            check_point(model.points.back(), primitive);
        }
        auto corners =
            primitive["indices"].exists() ? data_.indices(primitive["indices"], count) : std::vector<std::uint32_t>();
        if (!primitive["indices"].exists())
            for (std::uint32_t i = 0; i < count; ++i) corners.push_back(i);
        add_triangles(corners, mode, first, map.is_mirrored(), model);
    }

    /// Parts of a primitive that a scene has not.
    void note_rest(const JsonNode& primitive) {
        const auto attributes = primitive["attributes"];
        if (const auto* const members = attributes.object())
            for (const auto& member : *members)
                if (member.key != "POSITION")
                    scene_.notes().count(attributes[member.key].place(),
                                         concat(printable(member.key), " is not taken"));
        if (primitive["targets"].exists())
            scene_.notes().count(primitive["targets"].place(), "morph targets are not taken");
    }

    static void add_triangles(const std::vector<std::uint32_t>& corners, std::size_t mode, std::uint32_t first,
                              bool is_mirrored, MeshModel& model) {
        const bool is_list = mode == 4, is_fan = mode == 6;
        for (std::size_t i = 0; i + 2 < corners.size(); i += is_list ? 3 : 1) {
            std::array<std::uint32_t, 3> t{corners[is_fan ? 0 : i], corners[i + 1], corners[i + 2]};
            const bool is_odd = !is_list && !is_fan && i % 2 == 1;
            if (is_odd != is_mirrored) std::swap(t[1], t[2]);
            if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
            for (const auto corner : t) model.corners.push_back(first + corner);
            model.ends.push_back(std::uint32_t(model.corners.size()));
        }
    }

    /// Base colour of a material, from linear light to sRGB.
    std::string color_of(const JsonNode& primitive) const {
        if (!primitive["material"].exists()) return "";
        const auto factor =
            root()["materials"][primitive["material"].index()]["pbrMetallicRoughness"]["baseColorFactor"];
        if (!factor.exists()) return "";
        const auto linear = factor.numbers(4);
        std::array<int, 3> channels{};
        for (std::size_t i = 0; i < 3; ++i) {
            const double light = std::clamp(linear[i], 0.0, 1.0);
            const double shown =
                light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055; // IEC 61966-2-1
            channels[i] = int(std::clamp(shown, 0.0, 1.0) * 255 + 0.5);
        }
        return hex_color({channels[0], channels[1], channels[2]});
    }

    void add_ragdoll(const std::vector<SkeletonJoint>& skeleton) {
        auto figure = ragdoll_of(skeleton, file_.title, scene_.scale(), scene_.notes());
        if (figure.empty())
            return scene_.notes().add(skeleton.empty() ? "" : skeleton[0].place, "a skeleton of one joint is left out");
        auto low = skeleton[0].at, high = low;
        for (const auto& joint : skeleton)
            for (int i = 0; i < 3; ++i)
                low[i] = std::min(low[i], joint.at[i]), high[i] = std::max(high[i], joint.at[i]);
        scene_.add(std::move(figure), low, high);
    }
};

Imported read_gltf(const ImportFile& file, const ImportOptions& options) {
    return GltfReader(file, options).read();
}

bool has_gltf_asset(std::string_view bytes) {
    const auto begin = bytes.find_first_not_of(" \t\r\n");
    return begin != bytes.npos && bytes[begin] == '{' && bytes.find("\"asset\"") != bytes.npos &&
           bytes.find("\"buffers\"") != bytes.npos;
}

} // namespace

const ImportFormat reader::glb{"binary glTF", "glb", "meshes as cloth, jelly or colliders; skeletons as ragdolls",
                               is_glb, read_gltf};
const ImportFormat reader::gltf{"glTF", "gltf", "the same, as text with its buffers beside it or within",
                                has_gltf_asset, read_gltf};

} // namespace sinew::files
