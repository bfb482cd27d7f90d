#pragma once

#include "sinew/math/vec.h"

#include "files/in/json_file.h"

#include <memory>

namespace sinew::files {

/// A map of space: columns of a glTF matrix.
struct Affine3 {
    Vec3<double> x{{1, 0, 0}}, y{{0, 1, 0}}, z{{0, 0, 1}}, origin{};

    Vec3<double> vector(const Vec3<double>& p) const { return x * p[0] + y * p[1] + z * p[2]; }
    Vec3<double> operator()(const Vec3<double>& p) const { return vector(p) + origin; }
    Affine3 operator*(const Affine3& inner) const {
        return {vector(inner.x), vector(inner.y), vector(inner.z), (*this)(inner.origin)};
    }
    bool is_mirrored() const { return dot(cross(x, y), z) < 0; }
};

/// The JSON of a glTF 2.0 file and the numbers of its accessors; .gltf with buffers beside it or within, and .glb.
class GltfData {
  public:
    explicit GltfData(const ImportFile& file);
    const JsonNode& root() const { return *root_; }
    const std::string& text() const { return text_; }
    const std::vector<std::string>& buffers() const { return buffers_; }

    /// Numbers of an accessor of `components` each, one after the other; integers of "normalized" accessors become
    /// shares. Throws ImportError.
    std::vector<double> numbers(const JsonNode& accessor_index, std::string_view type, std::size_t components) const;
    std::vector<std::uint32_t> indices(const JsonNode& accessor_index, std::size_t max) const;

    /// Matrix of a node: its own, or translation, rotation and scale.
    static Affine3 matrix_of(const JsonNode& node);

  private:
    std::string text_; ///< the JSON
    std::unique_ptr<JsonFile> json_;
    std::unique_ptr<JsonNode> root_;
    std::vector<std::string> buffers_;

    void read_buffers(const ImportFile& file, std::string binary);
    std::string buffer_bytes(const ImportFile& file, const JsonNode& uri) const;
};

/// True for the beginning of a .glb file.
bool is_glb(std::string_view bytes);

} // namespace sinew::files
