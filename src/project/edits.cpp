#include "project/edits.h"

#include <algorithm>
#include <limits>

#include "base/at.h"
#include "base/cubic.h"
#include "base/digest.h"

namespace inkgrid {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSampleFlatness = 0.05;  // px
constexpr int kFewestSamples = 8;         // a segment
constexpr double kShortestPart = 0.5;     // px; nearer to an end of an open curve nothing is split
constexpr double kWelded = 1e-6;          // px; ends that are nearer are one point

// A point of a curve, and how far along it lies.
struct Sample {
  int segment;
  double t;
  Vec2 point;
  double along;  // px
};

int steps_of(const Cubic& cubic) {
  return std::max(kFewestSamples, chords_within(cubic, kSampleFlatness));
}

std::vector<Sample> samples_of(const Curve& curve) {
  std::vector<Sample> samples{{0, 0, curve.segments.front().p0, 0}};
  for (int k = 0; k < static_cast<int>(curve.segments.size()); ++k) {
    const Cubic& cubic = curve.segments[at(k)];
    const int steps = steps_of(cubic);
    for (int i = 1; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const Vec2 p = i < steps ? point_on(cubic, t) : cubic.p3;
      samples.push_back({k, t, p, samples.back().along + norm(p - samples.back().point)});
    }
  }
  return samples;
}

double length_of(const Curve& curve) {
  return samples_of(curve).back().along;
}

double length_until(const Curve& curve, const CurvePlace& place) {
  const auto samples = samples_of(curve);
  const auto after = std::find_if(samples.begin() + 1, samples.end(), [&](const Sample& s) {
    return s.segment > place.segment || (s.segment == place.segment && s.t >= place.t);
  });
  const Sample& before = *(after - 1);
  return before.along + norm(place.point - before.point);
}

// The parameter between two others at which the distance to p is least, where it has one valley between them.
double valley(const Cubic& cubic, Vec2 p, double from, double to) {
  for (int round = 0; round < 60; ++round) {
    const double a = from + (to - from) / 3, b = to - (to - from) / 3;
    if (norm2(point_on(cubic, a) - p) <= norm2(point_on(cubic, b) - p))
      to = b;
    else
      from = a;
  }
  return (from + to) / 2;
}

// A bound: the segment lies within the box around its control points.
double least_distance(const Cubic& c, Vec2 p) {
  const auto [left, right] = std::minmax({c.p0.x, c.p1.x, c.p2.x, c.p3.x});
  const auto [top, bottom] = std::minmax({c.p0.y, c.p1.y, c.p2.y, c.p3.y});
  return norm({std::max({left - p.x, 0.0, p.x - right}), std::max({top - p.y, 0.0, p.y - bottom})});
}

// Replaces `best` where the segment comes nearer.
void visit_segment(const Cubic& cubic, Vec2 near, CurvePlace candidate, std::optional<CurvePlace>& best, double limit) {
  if (least_distance(cubic, near) > (best ? best->distance : limit)) return;
  const int steps = steps_of(cubic);
  int nearest = 0;
  for (int i = 1; i <= steps; ++i)
    if (norm2(point_on(cubic, static_cast<double>(i) / steps) - near) <
        norm2(point_on(cubic, static_cast<double>(nearest) / steps) - near))
      nearest = i;
  const double t = valley(cubic, near, std::max(0.0, (nearest - 1.0) / steps), std::min(1.0, (nearest + 1.0) / steps));
  for (const double place : {t, 0.0, 1.0}) {
    const Vec2 p = point_on(cubic, place);
    const double distance = norm(p - near);
    if (distance > limit || (best && distance >= best->distance)) continue;
    candidate.t = place;
    candidate.point = p;
    candidate.distance = distance;
    best = candidate;
  }
}

void visit_curve(const Curve& curve, int number, Vec2 near, std::optional<CurvePlace>& best, double limit) {
  for (int k = 0; k < static_cast<int>(curve.segments.size()); ++k)
    visit_segment(curve.segments[at(k)], near, {number, k, 0, {}, 0}, best, limit);
}

double distance_to_others(const Drawing& drawing, int curve, Vec2 p) {
  std::optional<CurvePlace> best;
  for (int i = 0; i < static_cast<int>(drawing.curves.size()); ++i)
    if (i != curve) visit_curve(drawing.curves[at(i)], i, p, best, kInfinity);
  return best ? best->distance : kInfinity;
}

// The sample that is best between two lengths along the curve: far from other curves, and from both lengths.
Vec2 lonely_point(const Drawing& drawing, int curve, double from, double to) {
  Vec2 best;
  double most = -1;
  for (const Sample& s : samples_of(drawing.curves.at(at(curve)))) {
    const double within = std::min(s.along - from, to - s.along);
    if (within <= most) continue;
    const double score = std::min(within, distance_to_others(drawing, curve, s.point));
    if (score <= most) continue;
    most = score;
    best = s.point;
  }
  return best;
}

Vec2 direction_at_end(const Curve& curve) {
  const Cubic& c = curve.segments.back();
  for (const Vec2 before : {c.p2, c.p1, c.p0})
    if (norm(c.p3 - before) > kWelded) return unit(c.p3 - before);
  return {};
}

void reverse(Curve& curve) {
  std::reverse(curve.segments.begin(), curve.segments.end());
  for (Cubic& c : curve.segments) c = reversed(c);
  std::swap(curve.start_junction, curve.end_junction);
}

Curve turned(Curve curve) {
  reverse(curve);
  return curve;
}

// From the end of `before` to the start of `after`, with the directions of both; nothing where they meet.
std::optional<Cubic> bridge(const Curve& before, const Curve& after) {
  const Vec2 a = before.segments.back().p3, b = after.segments.front().p0;
  const double gap = norm(b - a);
  if (gap <= kWelded) return std::nullopt;
  return Cubic{a, a + gap / 3 * direction_at_end(before), b + gap / 3 * direction_at_end(turned(after)), b};
}

void append(Curve& curve, const Curve& more) {
  const double length = length_of(curve), added = length_of(more), total = std::max(length + added, kWelded);
  curve.width = (length * curve.width + added * more.width) / total;
  curve.coverage = (length * curve.coverage + added * more.coverage) / total;
  if (const auto across = bridge(curve, more)) curve.segments.push_back(*across);
  const Vec2 joint = curve.segments.back().p3;
  curve.segments.insert(curve.segments.end(), more.segments.begin(), more.segments.end());
  curve.segments[curve.segments.size() - more.segments.size()].p0 = joint;
  curve.end_junction = more.end_junction;
}

void close(Curve& curve) {
  if (const auto across = bridge(curve, curve)) curve.segments.push_back(*across);
  curve.segments.back().p3 = curve.segments.front().p0;
  curve.closed = true;
  curve.start_junction = curve.end_junction = -1;
}

// How many ends and joints of curves lie on a junction.
int branches(const Drawing& drawing, int junction) {
  const Vec2 p = drawing.junctions[at(junction)];
  int count = 0;
  for (const Curve& curve : drawing.curves) {
    count += (curve.start_junction == junction) + (curve.end_junction == junction);
    for (std::size_t k = curve.closed ? 0 : 1; k < curve.segments.size(); ++k) count += curve.segments[k].p0 == p;
  }
  return count;
}

void drop_if_lone(Drawing& drawing, int junction) {
  if (junction < 0 || branches(drawing, junction) >= 2) return;
  drawing.junctions.erase(drawing.junctions.begin() + junction);
  for (Curve& curve : drawing.curves)
    for (int* end : {&curve.start_junction, &curve.end_junction}) {
      if (*end == junction)
        *end = -1;
      else if (*end > junction)
        --*end;
    }
}

// Larger numbers first, so that the smaller one stays right.
void drop_lone_junctions(Drawing& drawing, int a, int b) {
  drop_if_lone(drawing, std::max(a, b));
  if (a != b) drop_if_lone(drawing, std::min(a, b));
}

// A curve that was changed is another one.
void renew_id(Drawing& drawing, int curve) {
  Curve& changed = drawing.curves[at(curve)];
  std::vector<Vec2> points;
  for (const Cubic& c : changed.segments) points.insert(points.end(), {c.p0, c.p1, c.p2, c.p3});
  changed.id = digest(points);
  const auto is_taken = [&](const Curve& other) { return &other != &changed && other.id == changed.id; };
  while (std::any_of(drawing.curves.begin(), drawing.curves.end(), is_taken)) ++changed.id;
}

bool remove_curve(Drawing& drawing, const Edit& edit) {
  const auto place = nearest_place(drawing, edit.at, edit.tolerance);
  if (!place) return false;
  const auto curve = drawing.curves.begin() + place->curve;
  const int start = curve->start_junction, end = curve->end_junction;
  drawing.curves.erase(curve);
  drop_lone_junctions(drawing, start, end);
  return true;
}

// Makes the place a joint of the curve; the number of segments before it.
int joint_at(Curve& curve, const CurvePlace& place) {
  constexpr double kAtEnd = 1e-6;
  if (place.t < kAtEnd) return place.segment;
  if (place.t > 1 - kAtEnd) return place.segment + 1;
  const auto [before, after] = cut(curve.segments[at(place.segment)], place.t);
  curve.segments[at(place.segment)] = before;
  curve.segments.insert(curve.segments.begin() + place.segment + 1, after);
  return place.segment + 1;
}

int junction_at(Drawing& drawing, Vec2 p) {
  const auto known = std::find(drawing.junctions.begin(), drawing.junctions.end(), p);
  const int junction = static_cast<int>(known - drawing.junctions.begin());
  if (known == drawing.junctions.end()) drawing.junctions.push_back(p);
  return junction;
}

// An open curve from the joint around to itself.
void open_at(Curve& curve, int joint, int junction) {
  std::rotate(curve.segments.begin(), curve.segments.begin() + joint, curve.segments.end());
  curve.closed = false;
  curve.start_junction = curve.end_junction = junction;
}

bool split_curve(Drawing& drawing, const Edit& edit) {
  const auto place = nearest_place(drawing, edit.at, edit.tolerance);
  if (!place) return false;
  Curve curve = drawing.curves[at(place->curve)];
  const double along = length_until(curve, *place);
  if (!curve.closed && std::min(along, length_of(curve) - along) < kShortestPart) return false;
  const int joint = joint_at(curve, *place);
  const int junction = junction_at(drawing, joint > 0 ? curve.segments[at(joint - 1)].p3 : curve.segments.front().p0);
  if (curve.closed) {
    open_at(curve, joint, junction);
  } else {
    Curve rest = curve;
    rest.segments.erase(rest.segments.begin(), rest.segments.begin() + joint);
    rest.start_junction = junction;
    curve.segments.resize(at(joint));
    curve.end_junction = junction;
    drawing.curves.insert(drawing.curves.begin() + place->curve + 1, std::move(rest));
    renew_id(drawing, place->curve + 1);
  }
  drawing.curves[at(place->curve)] = std::move(curve);
  renew_id(drawing, place->curve);
  return true;
}

struct CurveEnd {
  int curve;
  bool at_end;

