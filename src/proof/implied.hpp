// Contacts that others imply, in d = 2: flowers of seven equal disks, patches of triangles and parallelograms.
#pragma once
#include <vector>

#include "proof/scene.hpp"

namespace jam::inside {

// As many implied contacts as there are over one state of self-stress, or none. Where all other contacts are closed
// exactly, these are closed too: each is one side of a polygon whose other sides sum, by exact angles, to a vector of
// the contact's length (bindings/docs/proof_theory.md).
std::vector<ImpliedContact> find_implied(const ProofScene &scene);

}  // namespace jam::inside
