#include "chains.h"
#include "inkgrid/inkgrid.h"
namespace inkgrid { Chains chain_strokes(const IsolineGraph&, const BandMesh&, const std::vector<Label>&, const Ink&, const ChainOptions&) { throw Error(ErrorCode::numerics, "not built yet"); } }
