#include "stage_pictures.h"
namespace inkgrid { void write_stage_pictures(const std::string&, const Image&, const Stages&) { throw Error(ErrorCode::numerics, "not built yet"); } }
