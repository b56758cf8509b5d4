// JSON of the whole graph: one line a junction, one line a curve.
#include <nlohmann/json.hpp>

#include "export/paper.h"
#include "export/writers.h"

namespace inkgrid {
namespace {

using Json = nlohmann::ordered_json;

Json point_json(Vec2 p) {
  return {p.x, p.y};
}

// Counted from 1, as in the ids of the SVG; null for none.
Json junction_json(int junction) {
  return junction < 0 ? Json() : Json(junction + 1);
}

Json points_json(const Curve& curve) {
  Json points = Json::array({point_json(curve.segments.front().p0)});
  for (const Cubic& c : curve.segments)
    for (const Vec2 p : {c.p1, c.p2, c.p3}) points.push_back(point_json(p));
  return points;
}

Json fill_json(const Fill& fill, int id) {
  Json outlines = Json::array();
  for (const Curve& outline : fill.outlines) outlines.push_back(points_json(outline));
  return {{"id", id}, {"outlines", std::move(outlines)}};
}

Json curve_json(const Curve& curve, int id) {
  return {{"id", id},
          {"key", std::to_string(curve.id)},
          {"closed", curve.closed},
          {"width", curve.width},
          {"coverage", curve.coverage},
          {"start", junction_json(curve.start_junction)},
          {"end", junction_json(curve.end_junction)},
          {"points", points_json(curve)}};
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

template <class Items, class Write>
std::string lines(const Items& items, Write write) {
  std::string text;
  int id = 0;
  for (const auto& item : items) text += (id > 0 ? ",\n" : "\n") + text_of(write(item, id + 1)), ++id;
  return "[" + text + "]";
}

}  // namespace

std::string graph_json(const Drawing& drawing, const ExportOptions& options, const std::string& description) {
  const double resolution = pixels_per_mm(drawing, options);
  const Json head{{"format", "inkgrid-graph"},  {"version", 1},
                  {"description", description}, {"width", drawing.width},
                  {"height", drawing.height},   {"pixels_per_mm", resolution > 0 ? Json(resolution) : Json()}};
  std::string text = text_of(head);
  text.pop_back();
  text += ",\n\"junctions\":" + lines(drawing.junctions, [](Vec2 p, int id) { return Json{{"id", id}, {"at", point_json(p)}}; });
  text += ",\n\"curves\":" + lines(drawing.curves, curve_json);
  text += ",\n\"fills\":" + lines(drawing.fills, fill_json);
  return text + "}\n";
}

}  // namespace inkgrid
