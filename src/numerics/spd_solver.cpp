#include "numerics/spd_solver.h"
