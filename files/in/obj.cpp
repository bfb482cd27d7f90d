#include "sinew/prefab/obj_line.h"
#include "sinew/scene/text.h"

#include "files/in/formats.h"
#include "files/in/model_scene.h"

#include <algorithm>
#include <array>

namespace sinew::files {
namespace {

struct ObjWord {
    std::string_view keyword, message;
};
constexpr std::array obj_words = {
    ObjWord{"vt", "texture coordinates are not taken"},  ObjWord{"vn", "normals are not taken"},
    ObjWord{"vp", "parameters of curves are not taken"}, ObjWord{"usemtl", "materials are not taken"},
    ObjWord{"mtllib", "materials are not taken"},        ObjWord{"l", "lines are not taken"},
    ObjWord{"p", "single points are not taken"},         ObjWord{"s", "smoothing is not taken"},
};

/// Objects of the file: a name, its line, and the numbers of its faces.
struct ObjPart {
    std::string name;
    std::size_t line = 0;
    std::vector<std::size_t> faces;
};

std::size_t words_of(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    std::size_t words = 0;
    for (auto begin = text.find_first_not_of(blanks); begin < text.size() && text[begin] != '#'; ++words) {
        const auto end = text.find_first_of(" \t\r#", begin);
        begin = end == text.npos ? end : text.find_first_not_of(blanks, end);
    }
    return words;
}

class ObjImport {
  public:
    ObjImport(const ImportFile& file, const ImportOptions& options) : file_(file), scene_(file, options) {}

    Imported read() {
        const ObjLimits limits{.points = ImportLimits::points, .corners = 8 * ImportLimits::points};
        auto read = read_obj(file_.bytes, limits);
        if (const auto* problem = std::get_if<ObjProblem>(&read))
            throw ImportError{problem->line > 0 ? concat(problem->line, ":1") : std::string(), problem->message};
        const auto& model = std::get<MeshModel>(read);
        scan();
        for (auto& part : parts_) {
            if (part.faces.empty()) continue;
            auto mesh = part_of(model, part.faces);
            const auto place = concat(part.line, ":1");
            if (mesh.faces() == 0) {
                scene_.notes().add(place, "its faces have no area: it is left out");
                continue;
            }
            scene_.add({part.name, place, std::move(mesh), role_in(part.name)});
        }
        return scene_.finish();
    }

  private:
    const ImportFile& file_;
    ModelScene scene_;
    std::vector<ObjPart> parts_;

    /// The lines that read_obj passes over.
    void scan() {
        parts_.push_back({file_.title, 1, {}});
        std::size_t line = 1, lines = 0, faces = 0;
        std::string joined;
        for (std::string_view rest = file_.bytes; !rest.empty(); line += lines)
            scan_line(take_obj_line(rest, joined, lines), line, faces);
    }
    void scan_line(std::string_view text, std::size_t line, std::size_t& faces) {
        constexpr std::string_view blanks = " \t\r";
        const auto begin = std::min(text.find_first_not_of(blanks), text.size());
        text.remove_prefix(begin);
        const auto keyword = text.substr(0, text.find_first_of(" \t\r#"));
        constexpr std::size_t place_and_weight = 5; // words of a point, with the keyword
        if (keyword == "v" && words_of(text) > place_and_weight)
            scene_.notes().count(concat(line, ":1"), "colours of points are not taken");
        if (keyword == "f") parts_.back().faces.push_back(faces++);
        if (keyword == "o" || keyword == "g") {
            auto name = text.substr(keyword.size());
            name.remove_prefix(std::min(name.find_first_not_of(blanks), name.size()));
            name = name.substr(0, name.find_last_not_of(blanks) + 1);
            parts_.push_back({std::string(name), line, {}});
        }
        const auto known = std::ranges::find(obj_words, keyword, &ObjWord::keyword);
        if (known != obj_words.end()) return scene_.notes().count(concat(line, ":1"), std::string(known->message));
        constexpr std::array<std::string_view, 5> taken = {"", "v", "f", "o", "g"};
        if (std::ranges::find(taken, keyword) == taken.end())
            scene_.notes().count(concat(line, ":1"), concat("lines of ", in_quotes(keyword), " are not taken"));
    }
};

bool is_never_sure(std::string_view) {
    return false;
}

} // namespace

const ImportFormat reader::obj{
    "OBJ", "obj", "meshes as cloth, jelly or colliders", is_never_sure,
    [](const ImportFile& file, const ImportOptions& options) { return ObjImport(file, options).read(); }};

} // namespace sinew::files
