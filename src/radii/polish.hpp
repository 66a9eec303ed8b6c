// The last digits of a vertex: contacts that close, forces that balance, and Newton's method on both where moments
// curve.
#pragma once
#include "radii/vertex.hpp"

namespace jam::inside {

// Newton steps on c = 0 and the goal's equations, the shortest ones where there are more unknowns than contacts.
bool close_contacts(Packing &p, RadiiRows &contacts, RadiiGoal &goal, RadiiMatrix &matrix, double unit);
// The balanced forces nearest to those of closed contacts, and the multipliers of the goal's equations.
void balance_contacts(RadiiVertex &at, RadiiGoal &goal, RadiiMatrix &matrix);
// The part of x, of the unknowns, that keeps the contacts closed and the equations. matrix: of balance_contacts.
void keep_closed(const RadiiRows &contacts, const RadiiMatrix &matrix, std::vector<double> &x);
// Where moments or walls curve, a maximum may have fewer contacts than a vertex. Newton's method along the motions that
// keep the contacts closed, on the force that is left along them. False where that is no maximum.
bool settle_curved(RadiiVertex &at, RadiiGoal &goal, double unit, RadiiMatrix &matrix);

// Of the motions that keep contacts closed, but for rigid ones, that along which the second derivative is largest;
// empty without one.
std::vector<double> least_held(const RadiiVertex &at, const RadiiGoal &goal, const RadiiMatrix &matrix);

double largest_of(const std::vector<double> &x);
double longest_edge(const Packing &p);

}  // namespace jam::inside
