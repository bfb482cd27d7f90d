#include "files/in/gltf_amending.h"

#include "files/in/neighbor.h"
#include "files/out/glb_bytes.h"

#include <algorithm>

namespace sinew::files {
namespace {

using Json = nlohmann::json;

void align(std::string& bytes) {
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
}

std::string image_type(std::string_view bytes) {
    return bytes.starts_with("\x89PNG") ? "image/png" : "image/jpeg"; // glTF 2.0 has these two
}

} // namespace

AmendedGltf::AmendedGltf(const GltfData& data, const ImportFile& file)
    : root_(Json::parse(data.text())), animation_{{"name", "sinew"},
                                                  {"channels", Json::array()},
                                                  {"samplers", Json::array()}} {
    std::vector<std::size_t> begins;
    for (const auto& bytes : data.buffers()) {
        align(binary_);
        begins.push_back(binary_.size());
        binary_ += bytes;
    }
    for (auto& view : root_["bufferViews"]) {
        view["byteOffset"] = view.value("byteOffset", std::size_t(0)) + begins.at(view.value("buffer", std::size_t(0)));
        view["buffer"] = 0;
    }
    const auto images = data.root()["images"];
    for (std::size_t i = 0; i < images.size(); ++i) {
        const auto uri = images[i]["uri"];
        if (!uri.exists() || uri.text().starts_with("data:")) continue;
        const auto bytes = bytes_beside(file, uri.text(), uri.place());
        auto& image = root_["images"][i];
        image.erase("uri");
        image["mimeType"] = image_type(bytes);
        image["bufferView"] = add_view(bytes);
    }
}

std::size_t AmendedGltf::add_view(std::string_view bytes) {
    align(binary_);
    auto& views = root_["bufferViews"];
    views.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
    binary_ += bytes;
    return views.size() - 1;
}

std::size_t AmendedGltf::add_accessor(std::span<const float> numbers, std::size_t components) {
    constexpr std::array types = {"", "SCALAR", "", "VEC3", "VEC4"};
    const auto bytes = std::as_bytes(numbers);
    const auto view = add_view({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    auto& accessors = root_["accessors"];
    accessors.push_back({{"bufferView", view},
                         {"componentType", 5126}, // float
                         {"count", numbers.size() / components},
                         {"type", types.at(components)}});
    return accessors.size() - 1;
}

void AmendedGltf::set_times(const std::vector<float>& seconds) {
    times_ = add_accessor(seconds, 1);
    auto& accessor = root_["accessors"][times_];
    accessor["min"] = {seconds.front()}, accessor["max"] = {seconds.back()};
}

void AmendedGltf::animate(std::size_t node, const char* path, const std::vector<float>& numbers) {
    const bool is_rotation = std::string_view(path) == "rotation";
    const auto output = add_accessor(numbers, is_rotation ? 4 : 3);
    auto& samplers = animation_["samplers"];
    animation_["channels"].push_back({{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers.push_back({{"input", times_}, {"output", output}});
}

void AmendedGltf::split_matrix(std::size_t node, const Vec3<double>& translation, const Vec<4, double>& rotation,
                               const Vec3<double>& scale) {
    auto& json = root_["nodes"][node];
    if (json.erase("matrix") == 0) return;
    json["translation"] = translation.component;
    json["rotation"] = rotation.component;
    json["scale"] = scale.component;
}

std::string AmendedGltf::glb() && {
    auto& animations = root_["animations"];
    if (!animations.is_array()) animations = Json::array();
    animations.insert(animations.begin(), std::move(animation_));
    align(binary_);
    root_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    return glb_bytes(root_.dump(-1, ' ', false, Json::error_handler_t::replace), binary_);
}

} // namespace sinew::files
