# conan create packaging/conan --build=missing: builds from this tree.
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Sinew(ConanFile):
    name = "sinew"
    version = "0.2.0"
    license = "MIT"
    description = "A physics engine of Verlet points and constraints: ropes, cloth, ragdolls"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False]}
    default_options = {"shared": False}

    def export_sources(self):
        tree = os.path.join(self.recipe_folder, "..", "..")
        # Tried by tests/tools/recipes_test.sh.
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "packaging/*", "sinew/*", "player/*", "canvas/*", "files/*", "bindings/*", "tools/*",
                        "scenes/*"):
            copy(self, pattern, tree, self.export_sources_folder)

    def requirements(self):
        self.requires("nlohmann_json/[>=3.11]", visible=False)
        self.requires("xxhash/[>=0.8.1]", visible=False)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["SINEW_COMMAND"] = False
        toolchain.cache_variables["SINEW_SHARED"] = bool(self.options.shared)
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        self.cpp_info.set_property("cmake_find_mode", "none")  # the tree's own sinewConfig.cmake
        self.cpp_info.builddirs = ["lib/cmake/sinew"]
