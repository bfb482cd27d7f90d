#include "sinew/session/session_snapshot.h"

#include "bindings/c/simulation.h"
#include "bindings/python/core/simulation.h"

#include <pybind11/stl.h>
#include <string_view>

/// Running states as bytes, and back.
namespace sinew::python {
namespace {

py::bytes plain(const std::string& text) {
    return {text.data(), text.size()};
}

py::bytes saved(Simulation& simulation, const std::string& from) {
    const Hold hold(simulation.mutex());
    std::vector<std::byte> bytes;
    auto status = SINEW_OK;
    {
        const py::gil_scoped_release others;
        status = c::read(simulation.handle(), [&](c::Simulation&, const Session& session) {
            bytes = save(session, from);
            return SINEW_OK;
        });
    }
    check(status);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Text of the scene in a snapshot, and the path of that scene's file; raises for any other bytes.
py::tuple scene_of_snapshot(const py::bytes& bytes) {
    const std::string_view view = bytes;
    std::string text, file;
    const auto note = [&](const std::string& scene, const std::string& from) {
        text = scene;
        file = from;
        return std::optional<Opened>();
    };
    SnapshotError error;
    session_of(std::as_bytes(std::span(view)), note, error);
    if (!error.what.empty()) raise(SINEW_BAD_ARGUMENT, error.text());
    return py::make_tuple(plain(text), plain(file));
}

SceneSource files_named(std::vector<std::pair<std::string, std::string>> images,
                        std::vector<std::pair<std::string, std::string>> models) {
    return {"", "snapshot", {}, std::move(images), std::move(models)};
}

} // namespace

void bind_saving(py::module_& module, py::class_<Simulation, std::shared_ptr<Simulation>>& type) {
    using Named = std::vector<std::pair<std::string, std::string>>;
    type.def("save", saved)
        .def("restore", [](Simulation& self, const py::bytes& bytes, Named images,
                           Named models) { self.restore(bytes, files_named(std::move(images), std::move(models))); })
        .def_static("load", [](const py::bytes& bytes, Named images, Named models) {
            return std::shared_ptr<Simulation>(
                Simulation::load(bytes, files_named(std::move(images), std::move(models))));
        });
    module.def("scene_of_snapshot", scene_of_snapshot);
}

} // namespace sinew::python
