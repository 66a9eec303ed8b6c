#include "pore/tube_spheres.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/math.hpp"

namespace jam::inside {
namespace {

double value_at(const std::vector<double> &p, double x) {
  double sum = 0.0;
  for (size_t k = p.size(); k-- > 0;) sum = sum * x + p[k];
  return sum;
}

// The root between two points where the signs differ.
double bisected(const std::function<double(double)> &f, double low, double high) {
  const bool rises = f(high) > 0.0;
  for (int k = 0; k < TubeTuning::bisections; ++k) {
    const double middle = 0.5 * (low + high);
    (f(middle) > 0.0) == rises ? high = middle : low = middle;
  }
  return 0.5 * (low + high);
}

using Parabola = std::array<double, 3>;  // lowest coefficient first
Parabola length_squared(const Point &a, const Point &b) { return {dot(a, a), 2.0 * dot(a, b), dot(b, b)}; }
Parabola plus(const Parabola &a, double s, const Parabola &b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
void add_product(const Parabola &a, const Parabola &b, double s, std::vector<double> &out) {
  for (size_t k = 0; k < 3; ++k)
    for (size_t q = 0; q < 3; ++q) out[k + q] += s * a[k] * b[q];
}

// The spheres that touch the wall, a base and a row, by the azimuth in turns.
class Curve {
 public:
  Curve(double tube, const Ball &base, const Row &row) : tube_(tube), base_(base), row_(row) {}
  // branch: which root; false where there is none.
  bool at(double turns, int branch, Ball &out) const {
    const double c = math::cos_of_turns(turns), s = math::sin(2.0 * math::pi * turns);
    const double ax = tube_ - base_.x[0], ay = tube_ - base_.x[1], along = ax * c + ay * s;
    const double k = ax * ax + ay * ay + 2.0 * tube_ * along + (tube_ - base_.r) * (tube_ + base_.r);
    const double m = along + tube_ + base_.r;  // k + z^2 = 2 m r
    const double q = row_.q - (row_.d[0] * c + row_.d[1] * s);
    const double b = row_.b - row_.d[0] * ax - row_.d[1] * ay - tube_ * (row_.d[0] * c + row_.d[1] * s);
    const double half = m * row_.d[2], rest = q * k - 2.0 * m * b,
                 disc = half * half - q * rest;  // q z^2 + 2 half z + rest
    if (!(disc >= 0.0 && m > 0.0)) return false;
    const double root = branch ? -std::sqrt(disc) : std::sqrt(disc);
    const double z = half * root > 0.0 ? -rest / (half + root) : (root - half) / q;
    const double r = (k + z * z) / (2.0 * m);
    if (!(r > 0.0 && r <= tube_)) return false;  // infinite roots too
    out = {{tube_ + (tube_ - r) * c, tube_ + (tube_ - r) * s, base_.x[2] + z}, r};
    return true;
  }

 private:
  double tube_;
  const Ball &base_;
  const Row &row_;
};

}  // namespace

std::vector<double> real_roots(const std::vector<double> &p, double low, double high) {
  if (p.size() < 2) return {};
  std::vector<double> slope, ends{low}, roots;
  for (size_t k = 1; k < p.size(); ++k) slope.push_back(static_cast<double>(k) * p[k]);
  double size = 0.0, power = 1.0;
  for (const double c : p) size += std::fabs(c) * power, power *= high;
  for (const double x : real_roots(slope, low, high)) {
    if (std::fabs(value_at(p, x)) <= TubeTuning::double_root * size) roots.push_back(x);
    ends.push_back(x);
  }
  ends.push_back(high);
  for (size_t k = 0; k + 1 < ends.size(); ++k) {
    const double a = value_at(p, ends[k]), b = value_at(p, ends[k + 1]);
    if (a == 0.0) roots.push_back(ends[k]);
    if (a * b < 0.0) roots.push_back(bisected([&p](double x) { return value_at(p, x); }, ends[k], ends[k + 1]));
  }
  std::sort(roots.begin(), roots.end());
  return roots;
}

// Both rows give c = u + w r + v s with v across them. The base makes s^2 a parabola D(r), the wall E(r) + 2 s L(r) =
// 0, and E^2 = 4 D L^2 is a quartic in r. Newton's steps for both equations restore the digits that squaring lost.
void Tube::touching(const Ball &base, const Row &i, const Row &j, std::vector<Ball> &out) const {
  const Point across = cross(i.d, j.d);
  const double size2 = dot(across, across);
  if (!(size2 > TubeTuning::flat * TubeTuning::flat * dot(i.d, i.d) * dot(j.d, j.d)))
    return touching_flat(base, i, j, out);
  const Point ui = cross(j.d, across), uj = cross(across, i.d);
  Point u, w, v;
  const double length = std::sqrt(size2);
  for (size_t c = 0; c < 3; ++c) {
    u[c] = (i.b * ui[c] + j.b * uj[c]) / size2;
    w[c] = -(i.q * ui[c] + j.q * uj[c]) / size2;
    v[c] = across[c] / length;
  }
  const Point from{u[0] - (radius_ - base.x[0]), u[1] - (radius_ - base.x[1]), 0.0}, with{w[0], w[1], 0.0};
  const double v2 = v[0] * v[0] + v[1] * v[1];
  const Parabola d = plus({base.r * base.r, 2.0 * base.r, 1.0}, -1.0, length_squared(u, w));
  const Parabola e = plus(plus(length_squared(from, with), v2, d), -1.0, {radius_ * radius_, -2.0 * radius_, 1.0});
  const Parabola l{v[0] * from[0] + v[1] * from[1], v[0] * with[0] + v[1] * with[1], 0.0};
  std::vector<double> quartic(5, 0.0), l2(5, 0.0);
  add_product(e, e, 1.0, quartic);
  add_product(l, l, 1.0, l2);
  add_product(d, {l2[0], l2[1], l2[2]}, -4.0, quartic);
  const auto at = [](const Parabola &p, double r) { return p[0] + r * (p[1] + r * p[2]); };
  const auto slope = [](const Parabola &p, double r) { return p[1] + 2.0 * r * p[2]; };
  for (double r : real_roots(quartic, 0.0, radius_))
    for (const double sign : {-1.0, 1.0}) {
      double s = sign * std::sqrt(std::max(0.0, at(d, r))), t = r;
      for (int k = 0; k < TubeTuning::newton_steps; ++k) {
        const double f = s * s - at(d, t), g = at(e, t) + 2.0 * s * at(l, t);
        const double fs = 2.0 * s, ft = -slope(d, t), gs = 2.0 * at(l, t), gt = slope(e, t) + 2.0 * s * slope(l, t);
        const double det = fs * gt - ft * gs;
        if (det == 0.0) break;
        s -= (f * gt - g * ft) / det, t -= (fs * g - gs * f) / det;
      }
      if (!(t > 0.0 && t <= radius_)) continue;
      Ball ball{{}, t};
      for (size_t c = 0; c < 3; ++c) ball.x[c] = base.x[c] + u[c] + w[c] * t + v[c] * s;
      out.push_back(ball);
    }
}

// Rows with one direction: the radius follows. Along the axis, as of both ends of the cylinder and of balls above each
// other, the centre lies where two circles meet.
void Tube::touching_flat(const Ball &base, const Row &i, const Row &j, std::vector<Ball> &out) const {
  const double side2 = i.d[0] * i.d[0] + i.d[1] * i.d[1] + j.d[0] * j.d[0] + j.d[1] * j.d[1];
  if (side2 > TubeTuning::flat * TubeTuning::flat * (dot(i.d, i.d) + dot(j.d, j.d)))
    return touching_in_line(base, i, j, out);
  const double det = i.d[2] * j.q - j.d[2] * i.q;
  const double r = (i.d[2] * j.b - j.d[2] * i.b) / det, z = (i.b - i.q * r) / i.d[2];
  if (!(r > 0.0 && r <= radius_)) return;
  const double first2 = (r + base.r - z) * (r + base.r + z), second = radius_ - r;  // about the base, about the axis
  const double ax = radius_ - base.x[0], ay = radius_ - base.x[1], apart = std::sqrt(ax * ax + ay * ay);
  if (!(apart > 0.0 && first2 >= 0.0)) return;
  const double to = 0.5 * (apart + (first2 - second * second) / apart), off2 = first2 - to * to;
  if (off2 < -TubeTuning::flat * radius_ * radius_) return;
  const double off = off2 > 0.0 ? std::sqrt(off2) : 0.0;
  for (const double side : {-off, off})
    out.push_back(
        {{base.x[0] + (to * ax - side * ay) / apart, base.x[1] + (to * ay + side * ax) / apart, base.x[2] + z}, r});
}

// Around the wall in turns, ascending and less than one turn apart, ever denser towards the base: spheres that touch
// both the wall and a base near it do so next to each other.
std::vector<double> Tube::azimuths_for(const Ball &base) const {
  const double x = base.x[0] - radius_, y = base.x[1] - radius_, off = std::sqrt(x * x + y * y);
  const double to = off > 0.0 ? std::copysign(math::acos(std::min(1.0, std::max(-1.0, x / off))), y) : 0.0;
  constexpr int half = TubeTuning::azimuths / 2;
  std::vector<double> turns;
  for (int k = -half; k < half; ++k) {
    const double share = math::expm1(TubeTuning::denser * std::abs(k) / half) / math::expm1(TubeTuning::denser);
    turns.push_back(to / (2.0 * math::pi) + std::copysign(0.5 * share, k));
  }
  return turns;
}

void Tube::touching_in_line(const Ball &base, const Row &i, const Row &j, std::vector<Ball> &out) const {
  const Curve curve(radius_, base, i);
  const std::vector<double> turns = azimuths_for(base);
  for (const int branch : {0, 1}) {
    const auto miss = [&](double t) {
      Ball s;
      if (!curve.at(t, branch, s)) return std::numeric_limits<double>::quiet_NaN();
      return dot(j.d, minus(s.x, base.x)) + j.q * s.r - j.b;
    };
    for (size_t k = 0; k < turns.size(); ++k) {
      const double low = turns[k], high = k + 1 < turns.size() ? turns[k + 1] : turns[0] + 1.0;
      Ball s;
      if (miss(low) * miss(high) <= 0.0 && curve.at(bisected(miss, low, high), branch, s)) out.push_back(s);
    }
  }
}

void Tube::widest(const Ball &base, const Row &i, std::vector<Ball> &out) const {
  const Curve curve(radius_, base, i);
  const std::vector<double> turns = azimuths_for(base);
  const size_t all = turns.size();
  std::vector<double> r(all);
  for (const int branch : {0, 1}) {
    const auto r_at = [&](double t) {
      Ball s;
      return curve.at(t, branch, s) ? s.r : 0.0;
    };
    for (size_t k = 0; k < all; ++k) r[k] = r_at(turns[k]);
    for (size_t k = 0; k < all; ++k) {
      if (!(r[k] > 0.0 && r[k] >= r[(k + 1) % all] && r[k] >= r[(k + all - 1) % all])) continue;
      double low = k > 0 ? turns[k - 1] : turns[all - 1] - 1.0, high = k + 1 < all ? turns[k + 1] : turns[0] + 1.0;
      for (int step = 0; step < TubeTuning::bisections; ++step) {
        const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
        r_at(a) < r_at(b) ? low = a : high = b;
      }
      Ball s;
      if (curve.at(0.5 * (low + high), branch, s)) out.push_back(s);
    }
  }
}

void Tube::about_axis(const Ball &base, std::vector<Ball> &out) const {
  const double ax = radius_ - base.x[0], ay = radius_ - base.x[1];
  const double z2 = (radius_ + base.r) * (radius_ + base.r) - ax * ax - ay * ay;
  if (!(z2 >= 0.0)) return;
  for (const double z : {-std::sqrt(z2), std::sqrt(z2)}) out.push_back({{radius_, radius_, base.x[2] + z}, radius_});
}

}  // namespace jam::inside
