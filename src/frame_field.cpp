#include "frame_field.h"
namespace inkgrid { FrameField solve_field(const BandMesh&, const Ink&, const FieldOptions&, const Control&) { throw Error(ErrorCode::numerics, "not built yet"); } }
