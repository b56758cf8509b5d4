#include "run_report.h"

#include <string>

#include "refine/leftovers.h"

namespace inkgrid {

void report_ink(const Ink& ink, const Fills& fills, double softening, Report& report) {
  report.threshold = ink.threshold;
  report.inverted = ink.inverted;
  report.faintest = ink.faintest;
  report.ruled = ink.ruled;
  report.stroke_width = ink.stroke_width / ink.enlargement;
  report.ink_pixels = ink.pixels / ink.enlargement / ink.enlargement;
  report.softening = softening;
  report.enlargement = ink.enlargement;
  report.fills = fills.count;
}

void report_mesh(const BandMesh& mesh, Report& report) {
  report.vertices = mesh.vertex_count();
  report.triangles = mesh.face_count();
  report.components = mesh.components;
  // Euler: vertices - edges + faces = components - holes.
  int edges = 0;
  for (std::size_t h = 0; h < mesh.twins.size(); ++h) edges += mesh.twins[h] < static_cast<int>(h);
  report.holes = mesh.components - (mesh.vertex_count() - edges + mesh.face_count());
}

void report_field(const FrameField& field, const Charts& charts, Report& report) {
  report.field_rounds = field.rounds;
  report.degenerate_fraction = field.degenerate_fraction;
  report.singularities = charts.singularities;
}

void report_map(const GridMap& map, Report& report) {
  report.cuts = map.cuts;
  report.cut_integers = map.cut_integers;
  report.snapping_integers = map.snapping_integers;
  report.alignment_energy = map.alignment_energy;
  report.snapping_energy = map.snapping_energy;
  report.fallback_components = static_cast<int>(map.failed_components.size());
}

void report_graph(const IsolineGraph& graph, Report& report) {
  report.nodes = static_cast<int>(graph.nodes.size());
  report.edges = static_cast<int>(graph.edges.size());
}

void report_leftovers(const Chains& chains, double stroke_width, Report& report) {
  const auto sentence = [](int count, const char* what, const char* fate) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s") + fate;
  };
  if (report.fallback_components > 0)
    report.warnings.push_back(sentence(report.fallback_components, "part", " of the drawing could not be solved"));
  if (const int dashes = count_dashes(chains, stroke_width); dashes > 0)
    report.warnings.push_back(sentence(dashes, "piece", " of ink became a straight mark, because no isoline follows it"));
}

void count_curves(const Drawing& drawing, Report& report) {
  report.curves = static_cast<int>(drawing.curves.size());
  report.segments = 0;
  for (const Curve& curve : drawing.curves) report.segments += static_cast<int>(curve.segments.size());
}

}  // namespace inkgrid
