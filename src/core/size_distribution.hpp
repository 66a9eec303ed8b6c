// Distributions of diameters. A law gives shares of the number of spheres or of their volume; drawing counts spheres,
// so both kinds answer by number here.
#pragma once
#include <memory>
#include <vector>

namespace jam::inside {

// A diameter that a share of the spheres, by number, has.
struct SingleSize {
  double diameter, share;
};

class SizeDistribution {
 public:
  virtual ~SizeDistribution() = default;
  // The diameter below which a share u of the spheres lies, by number.
  virtual double quantile(double u) const = 0;
  // Of laws by volume alone: the share of volume that the smallest spheres have, a share u of the number, and the mean
  // of s^d by number.
  virtual double volume_of_smallest(double) const { return 0.0; }
  virtual double mean_power() const { return 0.0; }
  bool by_volume() const { return mean_power() > 0.0; }
  virtual std::vector<SingleSize> single_sizes() const { return {}; }  // no diameter between two is one of the law
};

// Diameters between low and high with a density proportional to s^exponent, or all at low = high.
struct SizeClass {
  double low, high, share, exponent;
};
// The shares are of number, or of volume in `dim` dimensions (then the exponent is that of volume). They add up to
// anything above 0.
std::unique_ptr<SizeDistribution> classes_of_sizes(std::vector<SizeClass> classes, int dim, bool by_volume);

// A smooth law in its own measure.
class SmoothLaw {
 public:
  virtual ~SmoothLaw() = default;
  virtual double share(double s) const = 0;     // below s
  virtual double quantile(double u) const = 0;  // its inverse
  // The law by number that belongs to it as a law by volume, where a formula gives it: the number of spheres between a
  // and b, in units of volume, is factor times the share of `law` there.
  struct Counted {
    std::unique_ptr<SmoothLaw> law;
    double factor = 0.0;
  };
  virtual Counted counted(int) const { return {}; }
};
// The part of a law between low and high, 0 and infinity where it is not cut. Throws JAM_E_ARGUMENT where nearly
// nothing is left, and where volume without a lower cut and without a formula would mean fines without end.
std::unique_ptr<SizeDistribution> cut_law(std::unique_ptr<SmoothLaw> law, double low, double high, int dim,
                                          bool by_volume);

}  // namespace jam::inside
