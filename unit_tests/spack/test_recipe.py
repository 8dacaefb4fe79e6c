"""The Spack recipe against the build that it drives: usage test_recipe.py SOURCE_DIR [unittest's arguments]

Spack itself isn't needed: its directives are replaced by ones that remember what they were told.
"""
import contextlib
import importlib.util
import re
import sys
import types
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1))
REPOSITORY = SOURCE / "spack" / "spack_repo" / "gale"

# What CMake calls it -> what Spack calls it.
PACKAGES = {
    "Kokkos": "kokkos",
    "KokkosKernels": "kokkos-kernels",
    "VTK": "vtk",
    "MPI": "mpi",
    "CLI11": "cli11",
    "nlohmann_json": "nlohmann-json",
    "GTest": "googletest",
    "Python3": "python",
}
BUILT_INTO_CMAKE = {"BUILD_SHARED_LIBS", "CMAKE_CXX_COMPILER", "CMAKE_PREFIX_PATH", "Kokkos_ROOT", "nanobind_DIR"}
BACKENDS = {"serial", "openmp", "cuda"}
CUDA_ARCHS = ("70", "90")


class Directives:
    """Stands for Spack's directives: calls[name] lists each call's (arguments, keywords)."""

    NAMES = ("version", "variant", "depends_on", "conflicts", "requires", "license", "maintainers")

    def __init__(self):
        self.calls = {name: [] for name in self.NAMES}

    def install(self):
        package = types.ModuleType("spack.package")
        for name in self.NAMES:
            setattr(package, name, lambda *args, _name=name, **keywords: self.calls[_name].append((args, keywords)))
        package.extends = lambda spec, **keywords: self.calls["depends_on"].append(((spec,), keywords))
        package.run_after = lambda phase: lambda function: function
        package.when = lambda condition: contextlib.nullcontext()
        package.python_platlib = "lib/python3/site-packages"
        build_systems = "spack_repo.builtin.build_systems"
        cmake = types.ModuleType(f"{build_systems}.cmake")
        cmake.CMakePackage = type("CMakePackage", (), {})
        cuda = types.ModuleType(f"{build_systems}.cuda")
        cuda.CudaPackage = type("CudaPackage", (), {"cuda_arch_values": CUDA_ARCHS})
        python = types.ModuleType(f"{build_systems}.python")
        python.PythonExtension = type("PythonExtension", (), {})
        parents = ["spack", "spack_repo", "spack_repo.builtin", build_systems]
        for module in [types.ModuleType(name) for name in parents] + [package, cmake, cuda, python]:
            sys.modules[module.__name__] = module

    def dependencies(self):
        """{(spec, condition)} of all depends_on."""
        return {(args[0], keywords.get("when")) for args, keywords in self.calls["depends_on"]}


class Spec:
    """Has the variants that are said; its packages are where they are asked for."""

    def __init__(self, variants):
        self.variants = variants

    def __getitem__(self, package):
        return types.SimpleNamespace(prefix=f"/opt/{package}", command=lambda *arguments, **_: f"/opt/{package}/answer\n")

    def satisfies(self, text):
        return self.variants[text[1:]] == (text[0] == "+")


def load_recipe():
    directives = Directives()
    directives.install()
    path = REPOSITORY / "packages" / "gale" / "package.py"
    module_spec = importlib.util.spec_from_file_location("gale_recipe", path)
    module = importlib.util.module_from_spec(module_spec)
    module_spec.loader.exec_module(module)
    return module.Gale, directives


def cmake_args(recipe, variants, run_tests):
    """What the recipe would pass to CMake, as {option: value}."""
    package = recipe()
    package.spec = Spec(variants)
    package.run_tests = run_tests
    package.define = lambda option, value: (option, value)
    package.define_from_variant = lambda option, variant: (option, variants[variant])
    recipe.__getitem__ = lambda self, name: types.SimpleNamespace(kokkos_cxx="nvcc_wrapper")
    return dict(package.cmake_args())


