// What:   one drawing function a stage, and the table that names their files.
// Source: the figures of sections 5 and 6.
// Cost:   linear in what the stages made.
#include "pictures/stage_pictures.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>

#include "base/at.h"
#include "pictures/canvas.h"
#include "pictures/streamlines.h"
#include "scribbles/assembled.h"

namespace inkgrid {

namespace {

constexpr Colour kInk{0x2b5fa8}, kPaleInk{0xb4c6e2}, kSlit{0xf08a24}, kCentre{0xffc83d}, kMark{0x111111}, kFree{0xd81b60},
    kJunction{0xe02020}, kFill{0x00897b};
constexpr Colour kBand{0x4f7f9f, 0.6}, kBandOnInk{0x8fc1e3, 0.5};
constexpr Colour kAlongS{0x1a9850}, kAlongT{0x7b3fb5}, kUnlabelled{0xb0b0b0}, kCut{0xff8c00};
constexpr Colour kIsolineU{0xd7301f}, kIsolineV{0x2166ac}, kBoundaryNode{0x888888};
constexpr Colour kHandle{0x777777}, kControl{0x0a7d5c};

constexpr float kNearCentre = 0.2F;  // 0..1

// Distinct on light paper; chains and curves take them in turn.
constexpr std::array<Colour, 10> kTurns{
    {{0x1f77b4}, {0xe6550d}, {0x2ca02c}, {0x9467bd}, {0x8c564b}, {0xd6279f}, {0x17a2b8}, {0x7f7f00}, {0x3949ab}, {0xc62828}}};

Colour in_turn(std::size_t i) {
  return kTurns[i % kTurns.size()];
}

template <class Draw>
void each_triangle(const BandMesh& mesh, Draw draw) {
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto& [a, b, c] = mesh.faces[at(f)];
    draw(f, mesh.points[at(a)], mesh.points[at(b)], mesh.points[at(c)]);
  }
}

// Every edge once, by the smaller of its halfedges; `draw` gets that halfedge.
template <class Draw>
void each_edge(const BandMesh& mesh, Draw draw) {
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    if (mesh.twins[at(h)] >= 0 && mesh.twins[at(h)] < h) continue;
    draw(h, mesh.points[at(mesh.vertex_of(h))], mesh.points[at(mesh.vertex_of(next_halfedge(h)))]);
  }
}

void draw_fills(Painter& painter, const Fills& fills) {
  if (fills.count == 0) return;
  Raster<std::uint8_t> filled(fills.region.width, fills.region.height);
  std::transform(fills.region.data.begin(), fills.region.data.end(), filled.data.begin(), [](int fill) { return fill >= 0; });
  painter.pixels(filled, 1, kFill);
}

// The mask, its centre line as equation (3) sees it, and a disc as wide as the measured stroke in the corner; fills beside it.
void draw_ink(Painter& painter, const Stages& stages) {
  const Ink& ink = stages.ink;
  draw_fills(painter, stages.fills);
  painter.pixels(ink.mask, 1, kInk);
  Raster<std::uint8_t> centre(ink.mask.width, ink.mask.height);
  for (std::size_t i = 0; i < centre.data.size(); ++i) centre.data[i] = ink.mask.data[i] && 1 - ink.rise.data[i] < kNearCentre;
  painter.pixels(centre, 1, kCentre);
  if (ink.stroke_width > 0) painter.dot({ink.stroke_width, ink.stroke_width}, ink.stroke_width / 2, kJunction);
}

// What the grid works on: the slimmed ink over that which was drawn, and the slits of bundles.
void draw_strokes(Painter& painter, const Stages& stages) {
  const Raster<std::uint8_t>&slim = grid_ink(stages).mask, &slits = stages.bundles.slits;
  painter.pixels(stages.ink.mask, 1, kPaleInk);
  painter.pixels(slim, 1, kInk);
  if (stages.bundles.count == 0) return;
  Raster<std::uint8_t> joined = slim;
  std::transform(slits.data.begin(), slits.data.end(), joined.data.begin(), joined.data.begin(), std::bit_and<std::uint8_t>());
  painter.pixels(joined, 1, kSlit);
}

