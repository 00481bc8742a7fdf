# SPDX-License-Identifier: GPL-3.0-or-later
"""The type stubs say what the module has: every name, every parameter and default, nothing else."""
import ast
import inspect
import os
import pathlib
import re
import unittest

import trueflank
from trueflank import _core

STUBS = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"]) / "python/trueflank/_core.pyi"


def stub_parameters(function):
    """[(name, default or None)], as the stub writes them."""
    names = [a.arg for a in function.args.args]
    defaults = [None] * (len(names) - len(function.args.defaults)) + [
        ast.literal_eval(d) if not (isinstance(d, ast.Constant) and d.value is None) else "None"
        for d in function.args.defaults]
    return [(n, d) for n, d in zip(names, defaults) if n != "self"]


def real_parameters(function):
    """The same from the signature that pybind11 puts first in the docstring."""
    signature = re.match(r"\w+\((.*)\) -> ", function.__doc__, re.DOTALL)[1]
    tree = ast.parse(re.sub(r"<[^>]*>", "None", f"def f({signature}): ...").replace(".. .", "..."))
    return stub_parameters(tree.body[0])


def public(names):
    return {n for n in names if not n.startswith("_") or n in ("__init__", "__version__")}


class Stubs(unittest.TestCase):
    def setUp(self):
        self.tree = ast.parse(STUBS.read_text())
        self.classes = {n.name: n for n in self.tree.body if isinstance(n, ast.ClassDef)}
        self.functions = {n.name: n for n in self.tree.body if isinstance(n, ast.FunctionDef)}

    def test_module_has_the_same_names(self):
        variables = {n.target.id for n in self.tree.body if isinstance(n, ast.AnnAssign)}
        self.assertEqual(public(set(self.classes) | set(self.functions) | variables), public(dir(_core)))

    def test_functions_have_the_same_parameters(self):
        for name, stub in self.functions.items():
            self.assertEqual(stub_parameters(stub), real_parameters(getattr(_core, name)), name)

    def test_classes_have_the_same_members(self):
        for name, stub in self.classes.items():
            real = getattr(_core, name)
            stubs = {m.name: m for m in stub.body if isinstance(m, ast.FunctionDef)}
            members = {m for m in vars(real) if not m.startswith("_")}
            self.assertEqual({m for m in stubs if m != "__init__"}, members, name)
            for member, function in stubs.items():
                if member == "__init__":
                    self.assertEqual(stub_parameters(function), real_parameters(real.__init__), name)
                    continue
                decorators = {ast.unparse(d) for d in function.decorator_list}
                is_property = isinstance(inspect.getattr_static(real, member), property)
                self.assertEqual("property" in decorators, is_property, f"{name}.{member}")
                if not is_property:
                    self.assertEqual(stub_parameters(function), real_parameters(getattr(real, member)),
                                     f"{name}.{member}")

    def test_everything_has_a_docstring(self):
        for name in self.functions:
            self.assertRegex(getattr(_core, name).__doc__, r"\n\n\w", name)
        for name in self.classes:
            real = getattr(_core, name)
            self.assertTrue(real.__doc__, name)
            for member in vars(real):
                if not member.startswith("_"):
                    doc = getattr(real, member).__doc__
                    self.assertGreater(len(doc.strip().splitlines()[-1]), 8, f"{name}.{member}")

    def test_package_shows_all_of_it(self):
        self.assertEqual(set(trueflank.__all__) - {"InputError", "Problem", "SystemFailure", "TrueflankError"},
                         public(dir(_core)))
        for name in trueflank.__all__:
            self.assertTrue(hasattr(trueflank, name), name)


if __name__ == "__main__":
    unittest.main(verbosity=1)
