"""Builds the extension module by CMake, in build-python/ of the source tree, and adds the catalogue of scenes.

Environment: SINEW_BUILD names another build folder, CMAKE_ARGS are further options of CMake. The module has the kernels of
all processors, as a wheel may go to another one, also where ./dev python has built those of this machine in that folder.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py

root = Path(__file__).resolve().parents[2]


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        folder = Path(os.environ.get("SINEW_BUILD", root / "build-python"))
        options = ["-G", "Ninja", "-D", "CMAKE_BUILD_TYPE=Release", "-D", "SINEW_PYTHON=ON", "-D", "SINEW_WINDOW=OFF",
                   "-D", "SINEW_KERNELS=one;sse2;avx2;avx512",
                   "-D", f"Python_EXECUTABLE={os.path.realpath(sys.executable)}", *shlex.split(os.environ.get("CMAKE_ARGS", ""))]
        if not (folder / "build.ninja").exists():
            options += ["-D", "CMAKE_UNITY_BUILD=ON", "-D", "CMAKE_UNITY_BUILD_BATCH_SIZE=16"]
        subprocess.run(["cmake", "-S", root, "-B", folder, *options], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "sinew_python"], check=True)
        module = next((folder / "python" / "sinew").glob("_core*.so"))
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(module, target)


class BuildWithScenes(build_py):
    """Adds the catalogue, and the engine for the browser where ./dev web has built it."""

    def run(self):
        super().run()
        if self.editable_mode:
            return
        package, web = Path(self.build_lib) / "sinew", root / "web" / "sinew"
        shutil.copytree(root / "scenes", package / "scenes", dirs_exist_ok=True)
        if (web / "sinew.wasm").exists():
            for file in [web / "sinew.wasm", *web.glob("*.js"), *web.glob("painters/*.js")]:
                target = package / "web" / file.relative_to(web)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file, target)


def version():
    return re.search(r'define SINEW_VERSION "(.*)"', (root / "sinew" / "version.h").read_text())[1]


setup(
    version=version(),
    packages=["sinew", "sinew.study"],
    package_data={"sinew": ["py.typed", "*.pyi", "player.html"]},
    ext_modules=[Extension("sinew._core", sources=[])],
    cmdclass={"build_ext": BuildByCMake, "build_py": BuildWithScenes},
    zip_safe=False,
)
