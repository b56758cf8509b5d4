// What:   a picture of every stage over the drawing, so that a person sees why a result is as it is.
// Source: ours; the figures of the paper show the same stages.
// Cost:   that of the painter.
#pragma once

#include <string>
#include <string_view>

#include "inkgrid/image.h"
#include "pictures/painter.h"
#include "pipeline.h"

namespace inkgrid {

// One picture by the name its file has, without number: "ink", "strokes", "band", "field", "labels" (two label colours, cuts,
// singularities), "grid" (coloured isolines of both families, nodes), "chains" (the edges that were kept), "curves" (curves,
// control points, ends, junctions).  False where there is none of that name.
bool paint_stage(std::string_view name, Painter& painter, const Stages& stages);

// Writes all of them, numbered in that order (1-ink.png, ...), into `directory`, which is made if missing.  Throws Error{file}.
void write_stage_pictures(const std::string& directory, const Image& image, const Stages& stages);

}  // namespace inkgrid
