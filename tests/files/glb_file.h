#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// A reader of .glb files that is no part of the engine.
namespace sinew::test {

/// A .glb: its JSON, and numbers of its accessors.
struct GlbFile {
    using Json = nlohmann::json;
    using Numbers = std::vector<float>;

    explicit GlbFile(const std::string& bytes) {
        EXPECT_EQ(bytes.substr(0, 4), "glTF");
        EXPECT_EQ(word(bytes, 4), 2u);
        EXPECT_EQ(word(bytes, 8), bytes.size());
        const std::size_t length = word(bytes, 12);
        json = Json::parse(bytes.substr(20, length));
        binary = bytes.substr(28 + length);
        EXPECT_EQ(json["buffers"][0]["byteLength"], binary.size());
    }

    /// Numbers of an accessor, which may be sparse.
    Numbers numbers(const Json& index) const {
        const auto& accessor = json["accessors"][index.get<std::size_t>()];
        if (accessor.contains("bufferView")) return view<float>(accessor["bufferView"]);
        Numbers all(accessor["count"].get<std::size_t>());
        const auto places = view<std::uint32_t>(accessor["sparse"]["indices"]["bufferView"]);
        const auto values = view<float>(accessor["sparse"]["values"]["bufferView"]);
        for (std::size_t i = 0; i < places.size(); ++i) all.at(places[i]) = values[i];
        return all;
    }

    std::size_t node(const std::string& name) const {
        for (std::size_t i = 0; i < json["nodes"].size(); ++i)
            if (json["nodes"][i]["name"] == name) return i;
        ADD_FAILURE() << "no node " << name;
        return 0;
    }
    const Json& mesh_of(const std::string& name) const {
        return json["meshes"][json["nodes"][node(name)]["mesh"].get<std::size_t>()];
    }

    /// Keys of a node's animated path: seconds, and as many numbers for each; none if it is not animated.
    struct Curve {
        Numbers seconds, numbers;

        /// The numbers at a second, interpolated (quaternions are not normalized).
        Numbers at(float second) const {
            const std::size_t count = numbers.size() / seconds.size();
            const auto next = std::upper_bound(seconds.begin(), seconds.end(), second) - seconds.begin();
            const auto b = std::min(std::size_t(next), seconds.size() - 1), a = b == 0 ? 0 : b - 1;
            const float share = a == b ? 0 : std::clamp((second - seconds[a]) / (seconds[b] - seconds[a]), 0.0F, 1.0F);
            Numbers all(count);
            for (std::size_t k = 0; k < count; ++k)
                all[k] = numbers[count * a + k] * (1 - share) + numbers[count * b + k] * share;
            return all;
        }
    };
    Curve curve(const std::string& name, const std::string& path) const {
        const auto& animation = json["animations"][0];
        for (const auto& channel : animation["channels"])
            if (channel["target"]["node"] == node(name) && channel["target"]["path"] == path) {
                const auto& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
                return {numbers(sampler["input"]), numbers(sampler["output"])};
            }
        return {};
    }

    Json json;
    std::string binary;

  private:
    static std::uint32_t word(const std::string& bytes, std::size_t at) {
        std::uint32_t number = 0;
        std::memcpy(&number, bytes.data() + at, sizeof number);
        return number;
    }
    template <class Number> std::vector<Number> view(const Json& index) const {
        const auto& known = json["bufferViews"][index.get<std::size_t>()];
        std::vector<Number> all(known["byteLength"].get<std::size_t>() / sizeof(Number));
        std::memcpy(all.data(), binary.data() + known["byteOffset"].get<std::size_t>(), sizeof(Number) * all.size());
        return all;
    }
};

} // namespace sinew::test
