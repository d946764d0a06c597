# SPDX-License-Identifier: GPL-3.0-or-later
"""The type stubs say what the module has: the same names, and of functions the same parameters."""

import ast
import inspect
from pathlib import Path

import plekton
import pytest

STUB = ast.parse((Path(plekton.__file__).parent / "__init__.pyi").read_text())


def named(body):
    """Functions (with all overloads), classes and attributes of a body by their names."""
    found = {}
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = node
    return found


TOP = named(STUB.body)
CLASSES = sorted(name for name, node in TOP.items() if isinstance(node, ast.ClassDef) and not name.startswith("_"))


def parameters(arguments):
    """Name, kind and whether there is a default, of each parameter but self."""
    plain = [*arguments.posonlyargs, *arguments.args]
    without = len(plain) - len(arguments.defaults)
    rows = [(argument.arg, "plain", i >= without) for i, argument in enumerate(plain)]
    rows += [
        (argument.arg, "by name", default is not None)
        for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults)
    ]
    return [row for row in rows if row[0] != "self"]


def real_parameters(function):
    """The same of the module: of a function of C++ from the first line of its documentation."""
    if inspect.isfunction(function):
        kinds = {inspect.Parameter.POSITIONAL_OR_KEYWORD: "plain", inspect.Parameter.KEYWORD_ONLY: "by name"}
        return [
            (p.name, kinds[p.kind], p.default is not p.empty)
            for p in inspect.signature(function).parameters.values()
            if p.name != "self"
        ]
    line = function.__doc__.splitlines()[0]
    return parameters(ast.parse(f"def {line}: ...").body[0].args)


def is_property(node):
    return any(getattr(decorator, "id", "") == "property" for decorator in node.decorator_list)


def members(of_class):
    """Public members of a class itself; what it inherits is its base's."""
    special = ("__init__", "__len__", "__getitem__", "__iter__")
    return {name: value for name, value in vars(of_class).items() if not name.startswith("_") or name in special}


def test_the_stub_has_the_names_of_the_module():
    public = {name for name in TOP if not name.startswith("_")}

    assert public == set(plekton.__all__)
    assert "__version__" in TOP and plekton.__version__
    assert not [name for name in plekton.__all__ if not hasattr(plekton, name)]


@pytest.mark.parametrize("name", sorted(n for n, node in TOP.items() if isinstance(node, ast.FunctionDef)))
def test_functions_have_the_parameters_of_the_stub(name):
    assert parameters(TOP[name].args) == real_parameters(getattr(plekton, name))


@pytest.mark.parametrize("name", CLASSES)
def test_classes_have_the_members_of_the_stub(name):
    real = members(getattr(plekton, name))
    stub = named(TOP[name].body)
    attributes = {key for key, node in stub.items() if isinstance(node, ast.AnnAssign)}

    if issubclass(getattr(plekton, name), (plekton.Error, tuple)):
        return  # made by other means: attributes of single errors, fields of a tuple
    # Attributes are set in __init__; whatever else there is stands in both.
    private = {"__init__"} if "__init__" not in stub else set()
    assert set(stub) - attributes == set(real) - private
    for member, node in stub.items():
        if member in attributes:
            continue
        if is_property(node):
            assert isinstance(real[member], property), member
        else:
            assert parameters(node.args) == real_parameters(real[member]), member


@pytest.mark.parametrize("name", CLASSES)
def test_bases_are_those_of_the_stub(name):
    bases = {getattr(base, "id", None) or base.value.id for base in TOP[name].bases} - {"NamedTuple"}
    real = {base.__name__ for base in getattr(plekton, name).__bases__} - {"pybind11_object", "object", "tuple"}

    assert bases == real


def test_everything_public_is_documented():
    for name in plekton.__all__:
        value = getattr(plekton, name)
        assert value.__doc__, name
        if not inspect.isclass(value) or issubclass(value, tuple):
            continue
        for member, function in members(value).items():
            text = (function.__doc__ or "").strip().split("\n\n", 1)
            is_bound = not member.startswith("_") and "->" in text[0]
            assert not is_bound or len(text) > 1, f"{name}.{member} has a signature alone"
            assert member.startswith("_") or text[0], f"{name}.{member}"
