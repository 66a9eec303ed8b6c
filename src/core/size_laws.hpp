// Named laws of diameters: checked options to a distribution, diameters drawn from it, and what a set of diameters is.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "jam/jam.h"

namespace jam::inside {

// Distributions of diameters. A law gives shares of the number of spheres or of their volume; drawing counts spheres,
// so both kinds answer by number here.

// A diameter that a share of the spheres, by number, has.
struct SingleSize {
  double diameter, share;
};

class SizeDistribution {
 public:
  virtual ~SizeDistribution() = default;
  // The diameter below which a share u of the spheres lies, by number.
  virtual double quantile(double u) const = 0;
  // Of laws by volume alone: the share of volume that the smallest spheres have, a share u of the number, up to the
  // diameter s = quantile(u); and the mean of s^d by number.
  virtual double volume_of_smallest(double, double) const { return 0.0; }
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
  // and b, in units of volume, is factor times the share of `law` there. From `low` on: its shares may count from
  // above.
  struct Counted {
    std::unique_ptr<SmoothLaw> law;
    double factor = 0.0;
  };
  virtual Counted counted(int, double) const { return {}; }
};
// The part of a law between low and high, 0 and infinity where it is not cut. Throws JAM_E_ARGUMENT where nearly
// nothing is left, and where volume without a lower cut and without a formula would mean fines without end.
std::unique_ptr<SizeDistribution> cut_law(std::unique_ptr<SmoothLaw> law, double low, double high, int dim,
                                          bool by_volume);

jam_diameters_options default_diameters_options();
// Checks the fields of the law and its curve; curve: (rows, 2). Errors are JAM_E_ARGUMENT and name the field or the
// row.
std::unique_ptr<SizeDistribution> size_distribution(const jam_diameters_options &o, const double *curve,
                                                    size_t curve_len);
// By name; JAM_E_ARGUMENT lists all names where there is none.
int32_t size_law_number(const char *name);
// The number that is called so, or NULL.
double *size_field(jam_diameters_options &o, const char *name);
std::string size_field_names();
// A law from text (core/size_draw.cpp): fields go into o, rows into curve. Returns the files that hold more rows.
std::vector<std::string> parse_size_law(const char *text, jam_diameters_options &o, std::vector<double> &curve);

// Checks all options, then draws (core/size_draw.cpp).
std::vector<double> draw_diameters(const jam_diameters_options &o, const double *curve, size_t curve_len);

// What diameters are (core/size_report.cpp).
jam_size_report size_report(int dim, const std::vector<double> &diameters);
// Packing fraction where random sequential addition of equal spheres ends.
double sequential_fraction(int dim);
// Packing fraction of random jammed packings: 0.84 in d = 2, about 0.64 * 0.7^(d-3) above.
double jammed_fraction(int dim);
struct Reach {
  double fraction;
  int32_t source;  // jam_reach_source
};
// Estimate of the packing fraction at which these sizes jam in disorder.
Reach jammed_reach(int dim, const std::vector<double> &diameters);
// Throws JAM_E_UNPLACEABLE where `wanted` lies beyond the reach of a disordered packing of these sizes.
void check_reach(int dim, const std::vector<double> &diameters, double wanted);

}  // namespace jam::inside
