// Checks that the readers of all formats share. Errors name the file and the line.
#pragma once
#include "core/error.hpp"
#include "core/limits.hpp"
#include "io/files.hpp"
#include "io/text.hpp"

namespace jam {

// Runs a check of core/limits.hpp; its error gets the path and the line in front.
template <class Check>
void at_line(const LineReader &in, Check &&check) {
  try {
    check();
  } catch (const Error &e) {
    in.fail(e.code(), "%s", e.what());
  }
}

inline int take_dim(const LineReader &in, int64_t dim) {
  at_line(in, [&] { check_dim(dim); });
  return static_cast<int>(dim);
}

inline int64_t take_count(const LineReader &in, int64_t n) {
  at_line(in, [&] { check_n(n); });
  return n;
}

inline double positive(const LineReader &in, std::string_view word, const char *what) {
  const double x = parse_number(in, word);
  if (!(x > 0.0)) in.fail(JAM_E_ARGUMENT, "the %s is %g, it must be positive", what, x);
  return x;
}

inline double take_box(const LineReader &in, std::string_view word) {
  const double side = positive(in, word, "box side");
  at_line(in, [&] { check_box(side); });
  return side;
}

[[noreturn]] inline void ends_early(const LineReader &in, int64_t found, int64_t n) {
  in.fail(JAM_E_FORMAT, "the file ends after %lld of %lld spheres", static_cast<long long>(found),
          static_cast<long long>(n));
}

// read_lammps.cpp: data of atom_style sphere, behind its first line, which says nothing.
FileContent read_lammps(LineReader &in);

}  // namespace jam
