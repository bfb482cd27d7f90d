#include "bindings/python/core/simulation.h"

#include <pybind11/stl.h>

/// The module sinew._core: the C face as plain functions. sinew/*.py makes the public package of it, and documents it.
namespace sinew::python {

PYBIND11_MODULE(_core, module) {
    module.attr("version") = sinew_version();
    module.attr("simd") = sinew_simd();
    py::class_<Simulation, std::shared_ptr<Simulation>> type(module, "Simulation");
    type.def(py::init([](std::string text, std::string name, std::vector<std::string> overrides,
                         std::vector<std::pair<std::string, std::string>> images,
                         std::vector<std::pair<std::string, std::string>> models) {
            return std::make_shared<Simulation>(SceneSource{std::move(text), std::move(name), std::move(overrides),
                                                            std::move(images), std::move(models)});
        }))
        .def("copy", [](Simulation& self) { return std::shared_ptr<Simulation>(self.copy()); })
        .def("close", &Simulation::close)
        .def("restart", &Simulation::restart)
        .def("step", &Simulation::step)
        .def("run_until", &Simulation::run_until);
    bind_reading(module, type);
    bind_saving(module, type);
    bind_search(type);
    bind_edit(type);
    bind_painting(module, type);
    bind_exporting(module);
    bind_batch(module);
}

} // namespace sinew::python
