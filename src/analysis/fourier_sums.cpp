#include "analysis/structure.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/tuning.hpp"
#include "core/call_scope.hpp"
#include "core/math.hpp"

namespace jam::inside {
namespace {

using Complex = std::complex<double>;

// Plain: the one of the library looks for infinities.
Complex times(const Complex &a, const Complex &b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
Complex on_circle(size_t k, size_t n) {
  const double turns = static_cast<double>(k % n) / static_cast<double>(n);
  return {math::cos_of_turns(turns), math::cos_of_turns(turns - 0.25)};
}

// sum_k x_k exp(2 pi i m k / n) for n = 2^a 3^b 5^c, by Cooley and Tukey.
class Transform {
 public:
  explicit Transform(size_t n) : root_(n), out_(n) {
    for (size_t k = 0; k < n; ++k) root_[k] = on_circle(k, n);
  }
  // Element m of the result is [m].
  const std::vector<Complex> &run(const std::vector<Complex> &in) {
    step(in.data(), 1, out_.data(), root_.size());
    return out_;
  }

 private:
  void step(const Complex *in, size_t stride, Complex *out, size_t n) {
    if (n == 1) {
      *out = *in;
      return;
    }
    const size_t radix = n % 4 == 0 ? 4 : n % 2 == 0 ? 2 : n % 3 == 0 ? 3 : 5, part = n / radix;
    for (size_t q = 0; q < radix; ++q) step(in + q * stride, stride * radix, out + q * part, part);
    for (size_t k = 0; k < part; ++k) {
      Complex x[5];
      for (size_t q = 0; q < radix; ++q) x[q] = times(out[q * part + k], root_[q * k * stride]);
      if (radix == 2) {
        out[k] = x[0] + x[1], out[k + part] = x[0] - x[1];
      } else if (radix == 4) {
        const Complex a = x[0] + x[2], b = x[0] - x[2], c = x[1] + x[3],
                      d{x[3].imag() - x[1].imag(), x[1].real() - x[3].real()};
        out[k] = a + c, out[k + part] = b + d, out[k + 2 * part] = a - c, out[k + 3 * part] = b - d;
      } else {
        for (size_t p = 0; p < radix; ++p) {
          Complex sum = x[0];
          for (size_t q = 1; q < radix; ++q) sum += times(x[q], root_[p * q % radix * part * stride]);
          out[p * part + k] = sum;
        }
      }
    }
  }
  std::vector<Complex> root_, out_;
};

size_t grid_side(int most) {
  if (most == 0) return 1;
  auto n = static_cast<size_t>(
      std::max(std::ceil(FourierTuning::oversampling * (2 * most + 1)), static_cast<double>(FourierTuning::width + 2)));
  const auto is_smooth = [](size_t k) {
    for (const size_t prime : {2, 3, 5})
      while (k % prime == 0) k /= prime;
    return k == 1;
  };
  while (!is_smooth(n)) ++n;
  return n;
}

// z in units of half the width.
double kernel(double z) {
  constexpr double decay =
      FourierTuning::share_of_decay * math::pi * FourierTuning::width * (1.0 - 0.5 / FourierTuning::oversampling);
  return std::fabs(z) < 1.0 ? math::exp(decay * (std::sqrt(1.0 - z * z) - 1.0)) : 0.0;
}

// What the kernel makes of a wave m on a grid of n points.
double response(int m, size_t n) {
  constexpr int fine = FourierTuning::fine_steps, half = fine * FourierTuning::width / 2;
  double sum = kernel(0.0);
  for (int k = 1; k < half; ++k)
    sum +=
        2.0 * kernel(static_cast<double>(k) / half) * math::cos(2.0 * math::pi * m * k / fine / static_cast<double>(n));
  return sum / fine;
}

double product(const std::array<size_t, 3> &sides) {
  return static_cast<double>(sides[0]) * static_cast<double>(sides[1]) * static_cast<double>(sides[2]);
}
std::array<size_t, 3> sides_of(const FourierSums::Bounds &most) {
  return {grid_side(most[0]), grid_side(most[1]), grid_side(most[2])};
}

}  // namespace

double FourierSums::bytes(const Bounds &most) {
  // The grid; half of its axis 0 as complex numbers, twice while an axis is transformed.
  return product(sides_of(most)) * (sizeof(double) + 2.0 * sizeof(Complex) * 0.5);
}

double FourierSums::seconds(size_t points, const Bounds &most) {
  double cells = 1.0;
  for (const int m : most) cells *= m > 0 ? FourierTuning::width : 1;
  const double grid = product(sides_of(most));
  return FourierTuning::second_a_cell * cells * static_cast<double>(points) +
         FourierTuning::second_a_point * grid * math::log(grid);
}

FourierSums::FourierSums(const std::vector<double> &s, size_t axes, const Bounds &most)
    : axes_(axes), most_(most), side_(sides_of(most)) {
  CallScope::need_memory(bytes(most), "the grid of wave vectors");
  transform(spread(s));
}

std::vector<double> FourierSums::spread(const std::vector<double> &s) const {
  std::vector<double> grid(side_[0] * side_[1] * side_[2], 0.0);
  constexpr int width = FourierTuning::width;
  for (size_t i = 0; i < s.size() / axes_; ++i) {
    CallScope::look();
    double value[3][width];
    size_t place[3][width];
    int count[3] = {1, 1, 1};
    for (size_t c = 0; c < 3; ++c) {
      value[c][0] = 1.0, place[c][0] = 0;
      if (side_[c] == 1) continue;
      count[c] = width;
      const auto n = static_cast<int64_t>(side_[c]);
      const double x = s[i * axes_ + c] * static_cast<double>(n);
      const auto first = static_cast<int64_t>(std::ceil(x - 0.5 * width));
      for (int k = 0; k < width; ++k) {
        value[c][k] = kernel((static_cast<double>(first + k) - x) / (0.5 * width));
        place[c][k] = static_cast<size_t>(((first + k) % n + n) % n);
      }
    }
    for (int a = 0; a < count[0]; ++a)
      for (int b = 0; b < count[1]; ++b) {
        const double ab = value[0][a] * value[1][b];
        double *line = &grid[(place[0][a] * side_[1] + place[1][b]) * side_[2]];
        for (int c = 0; c < count[2]; ++c) line[place[2][c]] += ab * value[2][c];
      }
  }
  return grid;
}

// One axis after the other; waves beyond the bounds are dropped at once.
void FourierSums::transform(const std::vector<double> &grid) {
  std::array<size_t, 3> side = side_;
  for (size_t axis = 0; axis < 3; ++axis) {
    const size_t n = side[axis], kept = width(axis);
    size_t outer = 1, inner = 1;
    for (size_t c = 0; c < axis; ++c) outer *= side[c];
    for (size_t c = axis + 1; c < 3; ++c) inner *= side[c];
    std::vector<double> factor(kept);
    const int low = axis == 0 ? 0 : -most_[axis];
    for (size_t k = 0; k < kept; ++k) factor[k] = n == 1 ? 1.0 : 1.0 / response(low + static_cast<int>(k), n);
    std::vector<Complex> line(n), next(outer * kept * inner);
    Transform by(n);
    for (size_t a = 0; a < outer; ++a)
      for (size_t b = 0; b < inner; ++b) {
        CallScope::look();
        for (size_t k = 0; k < n; ++k) {
          const size_t at = (a * n + k) * inner + b;
          line[k] = axis == 0 ? Complex(grid[at], 0.0) : sum_[at];
        }
        const std::vector<Complex> &wave = by.run(line);
        for (size_t k = 0; k < kept; ++k) {
          const int m = low + static_cast<int>(k);
          next[(a * kept + k) * inner + b] =
              factor[k] * wave[m < 0 ? n - static_cast<size_t>(-m) : static_cast<size_t>(m)];
        }
      }
    sum_ = std::move(next);
    side[axis] = kept;
  }
}

}  // namespace jam::inside
