// The rule for rattlers: a sphere is a rattler when no contact on it can carry force in a balance of non-negative
// forces. The number of its contacts does not matter: two opposite contacts can squeeze a sphere, and d + 1 contacts on
// one side cannot. Here each sphere is examined by itself, which finds most of them at once; rigidity_test.hpp decides
// on the whole network.
#pragma once
#include <cstddef>

#include "core/container.hpp"

namespace jam::inside {

// Turns contacts off, again and again, on spheres whose contact vectors all lie clearly on one side of a plane.
// Contacts of a sphere with its own image (i == j) balance by themselves and stay; a wall (j < 0) takes any force.
// normal: (contacts, dim), from j to i.
void drop_unbalanced(int dim, size_t n, const std::vector<int32_t> &i, const std::vector<int32_t> &j,
                     const std::vector<double> &normal, std::vector<char> &on);

// For soft spheres whose forces do not balance yet: turns off contacts of spheres with d contacts or fewer, again and
// again. The rule above would take out spheres that are on their way into balance. At a round wall a sphere is stable
// with one contact less for each direction in which the wall bends: two opposite ones hold a disk in a circle.
void drop_loose(int dim, size_t n, const Container &walls, const std::vector<int32_t> &i, const std::vector<int32_t> &j,
                std::vector<char> &on);

// As drop_unbalanced, and how each sphere can leave its contacts: in the order in which spheres were taken out. error:
// largest error of each contact vector, below which a balance cannot be excluded; empty: vectors may be off by 1e-3.
struct Release {
  int32_t sphere;
  std::vector<size_t> contacts;   // that were still on
  std::vector<double> direction;  // unit vector with a positive component along each of them
};
std::vector<Release> release_unbalanced(int dim, size_t n, const std::vector<int32_t> &i, const std::vector<int32_t> &j,
                                        const std::vector<double> &normal, std::vector<char> &on,
                                        const std::vector<double> &error = {});

}  // namespace jam::inside
