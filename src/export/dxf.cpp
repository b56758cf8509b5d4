// DXF R12, which every reader knows: polylines.
#include "base/cubic.h"
#include "export/dxf_tags.h"
#include "export/writers.h"

namespace inkgrid {
namespace {

constexpr int kClosed = 1;

void add_line_type(DxfTags& tags) {
  tags.add(0, "TABLE");
  tags.add(2, "LTYPE");
  tags.add(70, 1);
  tags.add(0, "LTYPE");
  tags.add(2, "CONTINUOUS");
  tags.add(70, 0);
  tags.add(3, "Solid line");
  tags.add(72, 65);
  tags.add(73, 0);
  tags.add(40, "0");
  tags.add(0, "ENDTAB");
}

void add_layers(DxfTags& tags) {
  tags.add(0, "TABLE");
  tags.add(2, "LAYER");
  tags.add(70, 3);
  for (const char* name : {"0", kDxfCurveLayer, kDxfFillLayer}) {
    tags.add(0, "LAYER");
    tags.add(2, name);
    tags.add(70, 0);
    tags.add(62, kDxfBlack);
    tags.add(6, "CONTINUOUS");
  }
  tags.add(0, "ENDTAB");
}

// Points of the curve whose polyline stays within `flatness`; a closed curve without its last point, which is the first.
std::vector<Vec2> flattened(const Curve& curve, double flatness) {
  std::vector<Vec2> points{curve.segments.front().p0};
  for (const Cubic& cubic : curve.segments) {
    const int chords = chords_within(cubic, flatness);
    for (int i = 1; i < chords; ++i) points.push_back(point_on(cubic, static_cast<double>(i) / chords));
    points.push_back(cubic.p3);
  }
  if (curve.closed) points.pop_back();
  return points;
}

void add_polyline(DxfTags& tags, const Curve& curve, const char* layer, const DxfFrame& frame, double flatness) {
  tags.add(0, "POLYLINE");
  tags.add(8, layer);
  tags.add(66, 1);  // vertices follow
  tags.point(10, {});
  tags.add(70, curve.closed ? kClosed : 0);
  for (const Vec2 p : flattened(curve, flatness)) {
    tags.add(0, "VERTEX");
    tags.add(8, layer);
    tags.point(10, frame(p));
  }
  tags.add(0, "SEQEND");
  tags.add(8, layer);
}

void add_polylines_file(DxfTags& tags, const Drawing& drawing, const DxfFrame& frame, double flatness) {
  tags.begin("HEADER");
  tags.variable("$ACADVER", 1, "AC1009");
  add_extents(tags, drawing, frame);
  tags.end();
  tags.begin("TABLES");
  add_line_type(tags);
  add_layers(tags);
  tags.end();
  tags.begin("ENTITIES");
  for (const Fill& fill : drawing.fills)
    for (const Curve& outline : fill.outlines) add_polyline(tags, outline, kDxfFillLayer, frame, flatness);
  for (const Curve& curve : drawing.curves) add_polyline(tags, curve, kDxfCurveLayer, frame, flatness);
  tags.end();
}

std::string_view name_of(LengthUnit unit) {
  return unit == LengthUnit::millimetres ? "millimetres" : unit == LengthUnit::inches ? "inches" : "pixels";
}

}  // namespace

void add_extents(DxfTags& tags, const Drawing& drawing, const DxfFrame& frame) {
  const Vec2 least = frame({0, static_cast<double>(drawing.height)}), most = frame({static_cast<double>(drawing.width), 0});
  for (const auto& [name, corner] : {std::pair{"$EXTMIN", least}, std::pair{"$EXTMAX", most}}) {
    tags.add(9, name);
    tags.point(10, corner);
  }
}

std::string dxf_text(const Drawing& drawing, const ExportOptions& options, const std::string& description) {
  const Paper paper = paper_of(drawing, options);
  const DxfFrame frame{paper.units_a_pixel, static_cast<double>(drawing.height)};
  DxfTags tags;
  tags.comment(description);
  tags.comment("unit: " + std::string(name_of(paper.unit)));
  if (options.dxf_curves == DxfCurves::splines)
    add_splines_file(tags, drawing, frame, paper.unit);
  else
    add_polylines_file(tags, drawing, frame, options.flatness);
  return std::move(tags).finished();
}

}  // namespace inkgrid
