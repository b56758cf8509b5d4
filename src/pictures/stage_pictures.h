// What:   a picture of every stage over the drawing, so that a person sees why a result is as it is.
#pragma once

#include <string>
#include <string_view>

#include "inkgrid/image.h"
#include "pictures/painter.h"
#include "pipeline.h"

namespace inkgrid {

// One picture by the name its file has, without number: "ink", "band", "field", "labels", "grid", "chains", "curves".  False
// where there is none of that name.
bool paint_stage(std::string_view name, Painter& painter, const Stages& stages);

// Writes 1-ink.png, 2-band.png, 3-field.png, 4-labels.png (two label colours, cuts, singularities), 5-grid.png (coloured isolines
// of both families, nodes), 6-chains.png (the edges that were kept), 7-curves.png (curves, control points, ends, junctions) into
// `directory`, which is made if missing. Throws Error{file}.
void write_stage_pictures(const std::string& directory, const Image& image, const Stages& stages);

}  // namespace inkgrid
