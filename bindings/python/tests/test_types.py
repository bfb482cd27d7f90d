"""Docstrings and types."""

import doctest
import importlib
import inspect
import pkgutil
import subprocess
import sys
from pathlib import Path

import pytest

import sinew

package = Path(__file__).resolve().parents[1]
modules = [module.name for module in pkgutil.iter_modules(sinew.__path__) if not module.name.startswith("_")]


@pytest.mark.parametrize("name", modules)
def test_the_examples_of_docstrings_do_what_they_say(name):
    assert doctest.testmod(importlib.import_module(f"sinew.{name}")).failed == 0


@pytest.mark.parametrize("name", sinew.__all__)
def test_all_that_users_see_is_described(name):
    thing = getattr(sinew, name)
    assert inspect.getdoc(thing), name
    if inspect.isclass(thing):
        for member, value in vars(thing).items():
            if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                plain = member in ("name", "simulation", "id", "radius", "remove_constraint")
                assert plain or inspect.getdoc(value), f"{name}.{member}"


def test_types_are_consistent():
    pytest.importorskip("mypy")
    done = subprocess.run([sys.executable, "-m", "mypy", "--no-incremental", "--cache-dir=/dev/null", "sinew"], cwd=package,
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
