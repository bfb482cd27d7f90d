#pragma once

#include "sinew/prefab/obj.h"

#include "files/in/import.h"
#include "files/in/names.h"
#include "files/in/notes.h"
#include "files/in/role.h"

namespace sinew::files {

/// A mesh of a file: metres, y upwards.
struct ImportedMesh {
    std::string name, place;
    MeshModel model;
    std::optional<Role> role{}; ///< by its name
    std::string color{};
};

/// A 3D scene of meshes, skeletons, a floor and a camera that sees them all.
class ModelScene {
  public:
    ModelScene(const ImportFile& file, const ImportOptions& options) : file_(file), options_(options) {}

    void add(ImportedMesh mesh);
    /// Adds a figure with particles of its own, which reach from `low` to `high`.
    void add(json::Object figure, const Vec3<double>& low, const Vec3<double>& high);

    Notes& notes() { return notes_; }
    /// Factor of lengths: that of the options, or 1 where everything has a size between 0.1 and 50 m, else such that it
    /// is 2 m. Known once all extents are.
    double scale() const;
    void include(const Vec3<double>& point);

    /// Throws ImportError where nothing was added.
    Imported finish();

  private:
    const ImportFile& file_;
    const ImportOptions& options_;
    Notes notes_;
    std::vector<ImportedMesh> meshes_;
    json::Array figures_, colliders_;
    json::Object looks_; ///< of colliders, by their names
    std::vector<SideFile> beside_;
    NewNames names_;
    Vec3<double> low_{}, high_{};
    bool is_empty_ = true;

    double longest_side() const;
    void build(ImportedMesh& mesh);
    void add_figure(const ImportedMesh& mesh, Role role, const std::string& file);
    json::Object view() const;
    bool needs_floor() const;
};

/// Faces of a model as a model of their own: points that they do not use are left out, and those at one place are one.
MeshModel part_of(const MeshModel& whole, const std::vector<std::size_t>& faces);

} // namespace sinew::files
