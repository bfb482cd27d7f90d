# The extension module of the Python package bindings/python: sinew/_core, on the C face and canvas/. The package is put
# together in python/ of the build: with that folder in PYTHONPATH it can be imported from the build tree.
set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Interpreter to build the package for")
set(PYTHON_EXECUTABLE ${Python_EXECUTABLE})
find_package(pybind11 REQUIRED)
sinew_sources(bindings/python/core)
pybind11_add_module(sinew_python NO_EXTRAS ${sources} ${painted_files} files/in/folder_file.cpp ${headers})
target_link_libraries(sinew_python PRIVATE sinew_face sinew_export sinew_import play canvas)
# Arrays show memory of the engine, and keep it: bindings/python/core/pinned_memory.h.
target_link_options(sinew_python PRIVATE -Wl,--wrap=_ZdlPv -Wl,--wrap=_ZdlPvm -Wl,--exclude-libs,ALL)
sinew_app(sinew_python)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/python/sinew)
set(package ${PROJECT_BINARY_DIR}/python/sinew)
set_target_properties(sinew_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${package})
# Python finds the module beside the other files.
file(GLOB modules CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/bindings/python/sinew
    ${PROJECT_SOURCE_DIR}/bindings/python/sinew/*)
foreach(name IN LISTS modules)
    if(NOT name STREQUAL "__pycache__")
        file(CREATE_LINK ${PROJECT_SOURCE_DIR}/bindings/python/sinew/${name} ${package}/${name} SYMBOLIC)
    endif()
endforeach()
