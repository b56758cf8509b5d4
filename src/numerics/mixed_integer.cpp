#include "numerics/mixed_integer.h"
#include "inkgrid/inkgrid.h"
namespace inkgrid { MixedIntegerSolution solve_mixed_integer(const MixedIntegerProblem&) { throw Error(ErrorCode::numerics, "not built yet"); } }
