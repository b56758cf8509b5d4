// What:   sparse symmetric positive definite systems, with the linear algebra library behind a fence.
// Cost:   one factorisation.
#pragma once

#include <complex>
#include <memory>
#include <vector>

namespace inkgrid {

// An entry of a sparse matrix; entries at the same place add up.
template <class Scalar>
struct Entry {
  int row;
  int column;
  Scalar value;
};

}  // namespace inkgrid
