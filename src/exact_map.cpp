#include "exact_map.h"
namespace inkgrid { ExactMap round_map(const GridMap&) { throw Error(ErrorCode::numerics, "not built yet"); } }
