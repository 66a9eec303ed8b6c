// Code that is compiled once a dimension, and the choice among it at run time. A build may name fewer dimensions than
// 2 to 8 (JAM_DIMENSIONS in CMake), which shortens the builds of developers; every entrance refuses the others
// (check_dim in core/limits.hpp).
#pragma once
#include <type_traits>
#include <utility>

#include "core/dimensions.hpp"  // written by CMake: JAM_DIMENSIONS as a list of numbers
#include "core/error.hpp"

namespace jam::inside {

template <int... Numbers>
struct Numbered {};
using CompiledDimensions = Numbered<JAM_DIMENSIONS>;

template <int... D>
constexpr bool has_number(Numbered<D...>, long long value) {
  return ((value == D) || ...);
}
constexpr bool is_compiled(long long dim) { return has_number(CompiledDimensions{}, dim); }

// f(std::integral_constant<int, D>{}) for the D of the list that `value` is.
template <class F, int First, int... Rest>
decltype(auto) with_number(Numbered<First, Rest...>, int value, F &&f) {
  if constexpr (sizeof...(Rest) > 0) {
    if (value != First) return with_number(Numbered<Rest...>{}, value, std::forward<F>(f));
  } else if (value != First) {
    fail(JAM_E_INTERNAL, "%d is no compiled dimension", value);
  }
  return f(std::integral_constant<int, First>{});
}

template <class F>
decltype(auto) with_dimension(int dim, F &&f) {
  return with_number(CompiledDimensions{}, dim, std::forward<F>(f));
}

}  // namespace jam::inside
