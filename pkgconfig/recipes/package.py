# Spack, repository format 2: packages/libjam/package.py
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Libjam(CMakePackage):
    """Jammed packings of hard spheres: event-driven molecular dynamics, the exact jamming point, analysis."""

    homepage = "https://github.com/libjam/libjam"
    url = "https://github.com/libjam/libjam/archive/refs/tags/v1.0.0.tar.gz"

    maintainers("libjam")

    license("MIT AND MPL-2.0")

    version("1.0.0", sha256="0000000000000000000000000000000000000000000000000000000000000000")

    variant("lapack", default=True, description="Full spectra by the LAPACK of Spack, else by libjam's own loops")
    variant("clp", default=True, description="Clp's simplex as check and fallback")
    variant("python", default=False, description="Python module")
    variant("fortran", default=False, description="Fortran module")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("fortran", type="build", when="+fortran")
    depends_on("cmake@3.22:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("eigen@3.4:", type="build")
    depends_on("spectra@1.0:", type="build")
    depends_on("zlib-api")
    depends_on("blas", when="+lapack")
    depends_on("lapack", when="+lapack")
    depends_on("openblas~ilp64", when="+lapack ^[virtuals=lapack] openblas")
    depends_on("clp", when="+clp")
    depends_on("swig@4:", type="build", when="+python")
    depends_on("swig@4:", type="build", when="+fortran")
    depends_on("python@3.10:", type=("build", "run"), when="+python")
    depends_on("py-numpy@1.20:", type=("build", "run"), when="+python")
    extends("python", when="+python")

    conflicts("%gcc@:9", msg="C++17 with std::to_chars of integers and floating point")

    def cmake_args(self):
        args = [
            self.define("JAM_USE_VORO", False),
            self.define("JAM_BUILD_TESTS", False),
            self.define("JAM_BUILD_EXAMPLES", False),
            self.define_from_variant("JAM_LAPACK", "lapack"),
            self.define_from_variant("JAM_CLP", "clp"),
            self.define_from_variant("JAM_BUILD_PYTHON", "python"),
            self.define_from_variant("JAM_BUILD_FORTRAN", "fortran"),
        ]
        if self.spec.satisfies("+lapack"):  # FindLAPACK would take one of the host
            args += [
                self.define("BLAS_LIBRARIES", self.spec["blas"].libs.joined(";")),
                self.define("LAPACK_LIBRARIES", self.spec["lapack"].libs.joined(";")),
            ]
        if self.spec.satisfies("+python"):
            args += [self.define("JAM_PYTHON", python.path), self.define("JAM_PYTHON_DIR", python_platlib)]
        return args
