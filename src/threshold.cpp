#include "threshold.h"
#include "inkgrid/inkgrid.h"
namespace inkgrid { Binarisation binarise(const Image&, std::optional<double>) { throw Error(ErrorCode::numerics, "not built yet"); } }
