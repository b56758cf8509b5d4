// What:   the order in which unknowns are eliminated, for little fill-in.
// Source: approximate minimum degree (Amestoy, Davis and Duff 1996), as Eigen has it.
// Differs: nothing.
// Cost:   nearly linear on the graphs of thin bands.
#pragma once

#include <vector>

namespace inkgrid {

// The neighbours of each column in the strictly lower triangle of a symmetric matrix: rows[starts[k]] .. rows[starts[k + 1] - 1].
// Returns the place of each unknown in the order of elimination.
std::vector<int> elimination_places(const std::vector<int>& starts, const std::vector<int>& rows);

}  // namespace inkgrid