class Recipe(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recipe, cls.directives = load_recipe()
        cls.variants = {args[0]: keywords for args, keywords in cls.directives.calls["variant"]}
        cls.cmake = (SOURCE / "CMakeLists.txt").read_text()
        cls.options = set(re.findall(r"^option\((\w+)", cls.cmake, re.M))
        for part in (cls.cmake, (SOURCE / "bindings" / "python" / "CMakeLists.txt").read_text()):
            cls.options |= set(re.findall(r"^set\((\w+) [^)]* CACHE ", part, re.M))

    def all_variants(self, **changed):
        return {**dict.fromkeys(self.variants, False), "cuda": False, **changed}

    def test_repository_is_where_its_namespace_says(self):
        text = (REPOSITORY / "repo.yaml").read_text()
        self.assertEqual(re.search(r"^  namespace: (\w+)$", text, re.M).group(1), REPOSITORY.name)
        self.assertRegex(text, r"(?m)^  api: v2\.\d+$")

    def test_sources_are_this_checkout_where_it_is_one(self):
        found = getattr(self.recipe, "git", None)
        self.assertEqual(found, f"file://{SOURCE.resolve()}" if (SOURCE / ".git").exists() else None)

    def test_no_version_names_what_does_not_exist(self):
        self.assertEqual(self.directives.calls["version"], [(("main",), {"branch": "main"})])

    def test_variants(self):
        self.assertEqual(set(self.variants), {"serial", "openmp", "app", "kokkos_kernels", "mpi", "python", "vtk", "shared"})
        self.assertEqual({base.__name__ for base in self.recipe.__bases__}, {"CMakePackage", "CudaPackage", "PythonExtension"})

    def test_other_backends_of_kokkos_conflict(self):
        conflicts = {args[0] for args, _ in self.directives.calls["conflicts"]}
        self.assertLessEqual({"^kokkos+rocm", "^kokkos+sycl"}, conflicts)

    def test_what_is_installed_is_tested(self):
        tests = {name for name in dir(self.recipe) if name.startswith("test_") and callable(getattr(self.recipe, name))}
        self.assertEqual(tests, {"test_command", "test_examples", "test_python"})
        for name in tests:
            self.assertTrue(getattr(self.recipe, name).__doc__, name)  # Spack prints it

    def test_command_finds_what_the_recipe_expects(self):
        source = (REPOSITORY / "packages" / "gale" / "package.py").read_text()
        for kind, count in (("minima", 26), ("maxima", 39)):  # of grid:32, as the tests of algorithms have them
            self.assertIn(rf"{kind}\s+{count}", source)

    def test_options_exist(self):
        for options in (cmake_args(self.recipe, self.all_variants(), True),
                        cmake_args(self.recipe, self.all_variants(cuda=True, python=True), False)):
            self.assertEqual(set(options) - self.options - BUILT_INTO_CMAKE, set())

    def test_each_variant_changes_an_option(self):
        without = cmake_args(self.recipe, self.all_variants(), False)
        for variant in self.all_variants():
            changed = cmake_args(self.recipe, self.all_variants(**{variant: True}), False)
            with self.subTest(variant=variant):
                self.assertNotEqual(changed, without)
        self.assertTrue(cmake_args(self.recipe, self.all_variants(vtk=True), False)["GALE_ENABLE_VTK"])
        self.assertTrue(cmake_args(self.recipe, self.all_variants(mpi=True), False)["GALE_ENABLE_MPI"])
        self.assertTrue(cmake_args(self.recipe, self.all_variants(shared=True), False)["BUILD_SHARED_LIBS"])

    def test_tests_are_built_when_they_are_run(self):
        for run_tests in (False, True):
            self.assertIs(cmake_args(self.recipe, self.all_variants(), run_tests)["GALE_ENABLE_TESTS"], run_tests)

    def test_backends_are_forwarded_and_required(self):
        for package, condition in (("kokkos", ""), ("kokkos-kernels", "+kokkos_kernels")):
            for backend in BACKENDS - {"cuda"}:
                self.assertIn((f"{package}+{backend}", f"{condition}+{backend}"), self.directives.dependencies())
            for arch in CUDA_ARCHS:
                self.assertIn((f"{package}+cuda cuda_arch={arch}", f"{condition}+cuda cuda_arch={arch}"),
                              self.directives.dependencies())
        for backend in BACKENDS:
            options = cmake_args(self.recipe, self.all_variants(**{backend: True}), False)
            self.assertEqual(options["GALE_REQUIRE_BACKENDS"], [backend.upper()])

    def test_cuda_needs_an_architecture(self):
        conflicts = [(args[0], keywords.get("when")) for args, keywords in self.directives.calls["conflicts"]]
        self.assertIn(("cuda_arch=none", "+cuda"), conflicts)

    def test_depends_on_all_that_cmake_looks_for(self):
        text = self.cmake + (SOURCE / "cmake" / "gale-dependencies.cmake").read_text()
        wanted = set(re.findall(r"gale_find\((\w+) ", text)) - {"Threads", "OpenMP", "ParaView"}  # no variant has the plugin
        packages = {re.match(r"[\w-]+", spec).group(0) for spec, _ in self.directives.dependencies()}
        self.assertEqual({PACKAGES[name] for name in wanted} - packages, set())
        for name in ("googletest", "python"):
            kinds = [kw.get("type") for args, kw in self.directives.calls["depends_on"] if args[0].startswith(name)]
            self.assertIn("test", kinds)


if __name__ == "__main__":
    unittest.main()