  bool operator==(const CurveEnd&) const = default;
};

std::optional<CurveEnd> end_near(const Drawing& drawing, Vec2 p, double tolerance) {
  const auto place = nearest_place(drawing, p, tolerance);
  if (!place) return std::nullopt;
  const Curve& curve = drawing.curves[at(place->curve)];
  if (curve.closed) return std::nullopt;
  return CurveEnd{place->curve, 2 * length_until(curve, *place) > length_of(curve)};
}

bool join_ends(Drawing& drawing, const Edit& edit) {
  const auto a = end_near(drawing, edit.at, edit.tolerance), b = end_near(drawing, edit.to, edit.tolerance);
  if (!a || !b || *a == *b) return false;
  Curve& first = drawing.curves[at(a->curve)];
  const Curve& second = drawing.curves[at(b->curve)];
  const int junctions[] = {a->at_end ? first.end_junction : first.start_junction,
                           b->at_end ? second.end_junction : second.start_junction};
  if (a->curve == b->curve) {
    close(first);
  } else {
    if (!a->at_end) reverse(first);
    append(first, b->at_end ? turned(second) : second);
  }
  renew_id(drawing, a->curve);
  if (a->curve != b->curve) drawing.curves.erase(drawing.curves.begin() + b->curve);
  drop_lone_junctions(drawing, junctions[0], junctions[1]);
  return true;
}

bool apply(Drawing& drawing, const Edit& edit) {
  switch (edit.kind) {
    case EditKind::remove:
      return remove_curve(drawing, edit);
    case EditKind::split:
      return split_curve(drawing, edit);
    default:
      return join_ends(drawing, edit);
  }
}

}  // namespace

std::optional<CurvePlace> nearest_place(const Drawing& drawing, Vec2 near, double tolerance) {
  std::optional<CurvePlace> best;
  for (int i = 0; i < static_cast<int>(drawing.curves.size()); ++i) visit_curve(drawing.curves[at(i)], i, near, best, tolerance);
  return best;
}

Vec2 anchor_of(const Drawing& drawing, int curve) {
  return lonely_point(drawing, curve, 0, length_of(drawing.curves.at(at(curve))));
}

Vec2 anchor_of_end(const Drawing& drawing, int curve, bool at_end) {
  const double length = length_of(drawing.curves.at(at(curve)));
  return at_end ? lonely_point(drawing, curve, length / 2, length) : lonely_point(drawing, curve, 0, length / 2);
}

Edited apply_edits(Drawing drawing, std::span<const Edit> edits) {
  std::vector<int> missed;
  for (int i = 0; i < static_cast<int>(edits.size()); ++i)
    if (!apply(drawing, edits[at(i)])) missed.push_back(i);
  return {std::move(drawing), std::move(missed)};
}

}  // namespace inkgrid
