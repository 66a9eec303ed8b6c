# BinaryBuilder, for Yggdrasil: julia build_tarballs.jl --verbose. Jamming.jl takes its library from libjam_jll.
using BinaryBuilder

name = "libjam"
version = v"1.0.0"
sources = [
    ArchiveSource("https://github.com/libjam/libjam/archive/refs/tags/v$(version).tar.gz",
                  "0000000000000000000000000000000000000000000000000000000000000000"),
    ArchiveSource("https://github.com/yixuan/spectra/archive/refs/tags/v1.0.1.tar.gz",
                  "0000000000000000000000000000000000000000000000000000000000000000"),
]
script = raw"""
cd ${WORKSPACE}/srcdir/libjam-*
cmake -B build -G Ninja \
    -DCMAKE_INSTALL_PREFIX=${prefix} -DCMAKE_TOOLCHAIN_FILE=${CMAKE_TARGET_TOOLCHAIN} -DCMAKE_BUILD_TYPE=Release \
    -DJAM_LAPACK=OFF -DJAM_CLP=OFF -DJAM_USE_VORO=OFF -DJAM_BUILD_CLI=OFF -DJAM_BUILD_TESTS=OFF \
    -DJAM_BUILD_EXAMPLES=OFF -DSPECTRA_INCLUDE=$(echo ${WORKSPACE}/srcdir/spectra-*/include)
cmake --build build --parallel ${nproc}
cmake --install build
install_license LICENSE pkgconfig/LINKED.md
"""
# The library takes std::string from the compiler's C++ library.
platforms = expand_cxxstring_abis([
    Platform("x86_64", "linux"; libc = "glibc"),
    Platform("aarch64", "linux"; libc = "glibc"),
])
products = [LibraryProduct("libjam", :libjam)]
dependencies = [
    Dependency("Zlib_jll"),
    BuildDependency("Eigen_jll"),
]
build_tarballs(ARGS, name, version, sources, script, platforms, products, dependencies;
               julia_compat = "1.6", preferred_gcc_version = v"11")
