#include "files/out/gltf_document.h"

#include "files/out/glb_bytes.h"
#include "files/out/joint_skin.h"
#include "files/out/png_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace sinew::files {
namespace {

using Json = nlohmann::json;

/// Numbers of the specification.
constexpr int vertex_data = 34962, index_data = 34963, float_type = 5126, unsigned_type = 5125;

static_assert(std::endian::native == std::endian::little, "glTF's numbers have the lowest byte first");

const char* type_of(int components) {
    if (components == 16) return "MAT4";
    constexpr std::array names = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    return names[std::size_t(components)];
}

/// Linear light of an sRGB channel (IEC 61966-2-1).
double linear(float channel) {
    const double c = double(channel);
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

int last_of(Json& list, Json item) {
    list.push_back(std::move(item));
    return int(list.size()) - 1;
}

} // namespace

GltfDocument::GltfDocument(double fps) : root_(std::make_unique<Json>()), fps_(fps) {
    auto& root = *root_;
    root["asset"] = {{"version", "2.0"}, {"generator", "Sinew"}};
    root["scene"] = 0;
    root["scenes"] = Json::array({{{"nodes", Json::array()}}});
    for (const auto* list : {"nodes", "meshes", "materials", "accessors", "bufferViews"}) root[list] = Json::array();
    root["animations"] = Json::array({{{"name", "motion"}, {"channels", Json::array()}, {"samplers", Json::array()}}});
}

GltfDocument::~GltfDocument() = default;

int GltfDocument::add_texture(const Image& image, bool repeats) {
    constexpr int repeat = 10497, clamp_to_edge = 33071;
    auto& root = *root_;
    const auto bytes = png_of(image);
    const int view = add_view(std::as_bytes(std::span(bytes)), 0);
    binary_.resize((binary_.size() + 3) / 4 * 4); // numbers begin at multiples of four
    const int source = last_of(root["images"], {{"bufferView", view}, {"mimeType", "image/png"}});
    const int sampler =
        last_of(root["samplers"], {{"wrapS", repeats ? repeat : clamp_to_edge}, {"wrapT", clamp_to_edge}});
    return last_of(root["textures"], {{"source", source}, {"sampler", sampler}});
}

int GltfDocument::add_material(const std::string& name, const Color& color, std::optional<int> texture) {
    Json material{{"name", name},
                  {"doubleSided", true},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {linear(color.red), linear(color.green), linear(color.blue), color.alpha}},
                    {"metallicFactor", 0},
                    {"roughnessFactor", 0.7}}}};
    if (color.alpha < 1) material["alphaMode"] = "BLEND";
    if (texture) {
        material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = *texture;
        material["alphaMode"] = "MASK";
    }
    return last_of((*root_)["materials"], std::move(material));
}

int GltfDocument::add_mesh(const std::string& name, const TriangleMesh& vertices, std::span<const Part> parts,
                           std::span<const Target> targets) {
    const Json attributes{{"POSITION", add_vectors(vertices.positions, true)},
                          {"NORMAL", add_vectors(vertices.normals, false)}};
    const auto has_texture = [](const Part& part) { return part.has_texture; };
    const int on_image = std::ranges::any_of(parts, has_texture) ? add_places(vertices.on_image) : -1;
    Json moved = Json::array();
    for (const auto& target : targets)
        moved.push_back(
            {{"POSITION", add_vectors(target.positions, true)}, {"NORMAL", add_vectors(target.normals, false)}});
    Json primitives = Json::array();
    for (const auto& part : parts) {
        Json primitive{{"attributes", attributes}, {"indices", add_indices(part.indices)}, {"material", part.material}};
        if (part.has_texture) primitive["attributes"]["TEXCOORD_0"] = on_image;
        if (!moved.empty()) primitive["targets"] = moved;
        primitives.push_back(std::move(primitive));
    }
    return last_of((*root_)["meshes"], {{"name", name}, {"primitives", std::move(primitives)}});
}

int GltfDocument::add_node(const std::string& name, int parent, int mesh) {
    Json node{{"name", name}};
    if (mesh >= 0) node["mesh"] = mesh;
    auto& nodes = (*root_)["nodes"];
    const int index = last_of(nodes, std::move(node));
    auto& above = parent < 0 ? (*root_)["scenes"][0]["nodes"] : nodes[std::size_t(parent)]["children"];
    above.push_back(index);
    return index;
}

void GltfDocument::place(int node, const Vec3<double>& translation, const Vec<4, double>& rotation,
                         const Vec3<double>& scale) {
    auto& json = (*root_)["nodes"][std::size_t(node)];
    json["translation"] = translation.component;
    json["rotation"] = rotation.component;
    json["scale"] = scale.component;
}

