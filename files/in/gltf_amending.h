#pragma once

#include "files/in/gltf_data.h"

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace sinew::files {

/// A glTF file to which an animation is added, as a .glb with all of its buffers and images within.
class AmendedGltf {
  public:
    /// Throws ImportError for images that are not beside the file.
    AmendedGltf(const GltfData& data, const ImportFile& file);

    /// Seconds of the keys of all channels.
    void set_times(const std::vector<float>& seconds);
    /// Animates "translation" (three numbers a key) or "rotation" (four) of a node.
    void animate(std::size_t node, const char* path, const std::vector<float>& numbers);
    /// Gives a node with a matrix a translation, rotation and scale: only those can be animated.
    void split_matrix(std::size_t node, const Vec3<double>& translation, const Vec<4, double>& rotation,
                      const Vec3<double>& scale);

    /// The file, with the animation before all others.
    std::string glb() &&;

  private:
    nlohmann::json root_;
    nlohmann::json animation_;
    std::string binary_;
    std::size_t times_ = 0; ///< accessor

    std::size_t add_view(std::string_view bytes);
    std::size_t add_accessor(std::span<const float> numbers, std::size_t components);
};

} // namespace sinew::files
