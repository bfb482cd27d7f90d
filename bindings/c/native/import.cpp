#include "files/in/import.h"

#include "sinew/scene/text.h"

#include "bindings/c/handles.h"
#include "bindings/c/native/sized.h"
#include "files/in/role.h"

#include <cmath>

/// Files of other programs as scenes, from memory and to memory.
using namespace sinew;
using namespace sinew::c;

namespace {

struct Import {
    std::string scene;
    files::Imported imported;
};

Handles<Import>& imports() {
    static Handles<Import> open;
    return open;
}

template <class Work> sinew_status with(sinew_import handle, const Work& work) {
    const auto* known = imports().find(handle.id);
    return known ? work(*known) : bad_handle();
}

sinew_status take_wishes(const sinew_import_spec& spec, files::ImportOptions& options) {
    for (const double number : {spec.error, spec.scale})
        if (!std::isfinite(number) || number < 0 || number > 1e6)
            return fail(SINEW_BAD_ARGUMENT, "error and scale are 0 to a million");
    if (spec.role) options.role = spec.role;
    if (!options.role.empty() && !files::role_called(options.role))
        return fail(SINEW_BAD_ARGUMENT, concat("there is no role ", in_quotes(options.role)));
    if (spec.error > 0) options.error = spec.error;
    if (spec.scale > 0) options.scale = spec.scale;
    return SINEW_OK;
}

sinew_status take_files(const sinew_import_spec& spec, files::ImportFile& file) {
    if (spec.file_count == 0) return SINEW_OK;
    if (!spec.file_names || !spec.file_bytes || !spec.file_sizes) return null_argument();
    for (std::uint32_t i = 0; i < spec.file_count; ++i) {
        if (!spec.file_names[i] || !spec.file_bytes[i]) return null_argument();
        const auto* const bytes = reinterpret_cast<const char*>(spec.file_bytes[i]);
        file.beside.push_back({spec.file_names[i], std::string(bytes, spec.file_sizes[i])});
    }
    return SINEW_OK;
}

/// The message as compilers write it: "logo.svg:12:3: message. Help."
std::string told(const files::ImportFile& file, const files::ImportError& error) {
    return concat(file.name, error.place.empty() ? "" : ":", error.place, ": ", error.message,
                  error.help.empty() ? "" : "; ", error.help);
}

} // namespace

extern "C" {

sinew_status sinew_import_open(const char* name, const uint8_t* bytes, size_t size, const sinew_import_spec* given,
                               sinew_import* handle) {
    if (!name || (!bytes && size > 0) || !handle) return null_argument();
    sinew_import_spec spec{};
    if (given)
        if (const auto status = take(given, spec)) return status;
    files::ImportOptions options;
    if (const auto status = take_wishes(spec, options)) return status;
    files::ImportFile file{.name = name, .title = files::title_of(name), .bytes = {}};
    if (size > 0) file.bytes.assign(reinterpret_cast<const char*>(bytes), size);
    if (const auto status = take_files(spec, file)) return status;
    auto made = std::make_unique<Import>();
    try {
        made->imported = files::import_file(file, options);
    } catch (const files::ImportError& error) {
        return fail(SINEW_BAD_ARGUMENT, told(file, error));
    }
    made->scene = json::to_text(made->imported.scene) + "\n";
    const auto id = imports().add(std::move(made));
    if (id == 0) return fail(SINEW_FULL, "too many open imports");
    handle->id = id;
    return SINEW_OK;
}

sinew_status sinew_import_scene(sinew_import handle, const char** scene) {
    if (!scene) return null_argument();
    return with(handle, [&](const Import& made) {
        *scene = made.scene.c_str();
        return SINEW_OK;
    });
}

sinew_status sinew_import_file(sinew_import handle, uint32_t index, const char** name, const uint8_t** bytes,
                               size_t* size) {
    if (!name || !bytes || !size) return null_argument();
    return with(handle, [&](const Import& made) {
        if (index >= made.imported.beside.size()) return fail(SINEW_NOT_FOUND, "there are fewer files");
        const auto& side = made.imported.beside[index];
        *name = side.name.c_str();
        *bytes = reinterpret_cast<const uint8_t*>(side.bytes.data());
        *size = side.bytes.size();
        return SINEW_OK;
    });
}

sinew_status sinew_import_note(sinew_import handle, uint32_t index, const char** place, const char** note) {
    if (!place || !note) return null_argument();
    return with(handle, [&](const Import& made) {
        if (index >= made.imported.notes.size()) return fail(SINEW_NOT_FOUND, "there are fewer notes");
        *place = made.imported.notes[index].place.c_str();
        *note = made.imported.notes[index].message.c_str();
        return SINEW_OK;
    });
}

sinew_status sinew_import_close(sinew_import handle) {
    return imports().remove(handle.id) ? SINEW_OK : bad_handle();
}

} // extern "C"