void GltfDocument::add_skin(int node, std::span<const int> joints, const JointSkin& skin) {
    auto& root = *root_;
    std::vector<float> inverses, weights;
    for (const auto& joint : skin.joints) {
        const auto& at = joint.translation[0];
        for (const double number :
             {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -at[0], -at[1], -at[2], 1.0})
            inverses.push_back(float(number));
    }
    std::vector<std::uint16_t> numbers;
    for (const auto& vertex : skin.vertices) {
        numbers.insert(numbers.end(), vertex.joints.begin(), vertex.joints.end());
        weights.insert(weights.end(), vertex.weights.begin(), vertex.weights.end());
    }
    auto& json = root["nodes"][std::size_t(node)];
    json["skin"] = last_of(root["skins"], {{"joints", std::vector<int>(joints.begin(), joints.end())},
                                           {"inverseBindMatrices", add_accessor(inverses, 16, 0, false)}});
    constexpr int short_type = 5123;
    const int places =
        last_of(root["accessors"], {{"bufferView", add_view(std::as_bytes(std::span(numbers)), vertex_data)},
                                    {"componentType", short_type},
                                    {"count", skin.vertices.size()},
                                    {"type", "VEC4"}});
    const int shares = add_accessor(weights, 4, vertex_data, false);
    for (auto& primitive : root["meshes"][json["mesh"].get<std::size_t>()]["primitives"])
        primitive["attributes"]["JOINTS_0"] = places, primitive["attributes"]["WEIGHTS_0"] = shares;
}

int GltfDocument::times_of(const Frames& keys) {
    const auto [found, is_new] = times_.try_emplace(keys, 0);
    if (is_new) {
        std::vector<float> seconds;
        for (const auto key : keys) seconds.push_back(float(double(key) / fps_));
        found->second = add_accessor(seconds, 1, 0, true);
    }
    return found->second;
}

void GltfDocument::add_channel(int node, const std::string& path, const Frames& keys, int output) {
    auto& animation = (*root_)["animations"][0];
    const int sampler = last_of(animation["samplers"], {{"input", times_of(keys)}, {"output", output}});
    animation["channels"].push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
}

void GltfDocument::animate(int node, const std::string& path, const Frames& keys, std::span<const float> numbers) {
    add_channel(node, path, keys, add_accessor(numbers, path == "rotation" ? 4 : 3, 0, false));
}

void GltfDocument::animate_targets(int node, const Frames& keys) {
    const std::size_t targets = keys.size() - 1;
    std::vector<std::uint32_t> places;
    for (std::size_t i = 0; i < targets; ++i) places.push_back(std::uint32_t((i + 1) * targets + i));
    const std::vector<float> ones(targets, 1.0F);
    const Json indices{{"bufferView", add_view(std::as_bytes(std::span(places)), 0)}, {"componentType", unsigned_type}};
    const Json values{{"bufferView", add_view(std::as_bytes(std::span(ones)), 0)}};
    const Json accessor{{"componentType", float_type},
                        {"count", keys.size() * targets},
                        {"type", "SCALAR"},
                        {"sparse", {{"count", targets}, {"indices", indices}, {"values", values}}}};
    add_channel(node, "weights", keys, last_of((*root_)["accessors"], accessor));
}

int GltfDocument::add_view(std::span<const std::byte> bytes, int target) {
    Json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    binary_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return last_of((*root_)["bufferViews"], std::move(view));
}

int GltfDocument::add_accessor(std::span<const float> numbers, int components, int target, bool bounds) {
    Json accessor{{"bufferView", add_view(std::as_bytes(numbers), target)},
                  {"componentType", float_type},
                  {"count", numbers.size() / std::size_t(components)},
                  {"type", type_of(components)}};
    if (bounds)
        for (int c = 0; c < components; ++c) {
            float low = numbers[std::size_t(c)], high = low;
            for (auto i = std::size_t(c); i < numbers.size(); i += std::size_t(components))
                low = std::min(low, numbers[i]), high = std::max(high, numbers[i]);
            accessor["min"].push_back(low), accessor["max"].push_back(high);
        }
    return last_of((*root_)["accessors"], std::move(accessor));
}

int GltfDocument::add_vectors(std::span<const Vec3<float>> vectors, bool bounds) {
    std::vector<float> numbers;
    for (const auto& v : vectors) numbers.insert(numbers.end(), v.component.begin(), v.component.end());
    return add_accessor(numbers, 3, vertex_data, bounds);
}

int GltfDocument::add_places(std::span<const Vec2<float>> on_image) {
    std::vector<float> numbers;
    for (const auto& place : on_image) numbers.insert(numbers.end(), place.component.begin(), place.component.end());
    return add_accessor(numbers, 2, vertex_data, false);
}

int GltfDocument::add_indices(std::span<const std::uint32_t> indices) {
    const Json accessor{{"bufferView", add_view(std::as_bytes(indices), index_data)},
                        {"componentType", unsigned_type},
                        {"count", indices.size()},
                        {"type", "SCALAR"}};
    return last_of((*root_)["accessors"], accessor);
}

std::string GltfDocument::glb() {
    auto& root = *root_;
    for (const auto* list : {"nodes", "meshes", "materials", "accessors", "bufferViews"})
        if (root[list].empty()) root.erase(list); // empty lists are not allowed
    if (root["animations"][0]["channels"].empty()) root.erase("animations");
    root["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    return glb_bytes(root.dump(-1, ' ', false, Json::error_handler_t::replace), binary_);
}

} // namespace sinew::files
