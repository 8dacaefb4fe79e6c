# SPDX-License-Identifier: BSD-3-Clause
import os

from spack_repo.builtin.build_systems.cmake import CMakePackage
from spack_repo.builtin.build_systems.cuda import CudaPackage

from spack.package import *


class Gale(CMakePackage, CudaPackage):
    """Topological relations of large tetrahedral meshes, computed segment by segment and ahead of need, on CPUs and GPUs."""

    # The sources are those of the checkout that this recipe lies in.
    git = "file://" + os.path.abspath(os.path.join(os.path.dirname(__file__), *[os.pardir] * 5))

    license("BSD-3-Clause")

    test_requires_compiler = True

    version("main", branch="main")
    version("0.1.0", tag="v0.1.0")

    variant("serial", default=True, description="Kokkos' Serial backend")
    variant("openmp", default=False, description="Kokkos' OpenMP backend")
    variant("vtk", default=True, description="Read files, and compress those written, with what VTK brings")
    variant("mpi", default=False, description="Meshes that lie on several MPI ranks")
    variant("shared", default=True, description="Build shared libraries")

    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("kokkos@4.4:")
    depends_on("kokkos-kernels@4.4:")
    depends_on("vtk@9.1:", when="+vtk")
    depends_on("mpi", when="+mpi")
    depends_on("cli11")
    depends_on("nlohmann-json")
    depends_on("googletest", type="test")
    depends_on("python@3.9:", type="test")

    for package in ("kokkos", "kokkos-kernels"):
        depends_on(f"{package}+shared", when="+shared")
        for backend in ("serial", "openmp"):
            depends_on(f"{package}+{backend}", when=f"+{backend}")
        for arch in CudaPackage.cuda_arch_values:
            depends_on(f"{package}+cuda cuda_arch={arch}", when=f"+cuda cuda_arch={arch}")
    depends_on("kokkos+wrapper", when="+cuda %gcc")

    conflicts("cuda_arch=none", when="+cuda", msg="name the GPU: cuda_arch=90, for example")
    conflicts("~serial", when="~openmp", msg="Kokkos needs a host backend: +serial or +openmp")

    def cmake_args(self):
        args = [
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("GALE_ENABLE_VTK", "vtk"),
            self.define_from_variant("GALE_ENABLE_MPI", "mpi"),
            self.define("GALE_ENABLE_KOKKOS_KERNELS", True),
            self.define("GALE_ENABLE_EXAMPLES", self.run_tests),
            self.define("GALE_ENABLE_TESTS", self.run_tests),
            self.define(
                "GALE_REQUIRE_BACKENDS",
                [backend.upper() for backend in ("serial", "openmp", "cuda") if self.spec.satisfies(f"+{backend}")],
            ),
        ]
        if self.spec.satisfies("+cuda"):
            args.append(self.define("CMAKE_CXX_COMPILER", self["kokkos"].kokkos_cxx))
        return args

    @run_after("install")
    def keep_examples(self):
        cache_extra_test_sources(self, ["examples"])

    def test_examples(self):
        """build the examples against the installed GALE and run them"""
        compiler = self["kokkos"].kokkos_cxx if self.spec.satisfies("+cuda") else os.environ["CXX"]
        source = join_path(self.test_suite.current_test_cache_dir, "examples")
        with working_dir("build", create=True):
            cmake = which(self.spec["cmake"].prefix.bin.cmake, required=True)
            cmake(
                source,
                self.define("CMAKE_PREFIX_PATH", [self.prefix] + get_cmake_prefix_path(self)),
                self.define("CMAKE_CXX_COMPILER", compiler),
            )
            cmake("--build", ".")
            which("ctest", required=True)("--output-on-failure")
