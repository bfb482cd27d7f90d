#include "sinew/scene/file_name.h"

#include "sinew/scene/text.h"

namespace sinew {
namespace {

bool leaves_its_folder(std::string_view name) {
    if (name.empty() || name.front() == '/' || name.find_first_of("\\:") != std::string_view::npos) return true;
    while (!name.empty()) {
        const auto step = name.substr(0, name.find('/'));
        if (step == "..") return true;
        name.remove_prefix(std::min(step.size() + 1, name.size()));
    }
    return false;
}

} // namespace

bool in_its_folder(std::string_view name, const std::string& place, std::string_view example, Document& document) {
    if (!leaves_its_folder(name)) return true;
    document.error(place, in_quotes(name) + " is not a file in the folder of the scene",
                   concat("a path from the scene's folder on, such as ", example, "; without .. in it"));
    return false;
}

} // namespace sinew
