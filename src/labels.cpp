#include "labels.h"
namespace inkgrid { std::vector<Label> label_strokes(const BandMesh&, const Charts&, const Ink&, const LabelOptions&) { throw Error(ErrorCode::numerics, "not built yet"); } }
