#include "band_mesh.h"
#include "inkgrid/inkgrid.h"
namespace inkgrid { BandMesh build_band(const Ink&, const ScaleMask*, const BandOptions&) { throw Error(ErrorCode::numerics, "not built yet"); } }