void draw_band(Painter& painter, const Stages& stages) {
  each_triangle(stages.mesh, [&](int f, Vec2 a, Vec2 b, Vec2 c) {
    if (stages.mesh.on_ink[at(f)]) painter.triangle(a, b, c, kBandOnInk);
  });
  each_edge(stages.mesh, [&](int h, Vec2 a, Vec2 b) {
    const bool boundary = stages.mesh.twins[at(h)] < 0;
    painter.line(a, b, boundary ? 1.6 : 0.6, boundary ? kMark : kBand);
  });
}

void draw_field(Painter& painter, const Stages& stages) {
  const double stroke_width = stages.ink.stroke_width;
  const StreamlineOptions options{2 * stroke_width, 0.4 * stroke_width};
  for (const Streamline& line : spread_streamlines(stages.mesh, stages.charts, options)) {
    const bool stub = norm(line.points.back() - line.points.front()) < 0.5 * stroke_width;
    if (!stub) painter.polyline(line.points, 1.1, line.along_s ? kAlongS : kAlongT);
  }
}

void draw_labels(Painter& painter, const Stages& stages) {
  const BandMesh& mesh = stages.mesh;
  each_triangle(mesh, [&](int f, Vec2 a, Vec2 b, Vec2 c) {
    const Label label = stages.labels[at(f)];
    const double alpha = mesh.on_ink[at(f)] ? 0.75 : 0.3;
    painter.triangle(a, b, c, {(label == Label::along_s ? kAlongS : label == Label::along_t ? kAlongT : kUnlabelled).rgb, alpha});
  });
  each_edge(mesh, [&](int h, Vec2 a, Vec2 b) {
    if (stages.charts.cut[at(h)]) painter.line(a, b, 4, kCut);
  });
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (stages.charts.singular[at(v)]) painter.disc(mesh.points[at(v)], 6, kJunction);
}

// An edge in runs of one family: a transition may turn u into v on the way.
void draw_isoline(Painter& painter, const GraphEdge& edge) {
  for (std::size_t begin = 0; begin < edge.family.size();) {
    std::size_t end = begin;
    while (end < edge.family.size() && edge.family[end] == edge.family[begin]) ++end;
    painter.polyline(std::span(edge.path).subspan(begin, end - begin + 1), 2, edge.family[begin] ? kIsolineV : kIsolineU);
    begin = end;
  }
}

void draw_nodes(Painter& painter, const IsolineGraph& graph, NodeKind kind, double radius, Colour colour) {
  for (const GraphNode& node : graph.nodes)
    if (node.kind == kind) painter.disc(node.position, radius, colour);
}

// Where isolines leave the band matters least.
void draw_grid(Painter& painter, const Stages& stages) {
  draw_nodes(painter, stages.graph, NodeKind::boundary, 1.5, kBoundaryNode);
  for (const GraphEdge& edge : stages.graph.edges) draw_isoline(painter, edge);
  draw_nodes(painter, stages.graph, NodeKind::grid, 3, kMark);
  draw_nodes(painter, stages.graph, NodeKind::singular, 6, kJunction);
}

void draw_chains(Painter& painter, const Stages& stages) {
  const Chains& chains = stages.chains;
  for (std::size_t i = 0; i < chains.chains.size(); ++i) painter.polyline(chains.chains[i].points, 2.5, in_turn(i));
  for (const Chain& chain : chains.chains) {
    if (chain.closed || chain.points.empty()) continue;
    if (chain.start_junction < 0) painter.ring(chain.points.front(), 5, 2, kFree);
    if (chain.end_junction < 0) painter.ring(chain.points.back(), 5, 2, kFree);
  }
  for (const Vec2 junction : chains.junctions) painter.disc(junction, 4.5, kJunction);
}

void draw_handles(Painter& painter, const Cubic& cubic) {
  painter.line(cubic.p0, cubic.p1, 0.8, kHandle);
  painter.line(cubic.p3, cubic.p2, 0.8, kHandle);
  painter.square(cubic.p1, 2, kControl);
  painter.square(cubic.p2, 2, kControl);
}

