"""The stubs name all that there is, with its arguments, and nothing else; everything is described."""

import ast
import inspect
import re

import aisle


def stubs(source):
    return ast.parse((source / "harness/python/aisle/__init__.pyi").read_text()).body


def public(thing):
    special = {"__getitem__", "__len__", "__float__"}
    return {name for name in vars(thing) if not name.startswith("_") or name in special}


def arguments(node):
    names = [a.arg for a in node.args.posonlyargs + node.args.args + node.args.kwonlyargs]
    return [name for name in names if name != "self"]


def told(function):
    """Arguments as the module itself lists them, in the first line of its help."""
    line = function.__doc__.splitlines()[0]
    inside = line[line.index("(") + 1 : line.rindex(") ->")]
    return [name for name in re.findall(r"(?:^|, )\*?(\w+): ", inside) if name != "self"]


def test_every_name_is_in_the_stubs(source):
    named = {node.name for node in stubs(source) if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert named == set(aisle.__all__)


def test_every_member_is_in_the_stubs(source):
    for node in stubs(source):
        if not isinstance(node, ast.ClassDef) or issubclass(getattr(aisle, node.name), Exception):
            continue
        members = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        # A sequence can be iterated over without a method that says so.
        assert members - {"__init__", "__iter__"} == public(getattr(aisle, node.name)), node.name


def test_arguments_are_the_same(source):
    seen = 0
    for node in stubs(source):
        if isinstance(node, ast.FunctionDef):
            assert arguments(node) == told(getattr(aisle, node.name)), node.name
            seen += 1
        if not isinstance(node, ast.ClassDef):
            continue
        for item in node.body:
            if isinstance(item, ast.FunctionDef) and not item.decorator_list:
                if item.name in ("__len__", "__iter__", "__float__"):
                    continue
                member = getattr(getattr(aisle, node.name), item.name)
                assert arguments(item) == told(member), f"{node.name}.{item.name}"
                seen += 1
    assert seen > 15


def test_everything_public_is_described():
    for name in aisle.__all__:
        thing = getattr(aisle, name)
        if inspect.isclass(thing) and issubclass(thing, Exception):
            continue
        assert thing.__doc__ and len(thing.__doc__.splitlines()) >= 1, name