void draw_curves(Painter& painter, const Stages& stages) {
  const Drawing& drawing = stages.drawing;
  for (const Fill& fill : drawing.fills)
    for (const Curve& outline : fill.outlines) painter.curve(outline, 1.5, kFill);
  for (std::size_t i = 0; i < drawing.curves.size(); ++i) painter.curve(drawing.curves[i], 2.5, in_turn(i));
  for (const Curve& curve : drawing.curves)
    for (const Cubic& cubic : curve.segments) {
      draw_handles(painter, cubic);
      painter.disc(cubic.p3, 2.5, kMark);
    }
  for (const Curve& curve : drawing.curves) {
    if (curve.closed || curve.segments.empty()) continue;
    if (curve.start_junction < 0) painter.ring(curve.segments.front().p0, 5, 2, kFree);
    if (curve.end_junction < 0) painter.ring(curve.segments.back().p3, 5, 2, kFree);
  }
  for (const Vec2 junction : drawing.junctions) painter.disc(junction, 4.5, kJunction);
}

// Marks in pixels of the ink, on a painter that takes them in those of the drawing.
class OnInk final : public Painter {
 public:
  OnInk(Painter& painter, double pixel) : painter_(painter), pixel_(pixel) {}

  void pixels(const Raster<std::uint8_t>& mask, double side, Colour colour) override {
    painter_.pixels(mask, pixel_ * side, colour);
  }
  void triangle(Vec2 a, Vec2 b, Vec2 c, Colour colour) override { painter_.triangle(pixel_ * a, pixel_ * b, pixel_ * c, colour); }
  void polyline(std::span<const Vec2> points, double width, Colour colour) override {
    std::vector<Vec2> placed(points.begin(), points.end());
    for (Vec2& p : placed) p = pixel_ * p;
    painter_.polyline(placed, width, colour);
  }
  void curve(const Curve& curve, double width, Colour colour) override {
    Curve placed = curve;
    for (Cubic& cubic : placed.segments)
      for (Vec2* p : {&cubic.p0, &cubic.p1, &cubic.p2, &cubic.p3}) *p = pixel_ * *p;
    painter_.curve(placed, width, colour);
  }
  void disc(Vec2 centre, double radius, Colour colour) override { painter_.disc(pixel_ * centre, radius, colour); }
  void dot(Vec2 centre, double radius, Colour colour) override { painter_.dot(pixel_ * centre, pixel_ * radius, colour); }
  void ring(Vec2 centre, double radius, double width, Colour colour) override {
    painter_.ring(pixel_ * centre, radius, width, colour);
  }
  void square(Vec2 centre, double half_side, Colour colour) override { painter_.square(pixel_ * centre, half_side, colour); }

 private:
  Painter& painter_;
  double pixel_;
};

struct StagePicture {
  std::string_view name;
  void (*draw)(Painter&, const Stages&);
  bool on_ink;  // marks are in pixels of the ink
};

// In the order of the pipeline.
constexpr std::array kPictures{
    StagePicture{"ink", draw_ink, true},        StagePicture{"strokes", draw_strokes, true},
    StagePicture{"band", draw_band, true},      StagePicture{"field", draw_field, true},
    StagePicture{"labels", draw_labels, true},  StagePicture{"grid", draw_grid, true},
    StagePicture{"chains", draw_chains, false}, StagePicture{"curves", draw_curves, false},
};

void draw_stage(const StagePicture& picture, Painter& painter, const Stages& stages) {
  OnInk on_ink(painter, pixel_of(stages));
  Painter& placed = picture.on_ink ? on_ink : painter;
  stages.parts.empty() ? picture.draw(placed, stages) : picture.draw(placed, assembled(stages));
}

}  // namespace

bool paint_stage(std::string_view name, Painter& painter, const Stages& stages) {
  const auto picture = std::find_if(kPictures.begin(), kPictures.end(), [&](const StagePicture& p) { return p.name == name; });
  if (picture == kPictures.end()) return false;
  draw_stage(*picture, painter, stages);
  return true;
}

void write_stage_pictures(const std::string& directory, const Image& image, const Stages& stages) {
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  if (failure) throw Error(ErrorCode::file, "can't make the directory '" + directory + "': " + failure.message());
  int number = 0;
  for (const StagePicture& picture : kPictures) {
    Canvas canvas(image, stages.ink.inverted);
    draw_stage(picture, canvas, stages);
    const std::string file = std::to_string(++number) + "-" + std::string(picture.name) + ".png";
    canvas.write_png((std::filesystem::path(directory) / file).string());
  }
}

}  // namespace inkgrid
